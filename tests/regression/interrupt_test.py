#!/usr/bin/env python3
"""Ctrl-C, SIGTERM and max_wall_time end a run after the step; its output, report and a checkpoint are written."""
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
from sus import ROOT
from uda import FolderTest

SUS = os.environ.get("SUS", "build/dev/sus")
SOD = "ups/mpm/sod.ups"
FINE = "Grid/Level/Box/resolution=[2000,1,1]"


class Interrupt(FolderTest):
    def interrupted(self, number):
        """Returns exit code, report and files of a long run that receives a signal once it has begun to write."""
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder, "report.json")
            run = subprocess.Popen([SUS, "ups/mpm/sod.ups", "--output", folder, "--json", report, "--set",
                                    "Grid/Level/Box/resolution=[5000,1,1]"], stdout=subprocess.PIPE, cwd=ROOT)
            first = run.stdout.readline()
            self.assertIn(b"saved in", first)
            time.sleep(0.2)
            run.send_signal(number)
            run.communicate(timeout=60)
            outputs = sorted(path.name for path in pathlib.Path(folder, "sod.uda").glob("t*.h5"))
            return run.returncode, json.loads(report.read_text()), outputs

    def test_ctrl_c_and_sigterm_write_the_state_and_exit_with_5(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            code, report, outputs = self.interrupted(number)
            self.assertEqual(code, 5)
            self.assertEqual(report["ended"], "interrupted")
            self.assertLess(report["time"], 0.2)
            self.assertIn(f"t{report['steps']:05d}.h5", outputs)

    def test_sigterm_ends_implicit_steps_like_any_other(self):
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder, "report.json")
            run = subprocess.Popen([SUS, "ups/solid/implicit_cantilever.ups", "--output", folder, "--json", report,
                                    "--set", "Time/maxTime=1e9", "--set", "DataArchiver/outputTimestepInterval=1",
                                    "--set", "DataArchiver/outputInterval=0"], stdout=subprocess.PIPE, text=True,
                                   cwd=ROOT)
            for line in run.stdout:  # PETSc starts in the first step
                if line.startswith("step") and not line.split()[1] == "0":
                    break
            run.send_signal(signal.SIGTERM)
            run.communicate(timeout=60)
            self.assertEqual(run.returncode, 5)
            known = json.loads(report.read_text())
            self.assertEqual(known["ended"], "interrupted")
            self.assertGreater(known["steps"], 0)

    def test_a_second_signal_of_either_kind_ends_at_once_whatever_the_run_is_at(self):
        large = "Grid/Level/Box/resolution=[100,100,25]"
        for options, apart in (((), 0.5), (("-check",), 0.5), ((), 0)):
            with tempfile.TemporaryDirectory() as folder:
                run = subprocess.Popen([SUS, "ups/mpm/vortex_3d.ups", "--output", folder, "--quiet", "--set", large,
                                        *options],
                                       stdout=subprocess.DEVNULL, cwd=ROOT)
                time.sleep(0.5)
                run.send_signal(signal.SIGTERM)
                time.sleep(apart)
                run.send_signal(signal.SIGINT)
                self.assertLess(run.wait(timeout=5), 0, (options, apart))

    def assert_goes_on_to_the_bits_of_the_uncut_run(self, here):
        self.assertEqual(len(here.checkpoints), 1)
        step = int(here.checkpoints[0].name[1:])
        end = f"Time/max_Timesteps={step + 100}"
        expected = self.folder().run(SOD, FINE, end)[2]
        code, errors, report = here.restart(end, "Time/max_wall_time=1000")
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(report["fingerprint"], expected["fingerprint"])

    def test_an_interrupted_run_goes_on_from_there_whether_or_not_it_asks_for_checkpoints(self):
        for sets in ((FINE,), (FINE, "DataArchiver/checkpoint/@interval=1000", "DataArchiver/checkpoint/@cycle=1")):
            here = self.folder()
            run = subprocess.Popen(here.command([SOD, "--output", here.path], sets), cwd=ROOT)
            while not list(here.path.glob("*.uda/t00000.h5")):
                time.sleep(0.01)
            time.sleep(0.1)
            run.send_signal(signal.SIGTERM)
            self.assertEqual(run.wait(timeout=60), 5)
            self.assert_goes_on_to_the_bits_of_the_uncut_run(here)

    def started(self, ranks=1):
        """Starts a run and returns once it has written its first output; it would take minutes to end."""
        here = self.folder(ranks)
        run = subprocess.Popen(here.command([SOD, "--output", here.path], ("Grid/Level/Box/resolution=[20000,1,1]",)),
                               cwd=ROOT)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        while not list(here.path.glob("*.uda/t00000.h5")):
            self.assertIsNone(run.poll())
            time.sleep(0.01)
        return here, run

    def wait_for(self, condition):
        for _ in range(6000):
            if condition():
                return
            time.sleep(0.01)
        self.fail("nothing happened for a minute")

    def assert_saved_while_it_goes_on(self, ask, ranks):
        here, run = self.started(ranks)
        outputs = len(list(here.uda.glob("t*.h5")))
        ask(here, run)
        self.wait_for(lambda: (here.uda / "checkpoints/LATEST").exists())
        self.assertIsNone(run.poll())
        self.assertTrue((here.uda / f"{here.checkpoints[-1].name}.h5").exists())
        self.assertGreater(len(list(here.uda.glob("t*.h5"))), outputs)
        self.assertFalse((here.uda / "output_now").exists())
        run.terminate()
        run.wait(timeout=60)

    def test_sigusr1_or_a_file_save_the_state_and_the_run_goes_on(self):
        for ranks in (1, 2):
            self.assert_saved_while_it_goes_on(lambda here, run: run.send_signal(signal.SIGUSR1), ranks)
            self.assert_saved_while_it_goes_on(lambda here, run: (here.uda / "output_now").touch(), ranks)

    def test_the_file_stop_now_ends_a_run_with_output_and_checkpoint(self):
        for ranks in (1, 2):
            here, run = self.started(ranks)
            (here.uda / "stop_now").touch()
            self.assertEqual(run.wait(timeout=60), 0)
            report = json.loads((here.path / "report.json").read_text())
            self.assertEqual(report["ended"], "stop_now")
            self.assertFalse((here.uda / "stop_now").exists())
            name = f"t{report['steps']:05d}"
            self.assertEqual([path.name for path in here.checkpoints], [name])
            self.assertIn(f"{name}.h5", (here.uda / "index.xml").read_text())
            code, errors, again = here.restart(f"Time/max_Timesteps={report['steps'] + 3}")
            self.assertEqual((code, errors, again["steps"]), (0, "", report["steps"] + 3))
            self.assertIn(f"{name}.h5", (here.uda / "index.xml").read_text())

    def test_max_wall_time_ends_a_run_with_a_checkpoint(self):
        here = self.folder()
        code, errors, report = here.run(SOD, FINE, "Time/max_wall_time=0.2")
        self.assertEqual((code, errors, report["ended"]), (0, "", "max_wall_time"))
        self.assert_goes_on_to_the_bits_of_the_uncut_run(here)


if __name__ == "__main__":
    unittest.main()
