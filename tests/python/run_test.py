#!/usr/bin/env python3
"""Tests of tushar.run and tushar.sweep: python3 tests/python/run_test.py"""
import json
import os
import pathlib
import stat
import tempfile
import unittest
from unittest import mock

import support

support.ensure("h5py", "numpy")

import numpy as np

import tushar
from in_folder import InFolder
from support import ROOT, SOD, TUBE
from tushar.program import find_sus
from tushar.runs import sets_of, text_of

CFL = "MPM/gas_dynamics/cfl"


class Run(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_gives_the_report_and_the_archive(self):
        run = tushar.run(SOD, TUBE, output=self.folder / "new/out")
        self.assertEqual(run.report["layout"]["cells"], 40)
        self.assertEqual(run.archive.report, run.report)
        self.assertEqual(tushar.open(self.folder / "new/out/sod.uda").report, run.report)
        self.assertAlmostEqual(run.archive.times[-1], 0.2)
        self.assertIn("steps to t = 0.2 s", repr(run))

    def test_ranks_that_cannot_be_started_are_told(self):
        for ranks in (0, -1):
            with self.assertRaisesRegex(tushar.CommandError, f"found ranks={ranks}, expected at least 1"):
                tushar.run(SOD, ranks=ranks, output=self.folder)
        with mock.patch.dict(os.environ, SUS=find_sus(), PATH="/none"):
            with self.assertRaisesRegex(tushar.SusError, "'mpirun' was not found on the PATH"):
                tushar.run(SOD, ranks=2, output=self.folder)

    def test_without_a_folder_its_files_go_away_with_it(self):
        archive = tushar.run(SOD, TUBE).archive
        folder = pathlib.Path(archive.folder)
        self.assertGreater(archive[-1]["p.density"].max(), 0.9)
        self.assertTrue(folder.exists())
        del archive
        self.assertFalse(folder.exists())

    def test_ranks_and_threads_change_no_bit(self):
        first = tushar.run(SOD, TUBE, threads=1)
        for more in ({"ranks": 2}, {"threads": 2}, {"options": ["-layout", "2x1x1"]}):
            self.assertEqual(tushar.run(SOD, TUBE, **more).report["fingerprint"], first.report["fingerprint"])

    def test_options_may_be_one_string(self):
        run = tushar.run(SOD, TUBE, options="--layout 4x1x1 --nthreads 1")
        self.assertEqual(run.report["layout"]["patches"], 4)
        with self.assertRaisesRegex(tushar.CommandError, "found the options '--layout \"4x1': No closing quotation"):
            tushar.run(SOD, TUBE, options='--layout "4x1')

    def test_a_second_run_into_a_folder_has_the_second_archive(self):
        for number in (0, 1):
            run = tushar.run(SOD, TUBE, output=self.folder)
            self.assertTrue(run.archive.folder.endswith(f"sod.uda.00{number}"))

    def test_finds_a_scene_of_the_repository_from_anywhere_and_one_of_its_own_first(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.folder)
        self.assertEqual(tushar.run(SOD, TUBE).report["title"], "Sod's shock tube")
        pathlib.Path("own.ups").write_text((ROOT / SOD).read_text().replace("Sod's shock tube", "Mine"))
        self.assertEqual(tushar.run("own.ups", TUBE).report["title"], "Mine")


class Failure(unittest.TestCase):
    def test_mistakes_in_the_scene_are_told_all_at_once(self):
        with self.assertRaisesRegex(tushar.InputError, "did you mean 'MPM'") as caught:
            tushar.run(SOD, {"MPMM/x": 3, "Time/maxTime": -1})
        self.assertEqual((caught.exception.code, len(caught.exception.sentences)), (3, 2))
        self.assertIn("expected a value greater than 0 s", caught.exception.sentences[1])

    def test_a_run_that_dies_leaves_report_and_archive(self):
        with self.assertRaisesRegex(tushar.NumericalError, "p.density became -0.29.*\n.*try a smaller <cfl>") as caught:
            tushar.run(SOD, {"Time/timestep_multiplier": 5.0})
        run = caught.exception.run
        self.assertIn("p.density became -0.29", run.report["failure"])
        self.assertEqual(run.archive.times, [0.0])

    def test_options_that_sus_does_not_take(self):
        with self.assertRaisesRegex(tushar.CommandError, "unknown option '--foo'"):
            tushar.run(SOD, options=["--foo"])

    def test_a_run_that_takes_too_long_is_ended(self):
        with self.assertRaisesRegex(tushar.SusError, "did not end within 0.3 s"):
            tushar.run(SOD, {"Grid/Level/Box/resolution": [4000, 1, 1]}, timeout=0.3)

    def test_a_scene_that_is_not_there(self):
        with self.assertRaisesRegex(tushar.SusError, "none.ups: there is no such file"):
            tushar.run("none.ups")

    def test_a_program_that_is_not_there(self):
        with self.assertRaisesRegex(tushar.SusError, "'/none/sus' is not a program"):
            tushar.run(SOD, sus="/none/sus")
        with mock.patch.dict(os.environ, SUS="/none/sus"):
            with self.assertRaisesRegex(tushar.SusError, "'/none/sus', which .SUS names, is not a program"):
                tushar.run(SOD)


class Program(unittest.TestCase):
    def test_is_in_the_environment_else_in_the_repository_else_on_the_path(self):
        with tempfile.TemporaryDirectory() as folder:
            programs = [pathlib.Path(folder, where, "sus") for where in ("path", "named", "tree/build/release")]
            for program in programs:
                program.parent.mkdir(parents=True)
                program.write_text("#!/bin/sh\n")
                program.chmod(program.stat().st_mode | stat.S_IXUSR)
            on_path, named, built = map(str, programs)
            empty = mock.patch("tushar.program.ROOT", pathlib.Path(folder, "none"))
            tree = mock.patch("tushar.program.ROOT", pathlib.Path(folder, "tree"))
            with mock.patch.dict(os.environ, SUS=named, PATH=os.path.dirname(on_path)):
                self.assertEqual(find_sus(), named)
                self.assertEqual(find_sus(on_path), on_path)
                del os.environ["SUS"]
                with tree:
                    self.assertEqual(find_sus(), built)
                with empty:
                    self.assertEqual(find_sus(), on_path)
                    os.environ["PATH"] = "/none"
                    with self.assertRaisesRegex(tushar.SusError, "sus was not found in .* tools/run builds it"):
                        find_sus()


class Values(unittest.TestCase):
    def test_they_are_written_as_scenes_write_them(self):
        for value, text in ((0.1, "0.1"), (1e-300, "1e-300"), (True, "true"), ([200, 1, 1], "[200,1,1]"),
                            ("sqrt(2)", "sqrt(2)"), (np.float64(0.1), "0.1"), (np.array([1.5, 2]), "[1.5,2.0]"),
                            (np.int32(3), "3"), ((1, 2), "[1,2]")):
            self.assertEqual(text_of(value), text)
        self.assertEqual(sets_of({"a/b": 1, "c": False}), ["a/b=1", "c=false"])


class Sweep(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        values = {CFL: [0.1, -1, 0.2], "Grid/Level/Box/resolution": [[20, 1, 1], [40, 1, 1]]}
        cls.sweep = tushar.sweep(SOD, values, jobs=2, sets={"Time/maxTime": 0.05}, output=cls.folder)

    def test_runs_all_combinations_in_their_order(self):
        self.assertEqual([(point.values[CFL], point.values["Grid/Level/Box/resolution"][0]) for point in self.sweep],
                         [(0.1, 20), (0.1, 40), (-1, 20), (-1, 40), (0.2, 20), (0.2, 40)])
        cells = [point.report.get("layout", {}).get("cells") for point in self.sweep]
        self.assertEqual(cells, [20, 40, None, None, 20, 40])

    def test_one_that_fails_does_not_end_the_others(self):
        self.assertEqual([type(point.error) for point in self.sweep.failed], [tushar.InputError] * 2)
        with self.assertRaisesRegex(tushar.InputError, "expected a value greater than 0"):
            self.sweep[2].archive

    def test_values_that_are_no_list_are_refused(self):
        for value in (0.1, "0.1"):
            with self.assertRaisesRegex(tushar.CommandError, rf"{CFL}: found {value!r}, expected a list of values"):
                tushar.sweep(SOD, {CFL: value})

    def test_archives_stay_in_the_folder_that_was_named(self):
        self.assertAlmostEqual(self.sweep[5].archive.times[-1], 0.05)
        self.assertTrue((self.folder / "005/sod.uda/index.xml").exists())
        self.assertEqual(json.loads((self.folder / "001/report.json").read_text()), self.sweep[1].report)

    def test_rows_have_values_and_numbers_of_the_report(self):
        good, bad = self.sweep.rows()[0], self.sweep.rows()[2]
        self.assertEqual((good[CFL], good["failure"]), (0.1, ""))
        self.assertEqual(good["errors.density.cell.L1"], self.sweep[0].report["errors"]["density"]["cell"]["L1"])
        self.assertIn("expected a value greater than 0", bad["failure"])


if __name__ == "__main__":
    unittest.main()
