#!/usr/bin/env python3
"""A run that fails: its message, the files that it leaves, and a restart from them."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS


def without_redistribution(folder):
    """Sod's tube by the paper's method with one particle per cell, which empties a cell and fails."""
    text = (ROOT / "ups/mpm/sod_redistribute.ups").read_text()
    start, end = text.index("      <redistribute>"), text.index("</redistribute>") + len("</redistribute>")
    scene = pathlib.Path(folder, "bare.ups")
    scene.write_text(text[:start] + text[end:])
    return scene


def run(*words):
    return subprocess.run([SUS, *map(str, words)], capture_output=True, text=True)


class Failure(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def died(self, *sets):
        done = run(without_redistribution(self.folder), "--quiet", "--output", self.folder,
                   *(word for one in sets for word in ("--set", one)))
        self.assertEqual(done.returncode, 4)
        return done.stderr

    def test_the_sentence_is_the_same_on_any_patches(self):
        said = {re.sub(r"patch \d+|saved: .*", "", self.died(f"Grid/Level/Box/patches=[{n},1,1]")) for n in (1, 3, 100)}
        self.assertEqual(len(said), 1, said)

    def test_the_last_whole_step_is_saved_and_can_be_gone_on_from(self):
        said = self.died()
        archive = re.search(r"the last complete step, (\d+) at t = \S+ s, is saved: sus --restart (\S+) \[T\d+\]\n",
                            said)
        again = run("-restart", archive[2], "--quiet", "--json", f"{self.folder}/again.json")
        self.assertEqual(again.returncode, 4)
        self.assertIn(said[:said.index(" (task")], again.stderr)
        self.assertIn(f"step {int(archive[1]) + 1},", again.stderr)
        self.assertIn('"ended": "failed"', pathlib.Path(self.folder, "again.json").read_text())

    def test_a_step_is_repeated_where_the_scene_asks_for_it(self):
        done = run(without_redistribution(self.folder), "--output", self.folder, "--set",
                   "Time/recompute_timestep=true")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"time step limited by CFL \d+, .*p.density \d+; \d+ repeated with a smaller one")

    def test_a_long_list_of_mistakes_is_cut_on_the_screen_and_whole_as_json(self):
        text = (ROOT / "ups/heat/sine.ups").read_text()
        for mistakes, more in ((100, ""), (103, "and 3 more\n")):
            scene = pathlib.Path(self.folder, "many.ups")
            wrong = "".join(f"<wrong{k}/>" for k in range(mistakes))
            scene.write_text(text.replace("</Uintah_specification>", wrong + "</Uintah_specification>"))
            done = run("--check", scene)
            self.assertEqual((done.returncode, done.stderr.count("<wrong")), (3, 100), done.stderr)
            self.assertTrue(done.stderr.endswith(more or "]\n"), done.stderr)
            problems = json.loads(run("--check", scene, "--json").stdout)
            self.assertEqual(len(problems), mistakes)


if __name__ == "__main__":
    unittest.main()
