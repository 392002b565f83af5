#!/usr/bin/env python3
"""Tests of tools/study and its library: the runs, the files written, and the timings."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
from tushar.interpreter import ensure

ensure("matplotlib")

from tushar.studies.shorthand import SHORT
from tushar.studies.study import order, time_by_task

METHODS = ("--method", "paper=ups/mpm/sod.ups", "--method",
           "tracked=ups/mpm/sod.ups;MPM/gas_dynamics/volume_model=tracked", "--method", "volumes=ups/euler/sod.ups")


def study(folder, *arguments, out="out"):
    return subprocess.run([sys.executable, ROOT / "tools/study", *arguments, "--sus", SUS, "--out", out], cwd=folder,
                          capture_output=True, text=True)


class Study(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.done = study(cls.folder.name, *METHODS, "--vary", "resolution=20,40", "--repeat", "2")
        cls.out = pathlib.Path(cls.folder.name, "out")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def rows(self):
        return json.loads((self.out / "study.json").read_text())["rows"]

    def test_runs_every_method_at_every_resolution(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        self.assertEqual([(row["method"], row["cells"]) for row in self.rows()],
                         [(name, cells) for name in ("paper", "tracked", "volumes") for cells in (20, 40)])
        self.assertIn("12/12", self.done.stderr)

    def test_tells_what_each_task_took_of_the_time_loop(self):
        for row in self.rows():
            self.assertIn("between tasks", row["tasks"])
            self.assertEqual("mpm::updateParticles" in row["tasks"], row["method"] != "volumes")
            self.assertTrue(all(seconds >= 0 for seconds in row["tasks"].values()))
            self.assertGreater(sum(row["tasks"].values()), 0)

    def test_writes_a_column_a_task_empty_where_a_method_has_none(self):
        with open(self.out / "study.csv", newline="") as file:
            table = list(csv.DictReader(file))
        for line, row in zip(table, self.rows(), strict=True):
            self.assertNotIn("varied", line)
            self.assertEqual(float(line["seconds"]), row["seconds"])
            for name in ("tasks.mpm::updateParticles", "tasks.euler::advance", "tasks.between tasks"):
                seconds = row["tasks"].get(name.removeprefix("tasks."))
                self.assertEqual(line[name], "" if seconds is None else str(seconds))

    def test_draws_a_bar_a_method_and_resolution_with_its_tasks(self):
        for name in ("error_h", "error_time", "where_the_time_went"):
            self.assertTrue((self.out / f"{name}.png").read_bytes().startswith(b"\x89PNG"))
        svg = (self.out / "where_the_time_went.svg").read_text()
        for words in ("paper, resolution = 20", "volumes, resolution = 40", "mpm::updateParticles", "euler::advance",
                      "between tasks", "time per step and cell [ns]"):
            self.assertIn(words, svg)

    def test_goes_on_where_it_stopped(self):
        again = study(self.folder.name, *METHODS, "--vary", "resolution=20,40", "--repeat", "3")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("6/6", again.stderr)
        self.assertNotIn("12", again.stderr)

    def test_fails_with_a_sentence(self):
        for arguments, sentence in ((("sodd",), "'sodd' is neither a scene (.ups) nor a predefined study: sod"),
                                    ((), "nothing to run"),
                                    (("nope.ups", "--vary", "resolution=20"), "study: there is no scene 'nope.ups'"),
                                    (("ups/solid/two_discs.ups", "--vary", "cfl=.1"),
                                     "--vary cfl=.1: ups/solid/two_discs.ups has no section with a <cfl>"),
                                    (("ups/mpm/sod.ups", "--error", "density.face.L1", "--vary", "resolution=20"),
                                     "there is no error 'density.face.L1': at 'face', available: particle, cell, "
                                     "node")):
            done = study(self.folder.name, *arguments, "--repeat", "1", out="wrong")
            self.assertEqual(done.returncode, 1)
            self.assertIn("study: ", done.stderr)
            self.assertIn(sentence, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertNotIn("<MPM>", done.stderr)

    def test_a_folder_that_cannot_be_made_is_told(self):
        done = study(self.folder.name, "ups/mpm/sod.ups", out="/proc/none")
        self.assertEqual((done.returncode, done.stderr), (1, "study: '/proc/none': No such file or directory\n"))


class Figures(unittest.TestCase):
    def test_the_time_of_a_task_is_its_median_and_the_rest_is_between(self):
        reports = [{"wall": {"loop": loop, "tasks": {"a": a, "b": b}}} for loop, a,
                   b in ((10, 2, 3), (20, 9, 4), (12, 3, 5))]
        self.assertEqual(time_by_task(reports), {"a": 3, "b": 4, "between tasks": 5})

    def test_short_names_find_their_place_in_any_scene(self):
        self.assertEqual(SHORT["resolution"]("ups/mpm/lax_liu_3.ups", "50"), ["Grid/Level/Box/resolution=[50,50,1]"])
        self.assertEqual(SHORT["resolution"]("ups/mpm/sod.ups", "[7,5,3]"), ["Grid/Level/Box/resolution=[7,5,3]"])
        self.assertEqual(SHORT["cfl"]("ups/euler/sod.ups", ".4"), ["Euler/cfl=.4"])
        self.assertEqual(SHORT["cfl"]("ups/heat/sine.ups", ".4"), ["Heat/cfl=.4"])
        self.assertEqual(SHORT["cfl"]("ups/ice/sod.ups", ".4"), ["CFD/cfl=.4"])
        self.assertEqual(SHORT["cfl"]("ups/mpm/sod_conserving.ups", ".4"), ["MPM/conserving_gas_dynamics/cfl=.4"])
        self.assertEqual(SHORT["particles"]("ups/mpm/sod.ups", "4"),
                         [f"MaterialProperties/MPM/material/geom_object[{body}]/res=[4,1,1]" for body in (1, 2)])

    def test_the_observed_order_is_that_between_two_cell_widths(self):
        self.assertAlmostEqual(order({"h": .1, "error": 4}, {"h": .05, "error": 1}), 2)
        self.assertIsNone(order(None, {"h": .05, "error": 1}))


if __name__ == "__main__":
    unittest.main()
