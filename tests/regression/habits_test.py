#!/usr/bin/env python3
"""Checkpoints requested on the command line, and the output of `sus -V`."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, run

SINE = "ups/heat/sine.ups"
STEPS = 25
SHORT = ("--set", f"Time/max_Timesteps={STEPS}")


def sus(*words, folder=ROOT):
    return subprocess.run([SUS, *words], cwd=folder, capture_output=True, text=True)


def report_of(*words, folder):
    """Runs sus and returns its report."""
    path = pathlib.Path(folder, "report.json")
    done = sus(*words, "--quiet", "--json", path)
    assert done.returncode == 0, done.stderr
    return json.loads(path.read_text())


def checkpoints(folder):
    """Returns the steps of the checkpoints in the only archive of a folder."""
    return sorted(int(one.name[1:]) for one in pathlib.Path(folder).glob("*.uda.*/checkpoints/t*"))


class CheckpointOption(unittest.TestCase):
    def test_writes_checkpoints_by_the_wall_clock_and_changes_no_bit(self):
        plain = run(SINE, f"Time/max_Timesteps={STEPS}").report
        with tempfile.TemporaryDirectory() as folder:
            written = report_of(SINE, "--output", folder, "-checkpoint", "1e-6s", *SHORT, folder=folder)
            self.assertEqual(checkpoints(folder), [STEPS - 1, STEPS])
        self.assertEqual(written["fingerprint"], plain["fingerprint"])

    def test_long_intervals_leave_those_of_start_and_end(self):
        for interval in ("10min", "2h", "1e4s"):
            with tempfile.TemporaryDirectory() as folder:
                report_of(SINE, "--output", folder, "--checkpoint", interval, *SHORT, folder=folder)
                self.assertEqual(checkpoints(folder), [0, STEPS])

    def test_goes_beside_the_intervals_of_the_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            sets = ["--set", "DataArchiver/checkpoint/@timestepInterval=10",
                    "--set", "DataArchiver/checkpoint/@cycle=100"]
            report_of(SINE, "--output", folder, "--checkpoint", "10min", *sets, *SHORT, folder=folder)
            self.assertEqual(checkpoints(folder), [0, 10, 20, STEPS])

    def test_a_scene_without_an_archive_gets_one_that_can_be_continued(self):
        text = re.sub(r"<DataArchiver>.*</DataArchiver>", "", (ROOT / SINE).read_text(), flags=re.DOTALL)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "bare.ups")
            scene.write_text(text)
            plain = report_of(scene, folder=folder)
            self.assertEqual(list(pathlib.Path(folder).glob("*.uda*")), [])
            report_of(scene, "--output", folder, "--checkpoint", "1h", "--set", "Time/max_Timesteps=3", folder=folder)
            self.assertEqual(checkpoints(folder), [0, 3])
            restarted = report_of("-restart", pathlib.Path(folder, "bare.uda"), "--set", "Time/max_Timesteps=100000",
                                  folder=folder)
        self.assertEqual(restarted["fingerprint"], plain["fingerprint"])

    def test_times_that_are_none(self):
        for text in ("10", "min", "-1s", "0h", "1 day", "10mins"):
            done = sus(SINE, "--checkpoint=" + text)
            self.assertEqual(done.returncode, 2, text)
            self.assertIn(f"--checkpoint: found '{text}', expected a time such as 30s, 10min or 2h", done.stderr)


class Version(unittest.TestCase):
    def test_names_the_commit_the_compiler_and_the_libraries(self):
        lines = sus("-V").stdout.splitlines()
        self.assertRegex(lines[0], r"^sus \d+\.\d+\.\d+ \(\w+\)$")
        facts = dict(re.split(r"\s+", line, maxsplit=1) for line in lines[1:])
        self.assertEqual(list(facts), ["commit", "compiler", "MPI", "HDF5", "PETSc", "Eigen", "TBB"])
        self.assertRegex(facts["commit"], r"^([0-9a-f]{12,}|unknown)$")
        for library in ("compiler", "MPI", "HDF5", "PETSc", "Eigen", "TBB"):
            self.assertRegex(facts[library], r"\d+\.\d+", library)
        self.assertEqual(sus("--version").stdout.splitlines(), lines)

    def test_the_commit_stands_in_a_file_of_its_own(self):
        sources = [file for folder in ("core", "components", "tools") for file in (ROOT / folder).rglob("*.[ch]pp")]
        users = [file.name for file in sources if "buildCommit" in file.read_text()]
        self.assertEqual(sorted(users), ["version.cpp", "version.hpp"])


class Logs(unittest.TestCase):
    def test_a_file_gets_no_codes_of_terminals(self):
        with tempfile.TemporaryDirectory() as folder:
            said = sus(SINE, "--output", folder).stdout
        self.assertIn("saved in", said)
        self.assertNotIn("\033", said)
        self.assertNotIn("\r", said)


if __name__ == "__main__":
    unittest.main()
