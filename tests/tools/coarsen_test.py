#!/usr/bin/env python3
"""Tests of tools/coarsen and of the module that reads what it writes: python3 tests/tools/coarsen_test.py"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS.parent / "tools/python"), str(TESTS / "support")]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import h5py
import numpy as np

import fake_uda
from sus import ROOT, SUS, run
from tushar import Archive

SCENE = "ups/euler/kelvin_helmholtz.ups"
SETS = ["Time/maxTime=0.05", "DataArchiver/outputInterval=0"]


def coarsen(*arguments):
    """Returns exit code and output of a run of the tool."""
    done = subprocess.run([sys.executable, ROOT / "tools/coarsen", *map(str, arguments)], capture_output=True,
                          text=True)
    return done.returncode, done.stdout + done.stderr


class Coarsen(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        sets = [word for item in SETS + ["Grid/Level/Box/resolution=[48,48,1]"] for word in ("--set", item)]
        subprocess.run([SUS, SCENE, "--quiet", "--output", cls.folder.name, *sets], cwd=ROOT, check=True)
        cls.archive = os.path.join(cls.folder.name, "kelvin_helmholtz.uda")
        cls.table = os.path.join(cls.folder.name, "table.h5")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_joins_cells_to_their_mean_in_four_digits(self):
        self.assertEqual(coarsen(self.archive, "--by", 4, "--out", self.table)[0], 0)
        fine = Archive(self.archive)
        with h5py.File(self.table) as table:
            self.assertEqual(table.attrs["time"], fine.times[-1])
            self.assertEqual(table["grid"].attrs["cells"].tolist(), [12, 12, 1])
            self.assertEqual(table["grid"].attrs["spacing"].tolist(), [1 / 12, 1 / 12, 1])
            for name in ("c.density", "c.pressure", "c.velocity"):
                values = fine[-1][name].values[0]
                means = values.reshape(12, 4, 12, 4, -1).mean(axis=(1, 3)).squeeze()
                np.testing.assert_allclose(table["cells/" + name][0], means, rtol=2**-13, atol=1e-30)

    def test_keeps_what_is_in_a_box(self):
        self.assertEqual(coarsen(self.archive, "--by", 3, "--lower", "0.25,0.5,0", "--upper", "0.5,1,1",
                                 "--out", self.table)[0], 0)
        with h5py.File(self.table) as table:
            self.assertEqual(table["grid"].attrs["lower"].tolist(), [0.25, 0.5, 0])
            self.assertEqual(table["cells/c.density"].shape, (1, 8, 4))
            block = Archive(self.archive)[-1]["c.density"][0, 24:27, 12:15]
            self.assertAlmostEqual(table["cells/c.density"][0, 0, 0], block.mean(), delta=2e-4)

    def test_refuses_what_does_not_fit(self):
        self.assertEqual(coarsen(self.archive, "--by", 5, "--out", self.table),
                         (1, "coarsen: 48 x 48 x 1 cells cannot be merged by 5 along each axis\n"))
        self.assertEqual(coarsen(self.archive, "--by", 2, "--lower", "2,0,0", "--out", self.table),
                         (1, "coarsen: the box between --lower and --upper contains no cells\n"))
        self.assertEqual(coarsen(self.archive, "--by", 2, "--lower", "2,0", "--out", self.table)[0], 2)
        self.assertEqual(coarsen(self.folder.name, "--by", 2, "--out", self.table)[0], 1)

    def test_refuses_numbers_that_mean_nothing(self):
        for option, least in (("--by", "of at least 1"), ("--bits", "from 1 to 52")):
            for text in ("0", "-2", "1.5", "two", *(["53"] if option == "--bits" else [])):
                code, said = coarsen(self.archive, "--by", 2, f"{option}={text}", "--out", "none.h5")
                self.assertEqual(code, 2, said)
                self.assertIn(f"argument {option}: found '{text}', expected a whole number {least}", said)

    def errors(self, cells, table):
        result = run(SCENE, *SETS, f"Grid/Level/Box/resolution=[{cells},{cells},1]",
                     f"DataAnalysis/Module/file={table}")
        self.assertEqual(result.code, 0, result.err)
        return result.report["errors"]

    def test_a_scene_is_measured_against_a_table_or_an_output_as_it_is(self):
        self.assertEqual(coarsen(self.archive, "--by", 2, "--bits", 23, "--out", self.table)[0], 0)
        output = str(pathlib.Path(self.archive, f"t{Archive(self.archive).steps[-1]:05}.h5"))
        by_table, by_output = self.errors(24, self.table), self.errors(24, output)
        self.assertGreater(by_table["density"]["cell"]["L1"], 1e-3)
        for field in ("density", "velocity", "pressure"):
            self.assertAlmostEqual(by_table[field]["cell"]["L1"], by_output[field]["cell"]["L1"], delta=1e-6)
        self.assertLess(self.errors(48, output)["density"]["cell"]["L1"], 1e-15)

    def test_at_another_time_nothing_is_measured(self):
        result = run(SCENE, "Time/max_Timesteps=2", "Grid/Level/Box/resolution=[16,16,1]")
        self.assertEqual(result.report["errors"], {})
        self.assertRegex(result.report["unmeasured"][0], r"^'tabulated' has no solution at t = 0\.\d+ s$")

    def test_an_output_of_a_refined_grid_is_no_table(self):
        with tempfile.TemporaryDirectory() as folder:
            output = pathlib.Path(fake_uda.make_refined(folder), "t00010.h5")
            result = run(SCENE, f"DataAnalysis/Module/file={output}")
        self.assertEqual(result.code, 3)
        self.assertIn("contains boxes of several levels: use tools/coarsen to make a table from it", result.err)

    def test_a_table_that_is_not_there_is_a_bad_scene(self):
        result = run(SCENE, "DataAnalysis/Module/file=none.h5")
        self.assertEqual(result.code, 3)
        self.assertIn("DataAnalysis/Module: cannot read the file 'none.h5'", result.err)


if __name__ == "__main__":
    unittest.main()
