#!/usr/bin/env python3
"""Folders of core and components are rooms: a file is in its room's namespace, and includes form no circles."""
import re
import unittest

import tree

ROOMS = ("core", "components")
NAMESPACE = re.compile(r"^namespace (tushar[\w:]*) \{", re.MULTILINE)
# Folders with a namespace of their own below core/X and components/X; all others share that of the folder above.
NAMED = {"components/mpm/gas": "tushar::mpm::gas",
         "components/mpm/gas/paper": "tushar::mpm::gas::paper",
         "components/mpm/gas/conserving": "tushar::mpm::gas::conserving",
         "components/mpm/solid": "tushar::mpm::solid",
         "components/mpm/solid/implicit": "tushar::mpm::solid::implicit"}


def namespace_of(folder):
    """`tushar` for core, core/base and components; `tushar::X` for core/X and components/X; deeper ones: see NAMED."""
    if folder in ("core", "core/base", "components"):
        return "tushar"
    if folder in NAMED:
        return NAMED[folder]
    above, _, name = folder.rpartition("/")
    return f"tushar::{name}" if above in ("core", "components") else namespace_of(above)


def parting(one, other):
    """Returns the two folders at which the paths of two files diverge; None where one contains the other."""
    a, b = tree.folder_of(one).split("/"), tree.folder_of(other).split("/")
    shared = 0
    while shared < min(len(a), len(b)) and a[shared] == b[shared]:
        shared += 1
    if shared == min(len(a), len(b)):
        return None
    return "/".join(a[:shared + 1]), "/".join(b[:shared + 1])


def circle(graph):
    """Returns files that include one another in a circle, in that order; empty if there are none."""
    done, path = set(), []

    def visit(file):
        if file in path:
            return path[path.index(file):] + [file]
        if file in done:
            return []
        path.append(file)
        for name in graph.get(file, []):
            if found := visit(name):
                return found
        path.pop()
        done.add(file)
        return []

    return next((found for found in map(visit, graph) if found), [])


class Rooms(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.includes = {path: tree.includes(path) for path in tree.cpp_files(ROOMS)}

    def test_a_file_opens_the_namespace_of_its_room(self):
        wrong = []
        for path in self.includes:
            opened, expected = NAMESPACE.findall(tree.read(path)), namespace_of(tree.folder_of(path))
            if re.match(r"components/.*/(module|solid_mpm_\w+)\.cpp", path):  # what sus calls when it loads it
                expected = "tushar::modules"
            if opened and not any(name == expected or name.startswith(expected + "::") for name in opened):
                wrong.append(f"{path} opens {opened[0]}, not {expected}")
        self.assertEqual(wrong, [])

    def test_no_two_folders_side_by_side_include_one_another(self):
        found = {}
        for path, names in self.includes.items():
            for name in names:
                if pair := parting(path, name):
                    found.setdefault(pair, f"{path} includes {name}")
        both = [f"{sentence}, but {found[other, one]}" for (one, other), sentence in sorted(found.items())
                if one < other and (other, one) in found]
        self.assertEqual(both, [])

    def test_no_file_includes_itself_through_others(self):
        self.assertEqual(circle(self.includes), [])

    def test_the_rules_find_what_they_forbid(self):
        self.assertEqual(circle({"a": ["b"], "b": ["c"], "c": ["b"]}), ["b", "c", "b"])
        self.assertEqual(parting("core/data/x/a.hpp", "core/grid/b.hpp"), ("core/data", "core/grid"))
        self.assertIsNone(parting("core/data/a.hpp", "core/data/x/b.hpp"))
        self.assertEqual(namespace_of("components/mpm/solid/explicit/tasks"), "tushar::mpm::solid")
        self.assertEqual(namespace_of("components/mpm/shapes"), "tushar::mpm")
        self.assertEqual(namespace_of("core/input/geometry"), "tushar::input")


if __name__ == "__main__":
    unittest.main()
