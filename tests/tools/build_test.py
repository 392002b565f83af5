#!/usr/bin/env python3
"""What tools/run says while it builds, or need not."""
import pathlib
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
        (self.here / "tools/lib/build.sh").write_text((ROOT / "tools/lib/build.sh").read_text())
        (self.here / "build/release").mkdir(parents=True)
        (self.here / "build/release/build.ninja").touch()

    def build(self, ninja):
        """What `build release` says, and its exit code, if ninja is this script."""
        (self.here / "ninja").write_text("#!/bin/sh\n" + ninja)
        (self.here / "ninja").chmod(0o755)
        script = f"set -euo pipefail; PATH={self.here}:$PATH; . {self.here}/tools/lib/build.sh; build release sus"
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True)
        self.assertEqual(done.stdout, "")
        return done.stderr, done.returncode

    def test_says_nothing_where_nothing_is_to_be_built(self):
        self.assertEqual(self.build("echo '[0/2] Re-checking globbed directories...'; echo 'ninja: no work to do.'"),
                         ("", 0))

    def test_says_once_that_it_builds(self):
        self.assertEqual(self.build("echo '[1/3] Building CXX object a.o'; echo '[2/3] Building CXX object b.o'; "
                                    "echo '[3/3] Linking CXX executable sus'"), ("tushar: building build/release\n", 0))

    def test_shows_what_failed(self):
        said, code = self.build("echo '[1/3] Building CXX object a.o'; echo 'a.cpp:1: error'; exit 1")
        self.assertNotEqual(code, 0)
        self.assertIn("a.cpp:1: error", said)
        self.assertIn("tushar: the build failed", said)


if __name__ == "__main__":
    unittest.main()
