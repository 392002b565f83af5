#!/usr/bin/env python3
"""A small body in a large grid: the grid is cut where the particles are, which changes no bit, also while the body
moves, on ranks and after a restart."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, run

SCENE = "tests/benchmark/spheres.ups"
BODY = "MaterialProperties/MPM/material/geom_object"
# One small ball that crosses half of the box.
SMALL = ("Grid/Level/Box/resolution=[40,30,30]", f"{BODY}[1]/sphere/radius=.08", f"{BODY}[1]/sphere/origin=[.15,.2,.2]",
         f"{BODY}[2]/sphere/radius=.05", f"{BODY}[2]/sphere/origin=[.35,.1,.2]", f"{BODY}[1]/velocity=[20,10,10]",
         f"{BODY}[2]/velocity=[20,10,10]", "Time/max_Timesteps=160")


def report(*options, ranks=1, sets=SMALL):
    result = run(SCENE, *sets, options=("--quiet", *options), ranks=ranks)
    assert result.report, result.err
    return result.report


class SmallBody(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.one = report("--nthreads", "1", "--layout", "1x1x1")

    def test_moves_the_cuts_and_no_bit(self):
        two = report("--nthreads", "2")
        self.assertGreater(two["layout"]["recuts"], 1, "at the start, and as the ball moves")
        self.assertGreater(two["layout"]["patches"], 1)
        self.assertEqual(two["fingerprint"], self.one["fingerprint"])

    def test_moves_the_cuts_between_ranks(self):
        two = report("--nthreads", "1", ranks=2)
        self.assertGreater(two["layout"]["recuts"], 1)
        self.assertEqual(two["fingerprint"], self.one["fingerprint"])
        start = report("--nthreads", "1", ranks=2, sets=(*SMALL, "Time/max_Timesteps=2"))
        self.assertEqual(start["wall"]["rebalanced"]["times"], 0, "cuts come with shares of their own")

    def test_stays_where_the_user_cuts_or_one_thread_works(self):
        for options in (("--nthreads", "2", "--layout", "2x2x2"), ("--nthreads", "1")):
            found = report(*options)
            self.assertNotIn("recuts", found["layout"], options)
            self.assertEqual(found["fingerprint"], self.one["fingerprint"])

    def test_goes_on_after_a_restart_with_the_same_bits(self):
        with tempfile.TemporaryDirectory() as folder:
            start = [SUS, SCENE, "--quiet", "--nthreads", "2", "--output", folder]
            for override in (*SMALL, "Time/max_Timesteps=70", "DataArchiver/checkpoint/@timestepInterval=70",
                             "DataArchiver/outputInterval=0"):
                start += ["--set", override]
            subprocess.run(start, cwd=ROOT, check=True)
            uda = next(pathlib.Path(folder).glob("*.uda.000"))
            path = pathlib.Path(folder, "report.json")
            subprocess.run([SUS, "--restart", uda, "--quiet", "--nthreads", "2", "--json", path, "--set",
                            "Time/max_Timesteps=160"], cwd=folder, check=True)
            self.assertIn(self.one["fingerprint"], path.read_text())


if __name__ == "__main__":
    unittest.main()
