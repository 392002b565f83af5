#!/usr/bin/env python3
"""A run that is killed at any instant, on one rank or on three, goes on from its last checkpoint to the same bits.

A few kills; KILLS=50 tests/regression/kills_test.py makes more.
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree as ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT
from uda import Folder

KILLS = int(os.environ.get("KILLS", 6))
SOD = "ups/mpm/sod.ups"
LAYOUTS = ("1x1x1", "3x1x1", "4x1x1", "7x1x1")
PATIENCE = 1200  # seconds after which a job hangs, even on a machine with much else to do


def children(pid):
    return [int(child) for child in subprocess.run(["pgrep", "-P", str(pid)], capture_output=True,
                                                   text=True).stdout.split()]


class Kills(unittest.TestCase):
    def setUp(self):
        self.chance = random.Random(50)
        self.kills = self.in_checkpoint = 0

    def folder(self, ranks):
        here = Folder(on_disk=True, ranks=ranks)
        self.addCleanup(here.cleanup)
        return here

    def killed(self, here, words, sets):
        """Starts a job, kills one of its processes (or all) at a random instant after its first checkpoint, and waits
        for its end. Whether the job was killed before it was done."""
        job = subprocess.Popen(here.command(words, sets), cwd=ROOT, stderr=subprocess.DEVNULL)
        while not list(here.path.glob("*.uda/checkpoints/LATEST")) and job.poll() is None:
            time.sleep(0.002)
        time.sleep(self.chance.uniform(0, 0.5))
        ranks = children(job.pid) if here.ranks > 1 else [job.pid]
        for rank in self.chance.choice((ranks, ranks[:1], ranks[-1:])):
            try:
                os.kill(rank, signal.SIGKILL)
            except ProcessLookupError:
                pass
        killed = job.wait(timeout=PATIENCE) != 0
        self.kills += killed
        self.assert_reads(here)
        self.in_checkpoint += killed and bool(list(here.path.glob("*.uda/checkpoints/*.tmp")))
        return killed

    def assert_reads(self, here):
        """The lists of a killed run are whole, and name outputs that are there."""
        for uda in here.path.glob("*.uda"):
            listed = ElementTree.parse(uda / "index.xml").iterfind("timesteps/timestep")
            self.assertEqual([at.get("href") for at in listed if not (uda / at.get("href")).exists()], [])
            for shown in uda.glob("*.xdmf"):
                ElementTree.parse(shown)
            for run in json.loads((uda / "run.json").read_text())["runs"] if (uda / "run.json").exists() else ():
                self.assertIn("command", run)

    def layout(self):
        return ["-layout", self.chance.choice(LAYOUTS), "-writers", str(self.chance.choice((1, 2, 3)))]

    def test_a_run_that_is_killed_ends_with_the_bits_of_the_uncut_one(self):
        uncut = self.folder(1)
        code, errors, report = uncut.run(SOD)
        self.assertEqual((code, errors), (0, ""))
        while self.kills < KILLS:
            here = self.folder((1, 3)[self.kills % 2])
            sets = [f"DataArchiver/checkpoint/@timestepInterval={self.chance.choice((5, 20))}",
                    f"DataArchiver/checkpoint/@cycle={self.chance.choice((1, 2))}"]
            lives = self.killed(here, [SOD, "--output", here.path, *self.layout()], sets)
            while lives and self.chance.random() < 0.3:
                lives = self.killed(here, ["-restart", here.uda, *self.layout()], [])
            here.ranks = self.chance.choice((1, 2, 3))
            code, errors, again = here.finish(["-restart", here.uda, *self.layout()], [])
            self.assertEqual((code, errors, again["fingerprint"]), (0, "", report["fingerprint"]))
            for name in ("index.xml", "sod.xdmf", "KineticEnergy.dat"):
                self.assertEqual((here.uda / name).read_text(), (uncut.uda / name).read_text())
        print(f"{self.kills} kills, {self.in_checkpoint} of them while a checkpoint was written", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
