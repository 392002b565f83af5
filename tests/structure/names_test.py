#!/usr/bin/env python3
"""Names in comments exist in the code.

A name is a word with a capital inside (`ParticleSet`, `firstPatch`), `a::b` or `a()`, in backticks or not. It must
stand in the code: C++ outside of comments, Python, CMake or a scene. Not names: what a line with a year cites
(`McCalpin's STREAM (1995)`), what Uintah calls its own (`Uintah's computeBasicDamage`), `std::` and formulas (`dF`).
"""
import re
import unittest

import tree

NAME = re.compile(r"(?<![\w:/.])(?:(?!std::)(?:\w+::)+\w+|[a-z]{2,}[A-Z]\w*|[A-Z][a-z]+[A-Z]\w*|[A-Za-z]\w+(?=\(\)))")
CITED = re.compile(r"[^\n]*\b(?:19|20)\d\d\b[^\n]*|Uintah's[^.;]*")
WORD = re.compile(r"\w+")


def words_of_the_code():
    words = set()
    for path in tree.cpp_files():
        words.update(WORD.findall(tree.without_comments(tree.read(path))))
    others = [*(tree.ROOT / "ups").rglob("*.ups"), *tree.ROOT.rglob("CMakeLists.txt")]
    for path in [*tree.python_files(), *(path.relative_to(tree.ROOT) for path in others if "build" not in path.parts)]:
        words.update(WORD.findall(tree.read(path)))
    return words


def blocks(text):
    """Returns (line, text) for each run of comments on consecutive lines."""
    found, last = [], None
    for line, comment in tree.comments(text):
        if last is not None and line == last + 1:
            found[-1][1].append(comment)
        else:
            found.append((line, [comment]))
        last = line + comment.count("\n")
    return [(line, "\n".join(parts)) for line, parts in found]


def names(comment):
    return NAME.findall(CITED.sub("", comment))


class Names(unittest.TestCase):
    maxDiff = None

    def test_every_name_in_a_comment_stands_in_the_code(self):
        known = words_of_the_code()
        stale = [f"{path}:{line}: {name}" for path in tree.cpp_files() for line, comment in blocks(tree.read(path))
                 for name in names(comment) if not known.issuperset(WORD.findall(name))]
        self.assertEqual(stale, [])

    def test_what_a_name_is(self):
        self.assertEqual(names("/// As firstPatch, `Level::cells` and reset() do: dF/dt, std::min, in Pa."),
                         ["firstPatch", "Level::cells", "reset"])
        self.assertEqual(names("/// McCalpin's STREAM (1995).\n/// Uintah's computeDamage\n/// and eraseAll. A "
                               "ParticleSet."),
                         ["ParticleSet"])


if __name__ == "__main__":
    unittest.main()
