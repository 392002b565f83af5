#!/usr/bin/env python3
"""No function of core, components and tools has more than 10 parameters: larger sets are grouped in a struct."""
import re
import unittest

import tree

MOST_PARAMETERS = 10


def parameters(signature):
    """Returns the number of parameters in `(int a, std::map<int, int> b = {1, 2})...`: two."""
    inner = signature[signature.index("(") + 1:]
    depth, count, last = 0, 1, ""
    for place, letter in enumerate(inner):
        if letter in "([{<":
            depth += 1
        elif letter == ">" and last in "-=":  # -> and =>
            pass
        elif letter in ")]}>":
            if depth == 0:
                return 0 if inner[:place].strip() in ("", "void") else count
            depth -= 1
        elif letter == "," and depth == 0:
            count += 1
        last = letter
    return count


def longest_lists():
    """Returns (parameters, place) of each function with too many, including lambdas and constructors."""
    found = {}
    for function in tree.functions("fp"):
        count = parameters(function.get("signature", "()"))
        if count > MOST_PARAMETERS:
            found[f"{function['path']}:{function['line']} {re.sub('__anon.*', 'lambda', function['name'])}"] = count
    return sorted(((count, place) for place, count in found.items()), reverse=True)


class Parameters(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        if not tree.has_ctags():
            self.skipTest("needs Universal Ctags (Debian: universal-ctags)")

    def test_no_function_takes_more_than_10(self):
        self.assertEqual([f"{place}: {count} parameters" for count, place in longest_lists()], [])

    def test_how_they_are_counted(self):
        for signature, count in (("()", 0), ("(void)", 0), ("(int a)", 1), ("(decltype(a->b) c, bool d) const", 2),
                                 ("(std::map<int, int> b = {1, 2}, F(*f)(int, int))", 2)):
            self.assertEqual(parameters(signature), count, signature)


if __name__ == "__main__":
    unittest.main()
