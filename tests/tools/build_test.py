#!/usr/bin/env python3
"""The output of tools/run during a build, and if no build is needed."""
import contextlib
import fcntl
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Build(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        (self.here / "tools/lib").mkdir(parents=True)
        for name in ("build.sh", "build_target"):
            shutil.copy(ROOT / "tools/lib" / name, self.here / "tools/lib")
        (self.here / "build/release/modules").mkdir(parents=True)
        (self.here / "build/release/modules/tushar_heat.so").touch()
        (self.here / "build/release/build.ninja").touch()

    def commands(self, ninja, each=60):
        """Returns the commands that build in the same folder, with this script as ninja and a log line every `each`
        seconds: that of tools/run, and that of sus for a module."""
        (self.here / "ninja").write_text("#!/bin/sh\n" + ninja)
        (self.here / "ninja").chmod(0o755)
        start = f"set -euo pipefail; PATH={self.here}:$PATH; export building_each={each}; "
        return {"build": ["bash", "-c", f"{start}. {self.here}/tools/lib/build.sh; build release sus"],
                "build_target": ["bash", "-c", f"{start}{self.here}/tools/lib/build_target {self.here}/build/release "
                                               "tushar_heat"]}

    def command(self, ninja, each=60):
        return self.commands(ninja, each)["build"]

    def build(self, ninja, each=60):
        """Returns the output of `build release` and its exit code."""
        done = subprocess.run(self.command(ninja, each), capture_output=True, text=True)
        self.assertEqual(done.stdout, "")
        return done.stderr, done.returncode

    def build_on_terminal(self, ninja):
        """Returns what the build prints on a terminal, with \\n at line ends."""
        ours, theirs = pty.openpty()
        subprocess.run(self.command(ninja), stderr=theirs)
        os.close(theirs)
        found = b""
        with open(ours, "rb", buffering=0) as terminal, contextlib.suppress(OSError):  # its end is an error
            while True:
                found += terminal.read(1000)
        return found.decode().replace("\r\n", "\n")

    def test_says_nothing_where_nothing_is_to_be_built(self):
        self.assertEqual(self.build("echo '[0/2] Re-checking globbed directories...'; echo 'ninja: no work to do.'"),
                         ("", 0))

    def test_says_once_that_it_builds(self):
        self.assertEqual(self.build("echo '[1/3] Building CXX object a.o'; echo '[2/3] Building CXX object b.o'; "
                                    "echo '[3/3] Linking CXX executable sus'"), ("tushar: building build/release\n", 0))

    def test_says_in_a_log_how_far_it_is_each_minute(self):
        ninja = "for k in 1 2 3; do echo \"[$k/4] Building CXX object $k.o\"; done; echo '[4/4] Linking CXX shared lib'"
        self.assertEqual(self.build(ninja, each=0)[0], "tushar: building build/release\n" + "".join(
            f"tushar: building build/release: {k} of 4\n" for k in (2, 3, 4)))

    def test_shows_on_a_terminal_how_far_it_is_in_one_line(self):
        ninja = "echo '[0/2] Re-checking globbed directories...'; "
        self.assertEqual(self.build_on_terminal(ninja + "echo 'ninja: no work to do.'"), "")
        line = "\r\033[Ktushar: building build/release: "
        self.assertEqual(self.build_on_terminal(ninja + "echo '[1/2] Building CXX object a.o'; "
                                                        "echo '[2/2] Linking CXX executable sus'"),
                         f"{line}1 of 2{line}2 of 2\n")
        failed = self.build_on_terminal("echo '[1/3] Building CXX object a.o'; echo 'a.cpp:1: error'; exit 1")
        self.assertTrue(failed.startswith(f"{line}1 of 3\n[1/3] Building"), failed)

    def test_says_at_once_that_it_builds_a_module(self):
        # ninja names a file when it is done; until then, minutes may pass.
        module = self.here / "build/release/modules/tushar_heat.so"
        module.unlink()
        command = self.commands("true")["build_target"]
        said = "tushar: building the module heat, which is needed for the first time\n"
        self.assertEqual(subprocess.run(command, capture_output=True, text=True).stderr, said)
        module.touch()  # by another rank
        self.assertEqual(subprocess.run(command, capture_output=True, text=True).stderr, "")

    def test_counts_as_it_needs_whatever_the_user_has_set(self):
        self.assertIn("3 of 7", self.build("echo \"$NINJA_STATUS\" | sed 's/%f/1/; s/%t/7/; s/$/Building a/'; "
                                           "echo '[3/7] Building b'", each=0)[0])

    def test_shows_what_failed(self):
        said, code = self.build("echo '[1/3] Building CXX object a.o'; echo 'a.cpp:1: error'; exit 1")
        self.assertNotEqual(code, 0)
        self.assertIn("a.cpp:1: error", said)
        self.assertIn("tushar: the build failed", said)

    def test_waits_for_another_build_in_the_folder(self):
        for name, command in self.commands(f"touch {self.here}/built").items():
            with self.subTest(name), open(self.here / "build/release/.building", "w") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                job = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
                self.assertEqual(job.stderr.readline(), "tushar: waiting for another build in build/release to end\n")
                self.assertFalse((self.here / "built").exists())
                fcntl.flock(lock, fcntl.LOCK_UN)
                self.assertEqual((job.communicate()[1], job.returncode), ("", 0))
                (self.here / "built").unlink()

    def program_as_ninja(self, program):
        """Copies a program as ninja into a folder other than that of commands()."""
        (self.here / "by_hand").mkdir()
        return shutil.copy(shutil.which(program), self.here / "by_hand/ninja")

    def test_waits_for_a_ninja_that_was_started_by_hand(self):
        by_hand = self.program_as_ninja("sleep")
        for name, command in self.commands(f"touch {self.here}/built").items():
            other = subprocess.Popen([by_hand, "60"], cwd=self.here / "build/release")
            with self.subTest(name), subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as job:
                try:
                    self.assertEqual(job.stderr.readline(), f"tushar: waiting for ninja, process {other.pid}, to end "
                                                            "its build in build/release\n")
                    self.assertFalse((self.here / "built").exists())
                finally:
                    other.kill()
                    other.wait()
                self.assertEqual((job.communicate()[1], job.returncode), ("", 0))
                (self.here / "built").unlink()

    def test_does_not_wait_for_the_ninja_that_has_started_it(self):
        by_hand = self.program_as_ninja("bash")
        for name, command in self.commands("true").items():
            with self.subTest(name):
                done = subprocess.run([by_hand, "-c", '"$@"; exit $?', "ninja", *command], stderr=subprocess.PIPE,
                                      cwd=self.here / "build/release", text=True, timeout=30)
                self.assertEqual((done.stderr, done.returncode), ("", 0))

    def test_a_folder_of_another_place_is_left_alone(self):
        cache = self.here / "build/release/CMakeCache.txt"
        script = f"set -euo pipefail; . {self.here}/tools/lib/build.sh; mapfile -t modules < <(built_modules release); "
        run = ["bash", "-c", script + "build release sus"]
        commands = self.commands(f"touch {self.here}/built")
        for home, fits in ((ROOT, False), ("/gone", False), (self.here, True)):
            cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
            for name, command in {**commands, "run": run}.items():
                if name == "run" and fits:
                    continue  # it would start the real ninja
                with self.subTest(name, home=home):
                    done = subprocess.run(command, capture_output=True, text=True)
                    said = "" if fits else (f"tushar: build/release was made for {home}, before the tree was copied or "
                                            f"moved; delete it: rm -r {self.here}/build/release\n")
                    self.assertEqual((done.stderr, done.returncode), (said, 0 if fits else 1))
                    self.assertEqual((self.here / "built").exists(), fits)

    def test_what_outlives_a_build_does_not_keep_the_lock(self):
        sleeper = f"sleep 60 >/dev/null 2>&1 & echo $! > {self.here}/pid"
        for name, command in self.commands(sleeper).items():
            with self.subTest(name), open(self.here / "build/release/.building", "w") as lock:
                subprocess.run(command, check=True)
                pid = int((self.here / "pid").read_text())
                os.kill(pid, 0)  # it lives
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
                os.kill(pid, signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
