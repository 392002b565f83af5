#!/usr/bin/env python3
"""The tests of the package and tools/plot again, by a Python with the newest libraries: the one that tools/test makes
in build/python, or another on the PATH that has them."""
import pathlib
import subprocess
import unittest

import support
from tushar.interpreter import python_with

LIBRARIES = ("h5py", "matplotlib", "pandas", "xarray", "pyvista", "yt")
TESTS = ("python/archive_test.py", "python/run_test.py", "python/frames_test.py", "python/examples_test.py",
         "tools/uda_test.py", "tools/plot_test.py", "tools/plot_scene_test.py")
PYTHON = python_with(LIBRARIES)


@unittest.skipIf(PYTHON is None, f"no Python here has {', '.join(LIBRARIES)}; tools/test makes one in build/python")
class Newest(unittest.TestCase):
    def test_they_pass(self):
        for test in TESTS:
            with self.subTest(test):
                path = pathlib.Path(support.ROOT, "tests", test)
                done = subprocess.run([PYTHON, path], cwd=support.ROOT, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
