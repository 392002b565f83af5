#!/usr/bin/env python3
"""Functions are short. `functions_test.py --figures` prints how long they are."""
import sys
import unittest

import tree

LONGEST_FUNCTION = 50  # lines of code, without blank ones and comments


def lengths():
    """Returns (lines, place) of each function, including lambdas, of core, components and tools, longest first."""
    code, rows = {}, []
    for function in tree.functions("f"):
        if "end" in function:
            path = function["path"]
            lines = code.setdefault(path, tree.code_alone(tree.read(path)).split("\n"))
            body = lines[function["line"] - 1:function["end"]]
            rows.append((sum(bool(line.strip()) for line in body), f"{path}:{function['line']} {function['name']}"))
    return sorted(rows, reverse=True)


class Functions(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        if not tree.has_ctags():
            self.skipTest("needs Universal Ctags (Debian: universal-ctags)")

    def test_no_function_is_longer_than_50_lines(self):
        self.assertEqual([f"{place}: {count} lines" for count, place in lengths() if count > LONGEST_FUNCTION], [])


def print_figures():
    rows = lengths()
    for share in (.5, .95, .99):
        print(f"{share:.0%} of {len(rows)} functions have at most {rows[int((1 - share) * len(rows))][0]} lines")
    for count, place in rows[:20]:
        print(f"{count:4} {place}")


if __name__ == "__main__":
    if "--figures" in sys.argv:
        print_figures()
    else:
        unittest.main()
