#!/usr/bin/env python3
"""C++ constructs with better replacements that can be found in the text alone (tidy_test.py runs clang-tidy)."""
import re
import unittest

import tree

UNWANTED = {"NULL: nullptr": r"\bNULL\b",
            "new: std::make_unique, or a container": r"\bnew\s+[A-Za-z_:]",
            "a cast in the manner of C": r"(?<![\w>\])])\((?:int|long|unsigned|char|float|double)\)\s*[\w(]",
            "const_cast": r"\bconst_cast\b",
            "virtual beside override": r"\bvirtual\b[^;{]*\boverride\b",
            "an exception caught by value": r"\bcatch \((?!const\b|\.\.\.)[^)&]*\)",
            "typedef: using": r"\btypedef\b",
            "goto": r"\bgoto\b",
            "std::endl: '\\n'": r"\bstd::endl\b",
            "printf: fmt": r"\bprintf\(",
            "rand: <random>": r"\bs?rand\("}


def unwanted(text):
    """Returns (line, description) for each unwanted construct of a C++ text."""
    code = tree.code_alone(text)
    return [(code.count("\n", 0, found.start()) + 1, what) for what, pattern in UNWANTED.items()
            for found in re.finditer(pattern, code)]


class Words(unittest.TestCase):
    maxDiff = None

    def test_none_stands_in_core_components_and_tools(self):
        found = [f"{path}:{line}: {what}" for path in tree.cpp_files(("core", "components", "tools"))
                 for line, what in unwanted(tree.read(path))]
        self.assertEqual(found, [])

    def test_headers_begin_with_pragma_once(self):
        wrong = [path for path in tree.files(".hpp")
                 if not tree.without_comments(tree.read(path)).lstrip().startswith("#pragma once\n")]
        self.assertEqual(wrong, [])

    def test_they_are_found(self):
        text = ("int* p = NULL;  // NULL\nauto x = (int)y;\ntry {} catch (Error e) {}\n"
                "f(sizeof(int) * 2, \"new Foo\");\n")
        self.assertEqual([line for line, _ in sorted(unwanted(text))], [1, 2, 3])


if __name__ == "__main__":
    unittest.main()
