#!/usr/bin/env python3
"""Golden schedules: what each scene runs, reads and writes, and what it leaves out; those of ups/stability run what
others run.

After a wanted change, and for a new scene: python3 tests/regression/schedules_test.py --write, and look at the
difference.
"""
import os
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

GOLDEN = ROOT / "tests/golden"


def schedules():
    """Returns the current schedule of sus by the name of its golden file."""
    for scene in sorted((ROOT / "ups").rglob("*.ups")):
        if scene.parent.name == "stability":
            continue
        text = subprocess.run([SUS, "--schedule", scene], capture_output=True, text=True, check=True).stdout
        yield scene.parent.name + "_" + scene.stem + ".txt", text


class Schedules(unittest.TestCase):
    def test_every_scene_runs_what_it_ran(self):
        self.maxDiff = None
        for name, text in schedules():
            self.assertTrue((GOLDEN / name).exists(), f"tests/golden/{name} is missing; make it by: python3 "
                                                      "tests/regression/schedules_test.py --write")
            self.assertEqual((GOLDEN / name).read_text(), text, name)


    def test_without_a_program_it_says_what_to_run_first(self):
        done = subprocess.run([sys.executable, __file__, "--write"], env={**os.environ, "SUS": "/none/sus"},
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "schedules_test: there is no program '/none/sus'; first "
                                                          "run cmake --preset dev && cmake --build --preset dev, or "
                                                          "name another one: SUS=build/release/sus\n"))


def write():
    """Writes the golden files anew; ends the program with a sentence if there is no sus."""
    if not os.access(SUS, os.X_OK):
        sys.exit(f"schedules_test: there is no program '{SUS}'; first run cmake --preset dev && cmake --build --preset "
                 "dev, or name another one: SUS=build/release/sus")
    for name, text in schedules():
        (GOLDEN / name).write_text(text)


if __name__ == "__main__":
    if "--write" in sys.argv:
        write()
    else:
        unittest.main()
