#!/usr/bin/env python3
"""`sus -check -json SCENE` reports the problems of a scene in a form for programs."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

SOD = "ups/mpm/sod.ups"


def sus(*words):
    return subprocess.run([SUS, *words], cwd=ROOT, capture_output=True, text=True)


class CheckJson(unittest.TestCase):
    def test_a_scene_without_problems(self):
        for words in (["-check", "-json", SOD], ["-check", SOD, "-json"], ["-validate", "--json", "-", SOD],
                      ["--json", "-check", SOD]):
            done = sus(*words)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "[]\n", ""), words)

    def test_all_problems_with_their_places(self):
        text = (ROOT / SOD).read_text().replace("<maxTime>0.2", "<maxTime>-1")
        text = text.replace("<cfl>", "<cfk>").replace("</cfl>", "</cfk>")
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(text)
            done, plain = sus("-check", "-json", scene), sus("-check", scene)
        self.assertEqual((done.returncode, done.stderr), (3, ""))
        problems = json.loads(done.stdout)
        keys = ["file", "line", "column", "path", "message", "number"]
        self.assertEqual([list(problem) for problem in problems], [keys, [*keys, "suggestion"]])
        first, second = problems
        self.assertEqual((first["file"], first["line"], first["path"]), (str(scene), 14, "Time/maxTime"))
        self.assertIn("expected a value greater than 0", first["message"])
        self.assertEqual(second["suggestion"], "cfl")
        lines = [f"{one['file']}:{one['line']}:{one['column']}: {one['path']}: {one['message']} [{one['number']}]"
                 for one in problems]
        self.assertEqual("\n".join(lines) + "\n", plain.stderr)

    def test_an_override_has_no_line(self):
        done = sus("-check", "-json", SOD, "--set", "Time/maxTime=soon")
        self.assertEqual(done.returncode, 3)
        problem, = json.loads(done.stdout)
        self.assertEqual((problem["file"], problem["line"], problem["column"]), ("--set Time/maxTime=soon", 0, 0))

    def test_a_file_beside_what_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            for sets, code in (([], 0), (["--set", "Time/maxTime=0"], 3)):
                file = pathlib.Path(folder, "problems.json")
                done, plain = sus("-check", "-json", file, SOD, *sets), sus("-check", SOD, *sets)
                self.assertEqual((done.returncode, done.stdout, done.stderr), (code, plain.stdout, plain.stderr))
                self.assertEqual(len(json.loads(file.read_text())), 1 if sets else 0)

    def test_a_missing_scene(self):
        done = sus("-check", "-json", "ups/none.ups")
        self.assertEqual((done.returncode, json.loads(done.stdout)[0]["message"]), (3, "there is no such file"))

    def test_a_report_needs_a_file(self):
        done = sus(SOD, "-json")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "sus: --json needs a file name for the report [T701]\n"))


if __name__ == "__main__":
    unittest.main()
