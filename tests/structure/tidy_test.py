#!/usr/bin/env python3
"""The checks of .clang-tidy find nothing in core, components and tools; see tools/tidy."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

import tree

LOADER = importlib.machinery.SourceFileLoader("tidy", str(tree.ROOT / "tools/tidy"))
tidy = importlib.util.module_from_spec(importlib.util.spec_from_loader("tidy", LOADER))
LOADER.exec_module(tidy)

JOBS = 2  # runs of clang-tidy at a time, for which tests/CMakeLists.txt keeps processors
MOVED = """#include <string>
#include <utility>

std::string twice(std::string word) {
  std::string moved = std::move(word);
  return moved + word;
}
"""
COPY = """#pragma once

#include <string>
#include <vector>

inline std::size_t length(const std::vector<std::string>& words) {
  std::size_t sum = 0;
  for (const std::string word : words) sum += word.size();
  return sum;
}
"""


class Tidy(unittest.TestCase):
    def test_finds_nothing(self):
        self.assertEqual(tidy.check_rooms(tidy.Tree(), JOBS), 0, "above: what was found")

    def test_every_check_that_the_list_names_exists(self):
        config = tree.ROOT / ".clang-tidy"
        said = subprocess.run([tidy.Tree().program, f"--config-file={config}", "--verify-config"], capture_output=True,
                              text=True)
        self.assertEqual((said.returncode, said.stdout.strip()), (0, "No config errors detected."), said.stderr)

    def test_every_source_and_header_is_read(self):
        sources = tidy.Tree()
        read = set().union(*(sources.included(sources.read(files)) for files in sources.rooms().values()))
        self.assertEqual(set(tree.cpp_files(("core", "components", "tools"))) - read, set())


class Check(unittest.TestCase):
    """Tests of the check itself, on small trees with known findings."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = tidy.Tree(pathlib.Path(folder.name))
        (self.tree.root / "core/a").mkdir(parents=True)
        self.tree.prepare()

    def found(self, **files):
        """Returns the findings in a tree with these files in core/a, its only room."""
        for name, text in files.items():
            (self.tree.root / "core/a" / name.replace("_", ".")).write_text(text)
        [(room, of_room)] = self.tree.rooms().items()
        said = self.tree.check_room(of_room)
        self.assertEqual(self.tree.is_clean(room, of_room), not said)
        return said

    def test_finds_a_mistake_and_names_its_file(self):
        said = self.found(one_cpp="int one() { return 1; }\n", two_cpp=MOVED)
        self.assertRegex(said, r"core/a/two\.cpp:6:18: error: .*\[bugprone-use-after-move")

    def test_finds_a_mistake_in_a_header_that_a_source_includes(self):
        said = self.found(one_hpp=COPY, one_cpp='#include "core/a/one.hpp"\n')
        self.assertRegex(said, r"core/a/one\.hpp:8:26: error: .*\[performance-for-range-copy")

    def test_finds_a_mistake_in_a_header_that_none_includes(self):
        self.assertIn("core/a/one.hpp:8:26: error", self.found(one_hpp=COPY))

    def test_what_does_not_compile_is_not_clean(self):
        self.assertIn("[clang-diagnostic-error", self.found(one_cpp="int one() { return two; }\n"))

    def test_a_program_that_dies_is_not_clean(self):
        self.tree.program = self.tree.root / "dies"
        self.tree.program.write_text("#!/bin/sh\nkill -SEGV $$\n")
        self.tree.program.chmod(0o755)
        self.assertEqual(self.found(one_cpp=""), "clang-tidy ended with -11\n")

    def test_what_was_clean_is_so_until_a_file_changes(self):
        self.tree.list.parent.mkdir(parents=True)
        self.assertEqual(self.found(one_hpp="#pragma once\n", one_cpp='#include "core/a/one.hpp"\n'), "")
        self.tree.write_list()
        elsewhere = tidy.Tree(self.tree.root)
        elsewhere.made = self.tree.root / "build/of_another"
        [(room, files)] = elsewhere.rooms().items()
        self.assertTrue(elsewhere.is_clean(room, files))
        (self.tree.root / "core/a/one.hpp").write_text(COPY)
        self.assertFalse(elsewhere.is_clean(room, files))
        self.assertFalse(self.tree.is_clean(room, files))


if __name__ == "__main__":
    if not tidy.install():
        print(f"skipped: clang-tidy {tidy.VERSION} is not in build/python, and installing it needs a network")
        sys.exit(tidy.MISSING)
    unittest.main()
