#!/usr/bin/env python3
"""Tests of tools/coverage: its reports on scenes that run, are refused, fail, or do not end."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

SINE = (ROOT / "ups/heat/sine.ups").read_text()
ENDLESS = (SINE.replace("<maxTime>0.1<", "<maxTime>1e9<").replace("<outputInterval>0.02<", "<outputInterval>1e8<"))
NOTED = (ROOT / "ups/solid/two_discs.ups").read_text().replace("<save ", '<save label="AccStrainEnergy"/><save ', 1)


def dying():
    """Sod's tube by the paper's method with one particle per cell, which empties a cell and fails."""
    text = (ROOT / "ups/mpm/sod_redistribute.ups").read_text()
    start, end = text.index("      <redistribute>"), text.index("</redistribute>") + len("</redistribute>")
    return text[:start] + text[end:]


class Coverage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        (self.here / "scenes/deep").mkdir(parents=True)
        (self.here / "temporary").mkdir()

    def scene(self, name, text):
        (self.here / "scenes" / name).write_text(text)

    def start(self, *words, folder="scenes"):
        command = [sys.executable, ROOT / "tools/coverage", folder, "--sus", SUS, "--json", "all.json", *words]
        return subprocess.Popen(command, cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, "TMPDIR": str(self.here / "temporary")})

    def run_tool(self, *words, **others):
        process = self.start(*words, **others)
        out, errors = process.communicate(timeout=120)
        return process.returncode, out, errors

    def known(self):
        return json.loads((self.here / "all.json").read_text())

    def covered(self, *words):
        """Returns the scenes in the report of a valid call, by name."""
        code, out, errors = self.run_tool(*words)
        self.assertEqual((code, errors), (0, ""), out)
        return {scene["scene"]: scene for scene in self.known()["scenes"]}

    def test_a_scene_that_runs_has_its_steps_and_times(self):
        self.scene("deep/sine.ups", SINE)
        sine = self.covered()["deep/sine.ups"]
        self.assertEqual((sine["type"], sine["result"], sine["code"], sine["cells"]), ("heat", "ran", 0, 64))
        self.assertGreater(sine["steps"], 500)
        self.assertAlmostEqual(sine["time"], .1, delta=1e-12)
        self.assertGreater(sine["processor"], 0)

    def test_a_scene_that_is_refused_has_its_sentence_place_and_number(self):
        self.scene("wrong.ups", SINE.replace("<density>1<", "<density>-1<"))
        wrong = self.covered()["wrong.ups"]
        self.assertEqual((wrong["result"], wrong["code"], wrong["steps"]), ("refused", 3, 0))
        problem = wrong["problems"][0]
        self.assertTrue(problem["sentence"].startswith("Heat/density: "), problem)
        self.assertRegex(problem["number"], r"^T\d+$")
        self.assertRegex(problem["place"], r"^wrong\.ups:\d+:\d+$")

    def test_a_value_of_several_lines_is_part_of_its_sentence(self):
        self.scene("wrong.ups", SINE.replace("<density>1<", "<density>1,\n  2<"))
        problems = self.covered()["wrong.ups"]["problems"]
        self.assertEqual(len(problems), 1)
        self.assertTrue(problems[0]["sentence"].startswith("Heat/density: found '1, 2'"), problems)
        self.assertRegex(problems[0]["number"], r"^T\d+$")

    def test_a_scene_that_fails_has_its_sentence(self):
        self.scene("dying.ups", dying())
        died = self.covered()["dying.ups"]
        self.assertEqual((died["result"], died["code"]), ("failed", 4))
        self.assertEqual(len(died["problems"]), 1)
        self.assertFalse(died["problems"][0]["sentence"].startswith("sus"), died)
        self.assertGreater(died["steps"], 0)

    def test_a_scene_that_does_not_end_is_stopped(self):
        self.scene("endless.ups", ENDLESS)
        endless = self.covered("--limit", "1.5")["endless.ups"]
        self.assertEqual(endless["result"], "stopped")
        self.assertTrue(1.5 <= endless["wall"] < 15, endless)
        self.assertRegex(endless["problems"][0]["sentence"], r"^stopped after \d+ s, \d+ s of processor time, at t = ")

    def test_a_scene_is_stopped_after_its_processor_time(self):
        self.scene("endless.ups", ENDLESS)
        endless = self.covered("--processor-limit", ".8", "--limit", "100")["endless.ups"]
        self.assertEqual(endless["result"], "stopped")
        self.assertTrue(.8 <= endless["processor"] < 3, endless)

    def test_notes_are_counted_and_are_no_problem(self):
        self.scene("noted.ups", NOTED)
        noted = self.covered("--set", "Time/max_Timesteps=2")["noted.ups"]
        self.assertEqual((noted["result"], noted["notes"], noted["steps"]), ("ran", 1, 2))

    def test_nothing_is_left_beside_the_scenes_nor_elsewhere(self):
        for name, text in (("sine.ups", SINE), ("dying.ups", dying())):
            self.scene(name, text)
        self.covered("--markdown", "all.md")
        self.assertEqual(sorted(os.listdir(self.here / "scenes")), ["deep", "dying.ups", "sine.ups"])
        self.assertEqual(sorted(os.listdir(self.here)), ["all.json", "all.md", "scenes", "temporary"])
        self.assertEqual([path.name for path in (self.here / "temporary").iterdir() if "coverage" in path.name], [])

    def test_sentences_are_counted_by_the_scenes_that_they_refuse(self):
        one = SINE.replace("<Heat>", "<Heat><colour>1</colour>")
        self.scene("one.ups", one)
        self.scene("another.ups", one)
        self.scene("both.ups", one.replace("<density>1<", "<density>-1<"))
        self.scene("right.ups", SINE)
        (self.here / "named.txt").write_text("right.ups\nboth.ups\nelsewhere.ups\n")
        self.covered("--jobs", "2", "--markdown", "all.md", "--among", "named.txt")
        known = self.known()
        self.assertEqual(known["counts"], {
            "heat": {"ran": 1, "stopped": 0, "refused": 3, "failed": 0, "scenes": 4},
            "heat, among those named": {"ran": 1, "stopped": 0, "refused": 1, "failed": 0, "scenes": 2}})
        first, second = known["blockers"]
        self.assertEqual((first["scenes"], first["alone"]), (["another.ups", "both.ups", "one.ups"], 2))
        self.assertEqual((second["scenes"], second["alone"]), (["both.ups"], 0))
        page = (self.here / "all.md").read_text()
        self.assertRegex(page, r"\| Heat/colour: unknown tag .* \| T101 \| 3 \| 2 \|")
        self.assertRegex(page, r"\| right\.ups \| heat \| yes \| ran \| 64 \| \d+ \|")

    def test_types_links_and_parts_of_scenes(self):
        self.scene("sine.ups", SINE)
        self.scene("part.ups", "<Uintah_Include><density>1</density></Uintah_Include>")
        self.scene("arches.ups", '<Uintah_specification><SimulationComponent type = "Arches"/></Uintah_specification>')
        self.scene("deep/commented.ups", SINE.replace("<Meta>", '<!-- <SimulationComponent type="mpm"/> --><Meta>'))
        (self.here / "scenes/deep/link.ups").symlink_to("../sine.ups")
        self.assertEqual(set(self.covered("--check")), {"sine.ups", "arches.ups", "deep/commented.ups"})
        self.assertEqual(set(self.covered("--check", "--type", "heat,ice")), {"sine.ups", "deep/commented.ups"})
        code, out, errors = self.run_tool("--type", "ice")
        self.assertEqual(code, 2)
        self.assertIn("has no scene of type ice; there are arches, heat", errors)

    def test_checks_without_running(self):
        self.scene("endless.ups", ENDLESS)
        endless = self.covered("--check")["endless.ups"]
        self.assertEqual((endless["result"], endless["steps"]), ("ran", 0))

    def test_ctrl_c_ends_it_with_what_is_known(self):
        self.scene("a.ups", SINE)
        self.scene("b.ups", ENDLESS)
        process = self.start("--limit", "100")
        while "a.ups" not in process.stdout.readline():
            self.assertIsNone(process.poll())
        time.sleep(.5)
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=30)
        self.assertEqual((process.returncode, errors), (5, "coverage: stopped\n"))
        self.assertIn("| heat | 1 | 1 | 0 | 0 | 0 |", out)
        self.assertEqual([scene["scene"] for scene in self.known()["scenes"]], ["a.ups"])
        self.assertEqual([path.name for path in (self.here / "temporary").iterdir() if "coverage" in path.name], [])

    def test_wrong_calls(self):
        self.scene("sine.ups", SINE)
        for words, code, sentence in ((("--limit", "0"), 2, "found '0', expected a number above 0"),
                                      (("--jobs", "none"), 2, "found 'none', expected a whole number"),
                                      (("--set", "Time"), 2, "found 'Time', expected PATH=VALUE"),
                                      (("--sus", "no/such/sus"), 2, "'no/such/sus' is not a program"),
                                      (("--markdown", "no/such/folder.md"), 1,
                                       "coverage: 'no/such/folder.md': No such file or directory")):
            with self.subTest(words):
                ended, _, errors = self.run_tool(*words)
                self.assertEqual(ended, code, errors)
                self.assertIn(sentence, errors)
        ended, _, errors = self.run_tool(folder="nowhere")
        self.assertEqual(ended, 2)
        self.assertIn("there is no folder", errors)


if __name__ == "__main__":
    unittest.main()
