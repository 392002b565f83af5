#!/usr/bin/env python3
"""Golden schedules: what each scene runs, reads and writes, and what it leaves out; those of ups/stability run what
others run.

After a wanted change, and for a new scene: python3 tests/regression/schedules_test.py --write, and look at the
difference.
"""
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


if __name__ == "__main__":
    if "--write" in sys.argv:
        for name, text in schedules():
            (GOLDEN / name).write_text(text)
    else:
        unittest.main()
