#!/usr/bin/env python3
"""Tests of tools/python/tushar/interpreter.py: python3 tests/tools/interpreter_test.py"""
import os
import stat
import subprocess
import sys
import tempfile
import unittest

LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "python")


class Interpreter(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.script = self.write("tool", f"import sys\nsys.path.insert(0, {LIBRARY!r})\n"
                                         "from tushar.interpreter import ensure\n"
                                         "ensure('no_such_library')\nimport no_such_library\n"
                                         "print('found', no_such_library.__file__ is not None, sys.argv[1:])\n")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def add_python(self, folder, library_path):
        """Creates a python3 in a folder that finds the libraries of `library_path` and records that it was started."""
        path = self.write(f"{folder}/python3", f"#!/bin/sh\necho started >> {self.folder.name}/started\n"
                                               f"PYTHONPATH={library_path} exec {sys.executable} \"$@\"\n")
        os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return os.path.dirname(path)

    def run_with(self, *folders):
        environment = {**os.environ, "PATH": os.pathsep.join([*folders, "/bin"])}
        return subprocess.run([sys.executable, self.script, "one", "two words"], capture_output=True, text=True,
                              env=environment)

    def test_starts_again_with_a_python_that_has_the_library(self):
        self.write("libraries/no_such_library.py", "")
        poor, rich = self.add_python("poor", "/nowhere"), self.add_python("rich", self.folder.name + "/libraries")
        done = self.run_with(poor, rich)
        self.assertEqual(done.stdout, "found True ['one', 'two words']\n", done.stderr)

    def test_says_in_one_sentence_what_to_install(self):
        done = self.run_with(self.add_python("poor", "/nowhere"))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("python3-no_such_library (Debian, Ubuntu) or run 'python3 -m pip install no_such_library'",
                      done.stderr)

    def test_starts_again_only_once(self):
        # This Python has the library in a first look, and no more when the tool runs with it.
        self.write("libraries/no_such_library.py", "import sys\nif sys.argv[0] != '-c': raise ImportError('gone')\n")
        done = self.run_with(self.add_python("fickle", self.folder.name + "/libraries"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("install", done.stderr)
        with open(os.path.join(self.folder.name, "started"), encoding="utf-8") as file:
            self.assertEqual(len(file.readlines()), 2)  # one look, one run


if __name__ == "__main__":
    unittest.main()
