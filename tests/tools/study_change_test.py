#!/usr/bin/env python3
"""Tests of a study whose error is the change of a global."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
from tushar.studies.change import Change


class ChangeOfAGlobal(unittest.TestCase):
    def measured(self, text, lines):
        with tempfile.TemporaryDirectory() as folder:
            archive = pathlib.Path(folder, "run.uda.000")
            archive.mkdir()
            (archive / "Energy.dat").write_text("# time [s]  Energy [J]\n" + "\n".join(lines) + "\n")
            return Change.of(text).measured(folder)

    def test_is_told_from_an_error_norm_by_its_name(self):
        self.assertIsNone(Change.of("density.cell.L1"))
        self.assertEqual(Change.of("change.Energy"), Change("Energy"))
        self.assertEqual(Change.of("change.Momentum[2]=-1.5e3"), Change("Momentum", 2, -1500))

    def test_is_the_mean_of_the_last_quarter_less_the_start(self):
        self.assertEqual(self.measured("change.Energy", ["0 1", "1 100", "2 100", "3 10", "4 12"]), 10)

    def test_is_the_last_value_less_the_start_if_asked(self):
        self.assertEqual(self.measured("last.Energy=4", ["0 1", "1 100", "2 100", "3 10", "4 12"]), 11)
        self.assertAlmostEqual(Change.of("last.Energy=4").error(5, None), .25)

    def test_takes_one_number_of_a_vector(self):
        self.assertEqual(self.measured("change.Energy[1]", ["0 0 1 0", "1 0 5 0"]), 4)

    def test_is_not_there_where_the_run_did_not_save_it(self):
        self.assertIsNone(self.measured("change.Mass", ["0 1"]))
        self.assertIsNone(self.measured("change.Energy[1]", ["0 1"]))

    def test_is_compared_with_a_number_or_with_the_first_run(self):
        self.assertAlmostEqual(Change.of("change.Energy=4").error(5, None), .25)
        self.assertAlmostEqual(Change.of("change.Energy").error(5, 4), .25)


if __name__ == "__main__":
    unittest.main()
