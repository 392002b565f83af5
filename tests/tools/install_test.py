#!/usr/bin/env python3
"""The files of `cmake --install` work where installed, also after a move; other repositories build on them.

Installs this build; a repository of `tools/new_component --outside` is compiled without optimisation.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import modules  # noqa: E402

INCLUDE = re.compile(r'^\s*#include\s+([<"])([^>"]+)[>"]', re.MULTILINE)
FOREIGN = ("mpi.h", "hdf5.h", "petsc", "tbb/", "nlohmann/", "muParser", "xxhash")


class Install(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.here = pathlib.Path(folder.name)
        modules.must(["cmake", "--install", modules.BUILD, "--prefix", cls.here / "first"])
        cls.prefix = cls.here / "moved"
        (cls.here / "first").rename(cls.prefix)
        cls.sus = cls.prefix / "bin/sus"

    def run_away(self, command, **environment):
        """Runs a command without this build's libraries on its path."""
        environment["LD_LIBRARY_PATH"] = ""
        return modules.run(command, self.here, **environment)

    def test_sus_finds_its_modules_and_petsc(self):
        for scene in ("ups/heat/sine.ups", "ups/poisson/sine.ups"):
            done = self.run_away([self.sus, ROOT / scene, "--quiet", "--output", self.here])
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        listed = self.run_away([self.sus, "--list"])
        self.assertEqual(listed.stdout, modules.run([modules.SUS, "--list"]).stdout)

    def test_nothing_points_to_the_build(self):
        for file in [self.sus, *self.prefix.rglob("*.so")]:
            dynamic = subprocess.run(["readelf", "-d", file], capture_output=True, text=True, check=True).stdout
            self.assertNotIn(str(modules.BUILD), dynamic, file)
        for file in self.prefix.rglob("*.cmake"):
            self.assertNotIn(str(ROOT), file.read_text(), file)

    def test_headers_include_only_headers_that_are_installed(self):
        headers = self.prefix / "include/tushar"
        found = {header.relative_to(headers).as_posix(): INCLUDE.findall(header.read_text())
                 for header in headers.rglob("*.hpp")}
        self.assertIn("core/core.hpp", found)
        self.assertIn("components/reference/gas_module.hpp", found)
        wrong = [f"{path} includes {name}" for path, names in found.items() for mark, name in names
                 if (mark == '"' and name not in found) or name.startswith(FOREIGN)]
        self.assertEqual(wrong, [])

    def test_a_repository_outside_builds_and_passes(self):
        outside = self.here / "outside"
        modules.must([ROOT / "tools/new_component", "--outside", outside, "wave"])
        modules.must(["cmake", "-S", outside, "-B", outside / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
                      f"-DCMAKE_PREFIX_PATH={self.prefix}"])
        modules.must(["cmake", "--build", outside / "build"])
        tested = self.run_away(["ctest", "--test-dir", outside / "build", "--output-on-failure"])
        self.assertEqual(tested.returncode, 0, tested.stdout)
        self.assertIn("Wave.", tested.stdout)
        self.assertRegex(tested.stdout, "100% tests passed, 0 tests failed out of [5-9]")
        scene = [self.sus, outside / "ups/wave.ups", "--quiet", "--output", self.here]
        loaded = self.run_away([*scene, "--load", outside / "build/tushar_wave.so"])
        self.assertEqual((loaded.returncode, loaded.stderr), (0, ""))
        found = self.run_away(scene, TUSHAR_PLUGINS=str(outside / "build"))
        self.assertEqual((found.returncode, found.stderr), (0, ""))
        unknown = self.run_away(scene)
        self.assertEqual(unknown.returncode, 3)
        self.assertIn("wave", unknown.stderr)
        self.refuses_flags_of_its_sources(outside, scene)

    def refuses_flags_of_its_sources(self, outside, scene):
        """The repository gives its sources, not the card, flags that the program does not have."""
        has = "-DTUSHAR_CHECKS" in modules.compile_command()
        with open(outside / "CMakeLists.txt", "a") as lists:
            lists.write(f"target_compile_options(tushar_wave_objects PRIVATE -{'UD'[not has]}TUSHAR_CHECKS)\n")
        modules.must(["cmake", "--build", outside / "build", "--target", "tushar_wave"])
        loaded = self.run_away([*scene, "--load", outside / "build/tushar_wave.so"])
        self.assertEqual(loaded.returncode, 1)
        self.assertIn(f"it was compiled with{'out' if has else ''} TUSHAR_CHECKS", loaded.stderr)

    def test_a_repository_outside_replaces_nothing(self):
        (self.here / "mine").mkdir()
        (self.here / "mine/notes.txt").write_text("mine\n")
        done = modules.run([ROOT / "tools/new_component", "--outside", self.here / "mine", "wave"])
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("exists already, and is not an empty folder", done.stderr)
        self.assertEqual([file.name for file in (self.here / "mine").iterdir()], ["notes.txt"])


class Package(unittest.TestCase):
    def test_a_debian_package_names_what_it_needs_and_runs(self):
        if not shutil.which("dpkg-shlibdeps"):
            self.skipTest("needs dpkg-shlibdeps (Debian: dpkg-dev)")
        with tempfile.TemporaryDirectory() as folder:
            here = pathlib.Path(folder)
            modules.must(["cpack", "-G", "DEB", "--config", modules.BUILD / "CPackConfig.cmake", "-B", here], here)
            package = next(here.glob("tushar_*.deb"))
            needs = modules.run(["dpkg-deb", "-f", package, "Depends"]).stdout
            for library in ("libpetsc-real", "libhdf5-openmpi", "libopenmpi", "libmuparser", "libtbb", "libfmt"):
                self.assertIn(library, needs)
            self.assertNotIn("tushar", needs)
            modules.must(["dpkg-deb", "-x", package, here / "root"])
            done = modules.run([here / "root/usr/bin/sus", ROOT / "ups/poisson/sine.ups", "--quiet", "--output", here],
                               here, LD_LIBRARY_PATH="")
            self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
