#!/usr/bin/env python3
"""A run that is killed at any instant, also while it writes, on one rank or on several, continues from its last
checkpoint to bitwise equal results.

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
BOX = "Grid/Level/Box"
# Outputs of some megabytes, which are written while steps go on.
LARGE = (f"{BOX}/resolution=[150,60,1]", f"{BOX}/upper=[1,.4,1]", "DataArchiver/outputInterval=0",
         "DataArchiver/outputTimestepInterval=2", "Time/max_Timesteps=30")
LAYOUTS = ("1x1x1", "3x1x1", "4x1x1", "7x1x1")
PATIENCE = 1200  # seconds after which a job hangs, even on a machine with much else to do


def children(pid):
    return [int(child) for child in subprocess.run(["pgrep", "-P", str(pid)], capture_output=True,
                                                   text=True).stdout.split()]


class Kills(unittest.TestCase):
    def setUp(self):
        self.chance = random.Random(50)
        self.kills = self.in_checkpoint = self.in_output = 0

    def folder(self, ranks):
        here = Folder(on_disk=True, ranks=ranks)
        self.addCleanup(here.cleanup)
        return here

    def killed(self, here, words, sets, what=None):
        """Starts a job, kills one of its processes (or all) at a random instant after its first checkpoint, or while
        a file is written that fits a pattern, and waits for its end. Whether the job was killed before it was done."""
        job = subprocess.Popen(here.command(words, sets), cwd=ROOT, stderr=subprocess.DEVNULL)
        while not list(here.path.glob("*.uda/checkpoints/LATEST")) and job.poll() is None:
            time.sleep(0.002)
        time.sleep(self.chance.uniform(0, 0.5))
        while what and not list(here.path.glob(what)) and job.poll() is None:
            time.sleep(0.0005)
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
        self.in_output += killed and bool(list(here.path.glob("*.uda/*.h5.tmp")))
        return killed

    def assert_reads(self, here):
        """Asserts that the lists of a killed run are complete and name existing outputs."""
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
        self.tell()

    def test_a_run_that_is_killed_while_writers_write_has_whole_outputs_and_goes_on_to_the_same_bits(self):
        uncut = self.folder(1)
        code, errors, report = uncut.run(SOD, *LARGE)
        self.assertEqual((code, errors), (0, ""))
        outputs = {file.name: file.read_bytes() for file in uncut.uda.glob("t*.h5")}
        self.assertEqual(len(outputs), 16)
        while self.kills < KILLS:
            here = self.folder((2, 3)[self.kills % 2])
            sets = [*LARGE, "DataArchiver/checkpoint/@timestepInterval=3"]
            behind = ["-behind", self.chance.choice((2, 32))]
            what = self.chance.choice((None, "*.uda.000/*.h5.tmp", "*.uda.000/*.h5.tmp", "*.uda.000/checkpoints/*.tmp"))
            self.killed(here, [SOD, "--output", here.path, *self.layout(), *behind], sets, what)
            for file in here.uda.glob("t*.h5"):
                self.assertTrue(file.read_bytes() == outputs[file.name], file)
            here.ranks = self.chance.choice((1, 2, 3))
            code, errors, again = here.finish(["-restart", here.uda, *self.layout(), *behind], [])
            self.assertEqual((code, errors, again["fingerprint"]), (0, "", report["fingerprint"]))
            self.assertEqual({file.name for file in here.uda.glob("t*")}, outputs.keys())
            for file in here.uda.glob("t*.h5"):
                self.assertTrue(file.read_bytes() == outputs[file.name], file)
            here.cleanup()
        self.tell()

    def tell(self):
        print(f"{self.kills} kills, {self.in_checkpoint} of them while a checkpoint was written, {self.in_output} "
              "while an output was", file=sys.stderr)


if __name__ == "__main__":
    unittest.main()
