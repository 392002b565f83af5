#!/usr/bin/env python3
"""Tests of tools/projection, which plots the error of the mass projection."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
from tushar.interpreter import ensure

ensure("h5py", "matplotlib")


class Projection(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name, "out.svg")

    def run_tool(self, *arguments):
        return subprocess.run([sys.executable, ROOT / "tools/projection", *arguments, "--sus", SUS, "--out", self.out],
                              capture_output=True, text=True)

    def test_draws_the_four_cases_each_with_its_maximum(self):
        done = self.run_tool("--set", "Grid/Level/Box/resolution=[50,1,1]")
        self.assertEqual(done.returncode, 0, done.stderr)
        most = [float(number) for number in re.findall(r"at most (\S+) of its bound", done.stdout)]
        self.assertEqual(len(most), 4)
        self.assertLess(most[0], 1e-3)
        self.assertTrue(all(.3 < ratio < 1 for ratio in most[1:]))
        svg = self.out.read_text()
        for words in ("midpoints: at most", "jittered: at most", "random: at most",
                      "after a run to t = 0.3 s: at most"):
            self.assertIn(words, svg)

    def test_says_what_a_scene_lacks(self):
        done = self.run_tool(ROOT / "ups/mpm/smooth_wave.ups")
        self.assertEqual(done.returncode, 1)
        self.assertIn("projection: no cell or node variable 'g.massProjectionError'", done.stderr)


if __name__ == "__main__":
    unittest.main()
