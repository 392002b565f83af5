#!/usr/bin/env python3
"""tools/new_component makes a component that compiles, is known to sus, runs its scene and passes its tests.

Works on a copy of the sources; compiles the new files alone and links them with the libraries of this build.
"""
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SUS = pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve()
BUILD = SUS.parent


def compile_command():
    """How this build compiles components/heat/heat.cpp, less its in- and output."""
    import json
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    command = next(e["command"] for e in entries if e["file"].endswith("components/heat/heat.cpp"))
    words = shlex.split(command)
    words = words[:words.index("-o")]
    return [word for word in words if "ccache" not in word]


class NewComponent(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.copy = pathlib.Path(cls.folder.name)
        for name in ("components", "tools", "ups", "tests", "core"):
            shutil.copytree(ROOT / name, cls.copy / name)
        cls.made = subprocess.run([cls.copy / "tools/new_component", "shallow_water"], capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def compile(self, source):
        """Object file of a source of the copy."""
        target = self.copy / (source.replace("/", "_") + ".o")
        command = [word.replace(str(ROOT), str(self.copy)) if word.startswith("-I") else word
                   for word in compile_command()]
        done = subprocess.run(command + ["-o", target, "-c", self.copy / source], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return target

    def link(self, objects, *more):
        """Program of objects of the copy and the libraries of this build."""
        ninja = (BUILD / "build.ninja").read_text()
        rule = ninja[ninja.index("build sus: CXX_EXECUTABLE_LINKER"):]
        libraries = next(line for line in rule.splitlines() if line.strip().startswith("LINK_LIBRARIES"))
        program = self.copy / "program"
        flags = [word for word in compile_command() if word.startswith(("-fsanitize", "-O"))]
        command = ["g++", *flags, "-o", program, *objects, *more, *shlex.split(libraries.split("=", 1)[1])]
        done = subprocess.run(command, cwd=BUILD, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return program

    def test_builds_passes_its_tests_and_runs_its_scene(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        new = [self.compile("components/shallow_water/shallow_water.cpp"), self.compile("components/components.cpp")]
        sus = self.link([*new, self.compile("tools/sus.cpp")])
        listed = subprocess.run([sus, "--list"], capture_output=True, text=True).stdout
        self.assertIn("  shallow_water ", listed)
        run = subprocess.run([sus, "ups/shallow_water/shallow_water.ups", "--output", self.copy], cwd=self.copy,
                             capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("temperature, cell", run.stdout)
        scene = self.copy / "ups/shallow_water/shallow_water.ups"
        schedule = subprocess.run([sus, "--schedule", scene], capture_output=True, text=True).stdout
        self.assertEqual((self.copy / "tests/golden/shallow_water_shallow_water.txt").read_text(), schedule)
        tests = [self.compile(str(file.relative_to(self.copy)))
                 for file in sorted((self.copy / "tests/shallow_water").glob("*_test.cpp"))]
        program = self.link([*new, *tests], "-lgtest_main", "-lgtest")
        passed = subprocess.run([program], cwd=self.copy, capture_output=True, text=True,
                                env=dict(os.environ, LD_LIBRARY_PATH=str(BUILD)))
        self.assertEqual(passed.returncode, 0, passed.stdout)
        self.assertIn("[  PASSED  ]", passed.stdout)

    def test_refuses_a_name_that_is_taken_or_is_none(self):
        before = sorted(self.copy.rglob("*"))
        for name, sentence in (("heat", "components/heat exists already"), ("9lives", "is no name for a folder"),
                               ("class", "is no name for a folder"), ("grid", "tests/grid exists already"),
                               ("simulation", "tests/simulation exists already"), ("std", "use the name std already"),
                               ("patch", "use the name Patch already"), ("settings", "use the name Settings already")):
            done = subprocess.run([self.copy / "tools/new_component", name], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stderr)
        self.assertEqual(sorted(self.copy.rglob("*")), before)

    def test_registers_in_alphabetical_order(self):
        text = (self.copy / "components/components.cpp").read_text()
        made = subprocess.run([self.copy / "tools/new_component", "advection"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        with_advection = (self.copy / "components/components.cpp").read_text()
        includes = [line for line in with_advection.splitlines()[1:] if line.startswith("#include")]
        self.assertIn('#include "components/advection/advection.hpp"', includes)
        self.assertEqual(includes, sorted(includes))
        self.assertIn("          advection::kind(),\n          burgers::kind(),\n", with_advection)
        self.assertEqual([line for line in with_advection.splitlines() if "advection" not in line], text.splitlines())


if __name__ == "__main__":
    unittest.main()
