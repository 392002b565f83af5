#!/usr/bin/env python3
"""Tests of tools/study: it reruns what has changed, from any folder, and leaves other files untouched."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS


class Study(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.here = pathlib.Path(self.folder.name)
        self.scene = self.here / "my.ups"
        self.scene.write_text((ROOT / "ups/heat/sine.ups").read_text())

    def study(self, *words):
        command = [sys.executable, ROOT / "tools/study", "--repeat", "1", "--sus", SUS, *words]
        return subprocess.run(command, cwd=self.here, capture_output=True, text=True, timeout=120)

    def rows(self, *words):
        done = self.study("my.ups", "--error", "temperature.cell.L1", "--out", "out", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.here / "out/study.json").read_text())["rows"]

    def test_leaves_archives_alone_that_it_has_not_made(self):
        (self.here / "out/precious.uda.000").mkdir(parents=True)
        (self.here / "out/precious.uda.000/t00000.h5").write_text("data")
        self.rows()
        self.assertTrue((self.here / "out/precious.uda.000/t00000.h5").exists())
        self.assertEqual([entry.name for entry in (self.here / "out").iterdir() if entry.name.startswith("run")], [])

    def test_runs_again_what_an_edited_scene_changes(self):
        self.assertEqual(self.rows()[0]["h"], 1 / 64)
        self.scene.write_text(self.scene.read_text().replace("[64,1,1]", "[32,1,1]"))
        self.assertEqual(self.rows()[0]["h"], 1 / 32)

    def test_runs_again_what_an_edited_include_changes(self):
        text = self.scene.read_text()
        start, end = text.index("<Heat>"), text.index("</Heat>") + len("</Heat>")
        included = self.here / "slab.ups"
        included.write_text("<slab>" + text[start:end] + "</slab>")
        self.scene.write_text(text[:start] + '<include href="slab.ups"/>' + text[end:])
        before = self.rows()[0]["error"]
        included.write_text(included.read_text().replace("sin(pi*x)", "2*sin(pi*x)"))
        self.assertNotEqual(self.rows()[0]["error"], before)

    def test_runs_a_ready_study_from_another_folder(self):
        done = self.study("heat", "--vary", "resolution=16")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.here / "study-heat/study.md").exists())

    def test_compares_levels_with_the_uniform_grid_of_their_finest_cells(self):
        done = self.study("levels", "--vary", "finest=64,128", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads((self.here / "out/study.json").read_text())["rows"]
        self.assertEqual([row["h"] for row in rows], [1 / 64, 1 / 128] * 3)
        self.assertEqual([row["is_refined"] for row in rows], [False, False, False, True, False, True])
        uniform, refined = rows[1], rows[3]
        self.assertEqual(uniform["updates"], uniform["steps"] * 128 * 128)
        self.assertLess(refined["updates"], uniform["updates"])
        self.assertTrue((self.here / "out/error_updates.png").exists())
        self.assertIn(f"{refined['updates']:.3g}", (self.here / "out/study.md").read_text())

    def test_refuses_cells_that_no_level_has(self):
        done = self.study("levels", "--vary", "finest=100", "--out", "out")
        self.assertIn("--vary finest=100: ups/euler/lax_liu_3_levels.ups has 64 cells along x", done.stderr)

    def test_varies_the_resolution_of_a_scene_in_another_folder(self):
        self.assertEqual([row["h"] for row in self.rows("--vary", "resolution=16,32")], [1 / 16, 1 / 32])

    def test_a_row_has_the_value_that_was_varied_even_where_the_report_has_one_of_that_name(self):
        done = self.study(str(ROOT / "ups/mpm/sod_conserving.ups"), "--vary", "particles=2,3", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = json.loads((self.here / "out/study.json").read_text())["rows"]
        self.assertEqual([(row["particles"], row["particle_count"]) for row in rows], [("2", 200), ("3", 300)])
        self.assertIn("| sod_conserving | 3 | 0.01 |", (self.here / "out/study.md").read_text())

    def test_refuses_to_repeat_nothing(self):
        done = self.study("my.ups", "--repeat", "0")
        self.assertEqual(done.returncode, 2)
        self.assertIn("found '0', expected a whole number of at least 1", done.stderr)


if __name__ == "__main__":
    unittest.main()
