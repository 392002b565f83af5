#!/usr/bin/env python3
"""Ctrl-C and SIGTERM end a run after the step, with its output and report written."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import unittest

SUS = os.environ.get("SUS", "build/dev/sus")


class Interrupt(unittest.TestCase):
    def interrupted(self, number):
        """Exit code, report and files of a long run that gets a signal once it has begun to write."""
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder, "report.json")
            run = subprocess.Popen([SUS, "ups/mpm/sod.ups", "--output", folder, "--json", report, "--set",
                                    "Grid/Level/Box/resolution=[5000,1,1]"], stdout=subprocess.PIPE)
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


if __name__ == "__main__":
    unittest.main()
