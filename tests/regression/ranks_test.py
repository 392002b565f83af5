#!/usr/bin/env python3
"""Runs under mpirun: the same bits, the same files, restarts on other ranks, and what a fault on one rank leaves."""
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, on_ranks
from uda import Folder

SOD = "ups/mpm/sod.ups"
PATCHES = "Grid/Level/Box/patches=[7,1,1]"
FINE = ("Grid/Level/Box/resolution=[5000,1,1]", "Grid/Level/Box/patches=[12,1,1]")
EVERY = ("DataArchiver/checkpoint/@timestepInterval=10", "DataArchiver/checkpoint/@cycle=2")
PATIENCE = 200  # seconds after which a job hangs, even on a machine with much else to do


class Ranks(unittest.TestCase):
    def folder(self, ranks, on_disk=False):
        here = Folder(on_disk, ranks)
        self.addCleanup(here.cleanup)
        return here

    def start(self, here, words, sets):
        """A job in a process group of its own."""
        return subprocess.Popen(here.command(words, sets), cwd=ROOT, stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def ranks_of(self, job):
        """Process ids of the ranks, once all are there."""
        while True:
            found = subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True).stdout.split()
            if len(found) == 3:
                return [int(pid) for pid in found]
            time.sleep(0.01)

    def assert_over(self, job, sentence, times=1):
        """The job ends, badly, and says why once."""
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertNotEqual(job.returncode, 0)
        self.assertEqual(errors.count(sentence), times, errors)
        return errors

    def uncut(self):
        code, errors, report = self.folder(1).run(SOD)
        self.assertEqual((code, errors), (0, ""))
        return report

    def test_one_report_the_same_bits_and_the_same_files(self):
        alone, several = self.folder(1), self.folder(3)
        expected = alone.run(SOD, PATCHES)[2]
        code, errors, report = several.run(SOD, PATCHES)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(report["layout"]["ranks"], 3)
        for key in ("fingerprint", "steps", "time", "particles", "drift", "errors"):
            self.assertEqual(report[key], expected[key], key)
        for file in alone.uda.glob("t*.h5"):
            self.assertEqual((several.uda / file.name).read_bytes(), file.read_bytes(), file.name)
        for name in ("index.xml", "sod.xdmf", "KineticEnergy.dat"):
            self.assertEqual((several.uda / name).read_text(), (alone.uda / name).read_text())

    def test_a_run_goes_on_from_any_ranks_on_any_others(self):
        fingerprint = self.uncut()["fingerprint"]
        for before, after in ((3, 1), (1, 2), (2, 4)):
            here = self.folder(before)
            self.assertEqual(here.run(SOD, *EVERY, "Time/max_Timesteps=120", PATCHES)[:2], (0, ""))
            here.ranks = after
            code, errors, report = here.restart("Time/max_Timesteps=1000", "Grid/Level/Box/patches=[3,1,1]")
            self.assertEqual((code, errors, report["fingerprint"]), (0, "", fingerprint))

    def test_a_rank_that_is_killed_at_any_instant_ends_the_job_and_the_run_goes_on(self):
        fingerprint = self.uncut()["fingerprint"]
        chance = random.Random(5)
        kills = 0
        while kills < 3:
            here = self.folder(3, on_disk=True)
            job = self.start(here, [SOD, "--output", here.path], (*EVERY, PATCHES))
            ranks = self.ranks_of(job)
            while not list(here.path.glob("*.uda/checkpoints/LATEST")) and job.poll() is None:
                time.sleep(0.01)
            time.sleep(chance.uniform(0, 0.3))
            if job.poll() is None:
                os.kill(chance.choice(ranks), signal.SIGKILL)
                self.assertNotEqual(job.wait(timeout=PATIENCE), 0)
            job.communicate()
            kills += 1
            here.ranks = chance.choice((1, 2, 3))
            code, _, report = here.restart("Grid/Level/Box/patches=[4,1,1]")
            self.assertEqual((code, report["fingerprint"]), (0, fingerprint))

    def test_sigterm_leaves_a_checkpoint(self):
        here = self.folder(3)
        job = self.start(here, [SOD, "--output", here.path], FINE)
        while not list(here.path.glob("*.uda/t00000.h5")):
            time.sleep(0.01)
        for rank in self.ranks_of(job):
            os.kill(rank, signal.SIGTERM)
        job.communicate(timeout=PATIENCE)
        self.assertEqual((job.returncode, len(here.checkpoints)), (5, 1))
        step = int(here.checkpoints[0].name[1:])
        end = f"Time/max_Timesteps={step + 20}"
        expected = self.folder(1).run(SOD, *FINE, end)[2]
        self.assertEqual(here.restart(end)[2]["fingerprint"], expected["fingerprint"])

    def test_a_mistake_in_the_scene_is_told_once(self):
        job = self.start(self.folder(3), [SOD], ("MPM/gas_dynamics/cfl=-1",))
        self.assert_over(job, "expected a value greater than 0")
        self.assertEqual(job.returncode, 3)

    def test_what_one_rank_cannot_do_ends_all_with_one_sentence(self):
        parts = (f"{SUS} {scene} --quiet --set DataArchiver/outputInterval=0" for scene in (SOD, "gone.ups", SOD))
        with tempfile.TemporaryDirectory() as folder:
            line = "mpirun --oversubscribe -n 1 " + " : -n 1 ".join(f"{part} --output {folder}" for part in parts)
            job = subprocess.Popen(line.split(), cwd=ROOT, stderr=subprocess.PIPE, text=True)
            self.assertIn("(rank 1 of 3)", self.assert_over(job, "gone.ups"))

    def test_a_folder_that_cannot_be_written_ends_all(self):
        self.assert_over(self.start(self.folder(3), [SOD, "--output", "/proc"], ()), "sus: ")

    def test_a_full_disk_ends_all_and_leaves_the_last_checkpoint_whole(self):
        here = self.folder(3)
        small = here.path / "small"
        small.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=700k", "none", small], capture_output=True).returncode:
            self.skipTest("only root may make a small disk")
        self.addCleanup(subprocess.run, ["umount", small], check=True)
        job = self.start(here, [SOD, "--output", small], (*EVERY, "DataArchiver/outputTimestepInterval=1",
                                                          "DataArchiver/outputInterval=0"))
        self.assert_over(job, "No space left on device")
        for output in small.glob("*.uda.000/t*.h5"):
            output.unlink()
        uda = next(small.glob("*.uda"))
        done = subprocess.run([SUS, "-restart", uda, "--quiet", "--set", "Time/max_Timesteps=1"], cwd=ROOT,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_value_that_cannot_be_is_told_as_on_one_rank(self):
        text = (ROOT / "ups/mpm/sod_redistribute.ups").read_text()
        start, end = text.index("      <redistribute>"), text.index("</redistribute>") + len("</redistribute>")
        said = []
        for ranks in (1, 3):
            here = self.folder(ranks)
            scene = here.path / "bare.ups"
            scene.write_text(text[:start] + text[end:])
            code, errors, _ = here.run(scene, PATCHES)
            self.assertEqual(code, 4)
            sentence = [line for line in errors.splitlines() if line.startswith("sus:")]
            said.append([re.sub("saved: .*", "", line) for line in sentence])
        self.assertEqual(said[0], said[1])

    def test_questions_are_answered_once(self):
        for words in (["--version"], ["--list"], [SOD, "--schedule"], [SOD, "--check"]):
            alone = subprocess.run([SUS, *words], cwd=ROOT, capture_output=True, text=True)
            several = subprocess.run([*on_ranks(3), SUS, *words], cwd=ROOT, capture_output=True, text=True)
            self.assertEqual((several.returncode, several.stdout), (0, alone.stdout), words)


if __name__ == "__main__":
    unittest.main()
