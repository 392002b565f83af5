#!/usr/bin/env python3
"""The modules of sus: the index lists their contents, and a missing module is built or reported."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import modules  # noqa: E402
from sus import SUS  # noqa: E402

SCENE = ROOT / "ups/heat/sine.ups"
INDEX = modules.BUILD / "modules/index.txt"


class Index(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.lines = [line.split() for line in INDEX.read_text().splitlines()]

    def test_names_all_that_the_modules_have(self):
        listed = modules.run([SUS, "--list"]).stdout  # loads every module
        for kind, heading in (("component", "components"), ("analysis", "analysis modules")):
            section = re.search(rf"^{heading} .*\n((?:  .*\n)*)", listed, re.MULTILINE)[1]
            self.assertEqual(re.findall(r"^  (\w+)", section, re.MULTILINE),
                             sorted(name for _, is_a, name in self.lines if is_a == kind))

    def test_each_name_is_in_the_module_that_it_says(self):
        for module, _, name in self.lines:
            with self.subTest(module=module, name=name):
                done = modules.run([SUS, "--describe", name])  # loads this module alone
                self.assertEqual((done.returncode, done.stderr), (0, ""))


class Interface(unittest.TestCase):
    """Tests of the hash by which modules built with other headers are detected."""

    def setUp(self):
        self.headers = sorted(str(path) for path in (ROOT / "core").rglob("*.hpp"))

    def test_is_that_of_the_headers_as_they_are(self):
        hashes = "".join(hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() for path in self.headers)
        self.assertEqual(modules.interface(), hashlib.sha256(hashes.encode()).hexdigest()[:16])

    def test_is_made_anew_when_one_of_them_changes(self):
        ninja = modules.BUILD / "build.ninja"
        if not ninja.exists():
            self.skipTest("this build is not Ninja's")
        line = next(line for line in ninja.read_text().splitlines() if ": RERUN_CMAKE " in line)
        self.assertEqual(set(self.headers) - set(line.split()), set())


class Missing(unittest.TestCase):
    """A copy of sus with an index of modules, but without the modules."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        (self.here / "modules").mkdir()
        for file in (SUS, modules.BUILD / "libtushar_core.so"):
            shutil.copy(file, self.here)
        shutil.copy(INDEX, self.here / "modules")

    def run_scene(self, *options):
        libraries = f"{self.here}:{os.environ.get('LD_LIBRARY_PATH', '')}"
        return modules.run([self.here / "sus", SCENE, "--quiet", "--output", self.here / "output", *options],
                           LD_LIBRARY_PATH=libraries)

    def builder(self, commands):
        """Writes the script that sus calls to build a module; it records its arguments."""
        script = self.here / "build_missing"
        script.write_text(f"#!/bin/sh\necho \"$@\" >> '{self.here}/calls'\n{commands}\n")
        script.chmod(0o755)

    def calls(self):
        return (self.here / "calls").read_text().splitlines()

    def test_is_built_when_a_scene_asks_for_it(self):
        self.builder(f"cp '{modules.BUILD}/modules/'$1.so '{self.here}/modules/'")
        for _ in range(2):
            done = self.run_scene()
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.calls(), ["tushar_heat", "tushar_analysis"])

    def test_a_build_is_no_part_of_the_start_up(self):
        wait = 10  # seconds for both modules, more than a start-up takes on a busy machine
        self.builder(f"sleep {wait / 2}; cp '{modules.BUILD}/modules/'$1.so '{self.here}/modules/'")
        done = self.run_scene("--json", self.here / "report.json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLess(json.loads((self.here / "report.json").read_text())["wall"]["startup"], wait)

    def test_nothing_is_built_for_a_component_that_is_misspelt(self):
        self.builder("exit 3")
        done = self.run_scene("--set", "SimulationComponent/@type=hest")
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr,
                         r"found 'hest', expected 'burgers', .* \(did you mean 'heat'\?\); --load .* \[T107\]\n\Z")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.here / "calls").exists())

    def test_a_build_that_fails_is_told(self):
        self.builder("exit 3")
        done = self.run_scene()
        self.assertEqual((done.returncode, done.stderr), (1, "sus: tushar_heat was not built [T707]\n"))
        self.assertFalse((self.here / "output").exists())

    def test_where_nothing_is_built_it_is_missing(self):
        done = self.run_scene()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "sus: the module heat is missing: there is no "
                                      f"{self.here}/modules/tushar_heat.so; install Tushar again [T707]\n")
        self.assertFalse((self.here / "output").exists())

    def test_no_index(self):
        (self.here / "modules/index.txt").unlink()
        done = self.run_scene()
        self.assertEqual((done.returncode, done.stderr),
                         (1, f"sus: {self.here}/modules/index.txt: cannot be read [T401]\n"))


if __name__ == "__main__":
    unittest.main()
