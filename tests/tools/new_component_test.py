#!/usr/bin/env python3
"""tools/new_component makes a component that compiles, loads as a module, runs its scene and passes its tests.

Works on a copy of the sources; compiles the new files alone and links them with the core of this build.
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import modules  # noqa: E402
from sus import SUS  # noqa: E402


class NewComponent(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.copy = pathlib.Path(cls.folder.name)
        for name in ("components", "tools", "ups", "tests", "core", ".clang-format"):
            (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, cls.copy / name)
        cls.made = subprocess.run([cls.copy / "tools/new_component", "shallow_water"], capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def compile(self, source):
        """Returns the object file of a source of the copy."""
        target = self.copy / (source.replace("/", "_") + ".o")
        modules.must([*modules.compile_command(self.copy), "-o", target, "-c", self.copy / source], modules.BUILD)
        return target

    def component(self):
        """Returns the object files of the new component, and its module file."""
        folder = self.copy / "components/shallow_water"
        sources = sorted(str(file.relative_to(self.copy)) for file in folder.glob("*.cpp"))
        self.assertEqual([pathlib.Path(source).name for source in sources], ["module.cpp", "shallow_water.cpp"])
        objects = [self.compile(source) for source in sources]
        (self.copy / "card.cpp").write_text(modules.card("shallow_water"))
        plugins = self.copy / "plugins"
        plugins.mkdir()
        modules.link_module(plugins / "tushar_shallow_water.so", *objects, self.compile("card.cpp"))
        return objects, plugins / "tushar_shallow_water.so"

    def test_builds_passes_its_tests_and_runs_its_scene(self):
        self.assertEqual(self.made.returncode, 0, self.made.stderr)
        objects, module = self.component()
        scene = self.copy / "ups/shallow_water/shallow_water.ups"
        run = modules.run([SUS, "--load", module, scene, "--output", self.copy], self.copy)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("temperature, cell", run.stdout)
        self.assertTrue((self.copy / "shallow_water.uda").exists())
        listed = modules.run([SUS, "--list"], TUSHAR_PLUGINS=f"{self.copy}/ups:{module.parent}").stdout
        self.assertIn("  shallow_water ", listed)
        schedule = modules.run([SUS, "--load", module, "--schedule", scene]).stdout
        self.assertEqual((self.copy / "tests/golden/shallow_water_shallow_water.txt").read_text(), schedule)
        tests = [self.compile(str(file.relative_to(self.copy)))
                 for file in sorted((self.copy / "tests/shallow_water").glob("*_test.cpp"))]
        modules.link_program(self.copy / "program", *objects, *tests)
        passed = modules.run([self.copy / "program"], self.copy)
        self.assertEqual(passed.returncode, 0, passed.stdout)
        self.assertIn("[  PASSED  ]", passed.stdout)

    def test_the_tutorial_draws_the_archive_that_the_copy_writes(self):
        page = (ROOT / "tools/manual_pages/component.md").read_text()
        self.assertIn("tools/run ups/wave/wave.ups && tools/plot wave.uda\n", page)
        scene = (self.copy / "ups/shallow_water/shallow_water.ups").read_text()
        self.assertIn("<filebase>shallow_water.uda</filebase>", scene)

    def test_refuses_a_name_that_is_taken_or_is_none(self):
        before = sorted(self.copy.rglob("*"))
        for name, sentence in (("heat", "components/heat exists already"), ("9lives", "cannot be the name of a folder"),
                               ("class", "cannot be the name of a folder"), ("tests", "is the name of a folder"),
                               ("main", "is the name of a folder or function"), ("grid", "tests/grid exists already"),
                               ("simulation", "tests/simulation exists already"), ("std", "already use the name std"),
                               ("patch", "already use the name Patch"), ("settings", "already use the name Settings")):
            done = subprocess.run([self.copy / "tools/new_component", name], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(sentence, done.stderr)
        self.assertEqual(sorted(self.copy.rglob("*")), before)

    def test_registers_in_alphabetical_order(self):
        table = self.copy / "components/CMakeLists.txt"
        before = table.read_text().splitlines()
        made = subprocess.run([self.copy / "tools/new_component", "advection"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        after = table.read_text().splitlines()
        lines = [line for line in after if line.startswith("component(")]
        self.assertEqual(lines[0], "component(advection)")
        self.assertIn("component(shallow_water)", lines)
        self.assertEqual(lines, sorted(lines))
        self.assertEqual([line for line in after if "advection" not in line], before)

    def test_registers_by_one_line_that_moves_no_other(self):
        before = (ROOT / "components/CMakeLists.txt").read_text().splitlines()
        after = (self.copy / "components/CMakeLists.txt").read_text().splitlines()
        ours = ("component(advection)", "component(shallow_water)")
        self.assertEqual([line for line in after if line not in ours], before)


if __name__ == "__main__":
    unittest.main()
