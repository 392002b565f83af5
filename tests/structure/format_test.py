#!/usr/bin/env python3
"""C++ is formatted as clang-format 14 does (tools/format), and no line of C++ or Python is too long."""
import re
import shutil
import subprocess
import unittest

import tree

LONGEST_LINE = 120  # characters, as in .clang-format


def clang_format_version():
    """Returns the major version of the installed clang-format; None without one."""
    if not shutil.which("clang-format"):
        return None
    said = subprocess.run(["clang-format", "--version"], capture_output=True, text=True).stdout
    found = re.search(r"version (\d+)", said)
    return int(found[1]) if found else None


class Format(unittest.TestCase):
    maxDiff = None

    def test_tools_format_would_change_nothing(self):
        version = clang_format_version()
        if version != 14:
            self.skipTest(f"needs clang-format 14, the one of Debian 12; found {version or 'none'}")
        checked = subprocess.run([tree.ROOT / "tools/format", "--check"], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_no_line_is_longer_than_120_characters(self):
        long = [f"{path}:{number}" for path in tree.cpp_files() + tree.python_files() + tree.build_files()
                for number, line in enumerate(tree.read(path).splitlines(), 1) if len(line) > LONGEST_LINE]
        self.assertEqual(long, [])


if __name__ == "__main__":
    unittest.main()
