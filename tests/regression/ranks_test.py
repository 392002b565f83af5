#!/usr/bin/env python3
"""Runs under mpirun: bitwise equal results, equal files, restarts on other ranks, and faults on one rank."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import FAULTY_SUS, ROOT, SUS, on_ranks
from uda import FolderTest

SOD = "ups/mpm/sod.ups"
PATCHES = "Grid/Level/Box/patches=[7,1,1]"
FINE = ("Grid/Level/Box/resolution=[5000,1,1]", "Grid/Level/Box/patches=[12,1,1]")
EVERY = ("DataArchiver/checkpoint/@timestepInterval=10", "DataArchiver/checkpoint/@cycle=2")
PATIENCE = 200  # seconds after which a job hangs, even on a machine with much else to do
OVER = 10  # seconds after which a job that has lost a rank, or its disk, hangs


class Ranks(FolderTest):
    def start(self, here, words, sets):
        """Starts a job in a process group of its own."""
        return subprocess.Popen(here.command(words, sets), cwd=ROOT, stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def ranks_of(self, job):
        """Returns the process ids of the ranks, once all have started."""
        while True:
            found = subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True).stdout.split()
            if len(found) == 3:
                return [int(pid) for pid in found]
            time.sleep(0.01)

    def assert_over(self, job, sentence, times=1):
        """Asserts that the job ends with an error and reports the reason once."""
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertNotEqual(job.returncode, 0)
        self.assertEqual(errors.count(sentence), times, errors)
        return errors

    def assert_soon(self, folder):
        """Asserts that at most OVER seconds have passed since the finished job wrote its last file."""
        last = max(path.stat().st_mtime for path in folder.rglob("*") if path.is_file())
        self.assertLess(time.time() - last, OVER)

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
        for file in [*alone.uda.glob("t*.h5"), *alone.uda.glob("*.vtkhdf")]:
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

    def start_each(self, folder, *scenes):
        """Starts a job in which each rank runs a scene of its own."""
        parts = (f"{SUS} {scene} --quiet --set DataArchiver/outputInterval=0 --output {folder}" for scene in scenes)
        line = "mpirun --oversubscribe -n 1 " + " : -n 1 ".join(parts)
        return subprocess.Popen(line.split(), cwd=ROOT, stderr=subprocess.PIPE, text=True)

    def test_what_one_rank_cannot_do_ends_all_with_one_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            job = self.start_each(folder, SOD, "gone.ups", SOD)
            self.assertIn("(rank 1 of 3)", self.assert_over(job, "gone.ups"))

    def test_what_two_ranks_cannot_do_is_told_by_one_while_a_third_waits(self):
        with tempfile.TemporaryDirectory() as folder:
            job = self.start_each(folder, SOD, "gone.ups", "missing.ups")
            self.assertNotIn("missing.ups", self.assert_over(job, "gone.ups"))

    def test_a_throw_in_a_task_of_one_rank_ends_all_with_one_sentence(self):
        here = self.folder(3)  # with one patch each, which none can better give to another
        command = here.command(["ups/heat/sine.ups", "-layout", "3x1x1", "--output", here.path], EVERY)
        job = subprocess.Popen([FAULTY_SUS if word == SUS else word for word in command], cwd=ROOT,
                               stderr=subprocess.PIPE, text=True)
        errors = self.assert_over(job, "sus: made to fail (task faulty::fail, patch 1, step ")
        self.assert_soon(here.path)
        self.assertEqual(re.findall(r"\(rank \d of \d\)", errors), ["(rank 1 of 3)"], errors)
        code, errors, report = here.restart()
        self.assertEqual((code, errors, report["ended"]), (0, "", "maxTime"))

    def test_what_a_task_of_one_rank_finds_wrong_with_the_scene_ends_all_with_one_sentence(self):
        job = self.start(self.folder(3), ["ups/heat/sine.ups", "-layout", "3x1x1"],
                         ("Heat/temperature=x>0.4 && x<0.6 ? 0/0 : 1",))
        self.assert_over(job, "must be finite everywhere")
        self.assertEqual(job.returncode, 3)

    def test_a_folder_that_cannot_be_written_ends_all(self):
        self.assert_over(self.start(self.folder(3), [SOD, "--output", "/proc"], ()), "sus: ")

    def test_a_full_disk_ends_all_and_leaves_the_last_checkpoint_whole(self):
        here = self.folder(3)
        small = self.small_disk(here.path, "700k")
        job = self.start(here, [SOD, "--output", small], (*EVERY, "DataArchiver/outputTimestepInterval=1",
                                                          "DataArchiver/outputInterval=0"))
        self.assert_over(job, "No space left on device")
        self.assert_soon(small)
        for output in small.glob("*.uda.000/t*.h5"):
            output.unlink()
        uda = next(small.glob("*.uda"))
        done = subprocess.run([SUS, "-restart", uda, "--quiet", "--set", "Time/max_Timesteps=1"], cwd=ROOT,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_killed_rank_ends_the_job_and_the_last_checkpoint_restarts(self):
        here = self.folder(3)
        job = self.start(here, [SOD, "--output", here.path], (*FINE, *EVERY))
        while not list(here.path.glob("*.uda/checkpoints/LATEST")):
            time.sleep(0.01)
        os.kill(self.ranks_of(job)[1], signal.SIGKILL)
        errors = job.communicate(timeout=OVER)[1]
        self.assertNotEqual(job.returncode, 0)
        self.assertEqual(errors.count("signal 9 (Killed)"), 1, errors)
        here.ranks = 1
        end = f"Time/max_Timesteps={int(here.checkpoints[-1].name[1:]) + 10}"
        self.assertEqual(here.restart(end)[2]["fingerprint"], self.folder(2).run(SOD, *FINE, end)[2]["fingerprint"])

    def bare(self, here):
        """Sod's tube by the paper's method with one particle per cell, which empties a cell."""
        text = (ROOT / "ups/mpm/sod_redistribute.ups").read_text()
        start, end = text.index("      <redistribute>"), text.index("</redistribute>") + len("</redistribute>")
        scene = here.path / "bare.ups"
        scene.write_text(text[:start] + text[end:])
        return scene

    def test_a_step_is_repeated_on_all_ranks_to_the_same_bits(self):
        found = set()
        for ranks in (1, 2, 3):
            here = self.folder(ranks)
            code, errors, report = here.run(self.bare(here), PATCHES, "Time/recompute_timestep=true")
            self.assertEqual((code, errors), (0, ""))
            self.assertGreater(report["retries"], 0)
            found.add((report["fingerprint"], report["steps"], report["retries"]))
        self.assertEqual(len(found), 1, found)

    def test_a_value_that_cannot_be_is_told_as_on_one_rank(self):
        said = []
        for ranks in (1, 3):
            here = self.folder(ranks)
            code, errors, _ = here.run(self.bare(here), PATCHES)
            self.assertEqual(code, 4)
            sentence = [line for line in errors.splitlines() if line.startswith("sus:")]
            said.append([re.sub("saved: .*", "", line) for line in sentence])
        self.assertEqual(said[0], said[1])

    def test_a_rank_without_a_patch_lets_the_others_solve(self):
        solved = [self.folder(ranks).run("ups/poisson/sine.ups", "Grid/Level/Box/patches=[2,1,1]")[2]["errors"]
                  for ranks in (2, 3)]
        self.assertEqual(solved[0], solved[1])

    def test_questions_are_answered_once(self):
        for words in (["--version"], ["--list"], [SOD, "--schedule"], [SOD, "--check"]):
            alone = subprocess.run([SUS, *words], cwd=ROOT, capture_output=True, text=True)
            several = subprocess.run([*on_ranks(3), SUS, *words], cwd=ROOT, capture_output=True, text=True)
            self.assertEqual((several.returncode, several.stdout), (0, alone.stdout), words)

    def test_patches_change_ranks_where_particles_are_few_on_some_and_no_bit_changes(self):
        scene, end = "ups/solid/two_discs.ups", "Time/max_Timesteps=20"
        alone, several = (self.well(self.folder(ranks).run(scene, end, layout="[8,8,1]")) for ranks in (1, 3))
        self.assertEqual(several["fingerprint"], alone["fingerprint"])
        changes = several["wall"]["rebalanced"]
        self.assertGreaterEqual(changes["times"], 1)
        self.assertLess(changes["after"], changes["before"])


if __name__ == "__main__":
    unittest.main()
