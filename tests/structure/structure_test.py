#!/usr/bin/env python3
"""The layers of folders: which may include which, and which may see MPI, HDF5, PETSc and TBB."""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
# A folder includes itself and those before it.
ORDER = ["core/base", "core/input", "core/grid", "core/data", "core/tasks", "core/solvers", "core/numerics",
         "core/output", "core/collect", "core/report", "core/simulation", "core/scene", "core", "components", "tools"]
INCLUDE = re.compile(r'^\s*#include\s+[<"]([^>"]+)[>"]', re.MULTILINE)
FOREIGN = {"mpi.h": r"core/base/mpi.*", "core/base/mpi_native.hpp": r"core/base/mpi.*|core/solvers/petsc.*",
           "hdf5.h": r"core/output/archive.*", "petsc": r"core/solvers/petsc.*", "tbb/": r"core/base/threads.*"}


def sources():
    for folder in ("core", "components", "tools"):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in (".hpp", ".cpp"):
                yield file.relative_to(ROOT).as_posix(), file.read_text()


def layer(path):
    """Returns the index in ORDER of the folder that a file belongs to."""
    matching = [folder for folder in ORDER if path.startswith(folder + "/")]
    return ORDER.index(max(matching, key=len))


class Structure(unittest.TestCase):
    def test_a_folder_includes_itself_and_those_before_it(self):
        wrong = [f"{path} includes {name}" for path, text in sources() for name in INCLUDE.findall(text)
                 if (ROOT / name).is_file() and layer(name) > layer(path)]
        self.assertEqual(wrong, [])

    def test_every_include_of_ours_exists(self):
        wrong = [f"{path} includes {name}" for path, text in sources() for name in INCLUDE.findall(text)
                 if name.split("/")[0] in ("core", "components") and not (ROOT / name).is_file()
                 and not (ROOT / f"{name}.in").is_file()]
        self.assertEqual(wrong, [])

    def test_core_knows_no_component(self):
        wrong = [path for path, text in sources() if path.startswith("core/") and '"components/' in text]
        self.assertEqual(wrong, [])

    def test_only_their_own_files_include_libraries_that_must_not_spread(self):
        wrong = [f"{path} includes {name}" for path, text in sources() for name in INCLUDE.findall(text)
                 for library, allowed in FOREIGN.items() if name.startswith(library) and not re.match(allowed, path)]
        self.assertEqual(wrong, [])

    def test_no_file_has_more_than_400_lines(self):
        written = [file for folder in ("core", "components", "tools", "tests") for file in (ROOT / folder).rglob("*")
                   if file.suffix in (".hpp", ".cpp", ".py")]
        long = [file.relative_to(ROOT).as_posix() for file in written if file.read_text().count("\n") > 400]
        self.assertEqual(long, [])

    def test_tests_write_into_the_folder_of_their_process_alone(self):
        # CTest runs the tests of a file side by side: files that share a name overwrite one another.
        wrong = [path.relative_to(ROOT).as_posix() for path in (ROOT / "tests").rglob("*.?pp")
                 if "temp_directory_path" in path.read_text() and "benchmark" not in path.parts]
        self.assertEqual(wrong, ["tests/support/temporary.hpp"])

    def test_the_top_level_holds_what_it_should_and_nothing_else(self):
        listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True)
        if listed.returncode != 0:
            self.skipTest("git does not know what belongs here")
        allowed = {"CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "core", "components", "ups", "tests",
                   "tools"}
        found = {path.split("/")[0] for path in listed.stdout.splitlines() if not path.startswith(".")}
        self.assertEqual(found - allowed, set())

    def test_a_component_includes_no_other_except_reference_and_those_it_is_made_of(self):
        made_of = {"ice": ["euler"], "implicit_heat": ["heat"], "mpmice": ["euler", "ice", "mpm"]}
        wrong = []
        for path, text in sources():
            own = re.match(r"components/(\w+)/", path)
            others = [name for name in INCLUDE.findall(text) if own and name.startswith("components/")
                      and name.split("/")[1] not in (own[1], "reference", *made_of.get(own[1], []))]
            wrong += [f"{path} includes {name}" for name in others]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    unittest.main()
