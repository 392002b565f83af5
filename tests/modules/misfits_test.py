#!/usr/bin/env python3
"""A module that cannot be loaded ends sus with one sentence, before anything is written."""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import modules  # noqa: E402
from sus import SUS, on_ranks  # noqa: E402

SCENE = ROOT / "ups/heat/sine.ups"
CARD = """#include "core/simulation/module_card.hpp"
using namespace tushar::simulation;
extern "C" const ModuleCard tusharModule;
const ModuleCard tusharModule{%s, "other", nullptr};
"""


class Misfits(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        self.module = self.here / "other.so"

    def refused(self, *options, **environment):
        """Returns the sentence with which sus ends; checks that it has written nothing."""
        output = self.here / "output"
        done = modules.run([SUS, SCENE, "--quiet", *options, "--output", output], **environment)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"\Asus: [^\n]+\n\Z")
        self.assertFalse(output.exists())
        return re.sub(r" \[T70[568]\]\n\Z", "\n", done.stderr)

    def build(self, text, *flags):
        """Compiles a module from one source with the flags of this build and further ones."""
        source = self.here / "other.cpp"
        source.write_text(text)
        kept = [word for word in modules.compile_command() if word.startswith(("-D", "-I", "-march", "-std", "-fsan"))]
        modules.must(["g++", *kept, "-fPIC", *flags, "-shared", "-o", self.module, source])

    def misfit(self, abi=None, *flags):
        """Returns the message about a module with a card of its own."""
        self.build(CARD % (abi or f'abiWith("{modules.interface()}")'), *flags)
        sentence = self.refused("--load", self.module)
        self.assertIn(f"the module {self.module} does not match this program: ", sentence)
        self.assertIn("; rebuild it\n", sentence)
        return sentence

    def test_another_version(self):
        self.assertIn("it was built for Tushar 9.8.7, but this is ",
                      self.misfit(None, "-UTUSHAR_VERSION", '-DTUSHAR_VERSION="9.8.7"'))

    def test_another_compiler(self):
        self.assertIn("it was compiled by clang 99, but this program was compiled by ",
                      self.misfit('{TUSHAR_VERSION, "clang 99", "0", checksEveryIndex, __BIGGEST_ALIGNMENT__}'))

    def test_other_checks(self):
        has = "-DTUSHAR_CHECKS" in modules.compile_command()
        words = ("out", "") if has else ("", "out")
        self.assertIn("it was compiled with%s TUSHAR_CHECKS, but this program was compiled with%s it" % words,
                      self.misfit(None, "-UTUSHAR_CHECKS" if has else "-DTUSHAR_CHECKS"))

    def test_another_alignment(self):
        own = [word for word in modules.compile_command() if word.startswith(("-march", "-std"))]
        said = modules.run(["g++", *own, "-dM", "-E", "-x", "c++", "/dev/null"]).stdout
        bytes_here = int(said.split("__BIGGEST_ALIGNMENT__ ")[1].split()[0])
        flags = ("-mavx",) if bytes_here == 16 else ("-march=x86-64",)
        there = 32 if bytes_here == 16 else 16
        self.assertIn(f"it was compiled for vectors of {there} bytes, but this program for {bytes_here} bytes: use "
                      f"the same -march", self.misfit(None, *flags))

    def test_other_headers(self):
        self.assertIn("it was built with different headers of the same version",
                      self.misfit('abiWith("0123456789abcdef")'))

    def test_the_card_is_read_before_calls_are_looked_up(self):
        self.build((CARD % 'abiWith("0")') + "void nowhere();\nvoid f() { nowhere(); }\n")
        self.assertIn("does not match this program", self.refused("--load", self.module))

    def test_calls_of_what_is_nowhere(self):
        self.build((CARD % f'abiWith("{modules.interface()}")') + "void nowhere();\nvoid f() { nowhere(); }\n")
        sentence = self.refused("--load", self.module)
        self.assertIn(f"the module {self.module} cannot be loaded: ", sentence)
        self.assertIn("nowhere", sentence)

    def test_a_library_that_is_no_module(self):
        self.build("int three() { return 3; }\n")
        self.assertIn(f"{self.module} is not a module of Tushar: it has no symbol tusharModule",
                      self.refused("--load", self.module))

    def test_a_file_that_is_no_library(self):
        sentence = f"sus: {self.module} is not a module of Tushar: it is not a shared library\n"
        for text in ("a text\n", ""):
            self.module.write_text(text)
            self.assertEqual(self.refused("--load", self.module), sentence)
        self.module.unlink()
        self.module.mkdir()
        self.assertEqual(self.refused("--load", self.module), sentence)

    def test_a_library_that_is_cut_off(self):
        whole = (modules.BUILD / "modules/tushar_heat.so").read_bytes()
        for size in (40, 1000, len(whole) // 2, len(whole) - 1):
            self.module.write_bytes(whole[:size])
            self.assertEqual(self.refused("--load", self.module),
                             f"sus: {self.module} is not a module of Tushar: the file is truncated\n", size)

    def test_a_file_that_is_not_there(self):
        self.assertEqual(self.refused("--load", "nothere.so"), "sus: there is no module nothere.so\n")

    def test_a_folder_that_is_not_there(self):
        self.assertEqual(self.refused(TUSHAR_PLUGINS=f"{self.here}:/nowhere"),
                         "sus: TUSHAR_PLUGINS: there is no folder /nowhere\n")

    def test_a_name_that_is_taken(self):
        heat = modules.BUILD / "modules/tushar_heat.so"
        self.assertEqual(self.refused("--load", heat),
                         f"sus: the module {heat} cannot be added: the name 'heat' is taken\n")
        shutil.copy(heat, self.here / "again.so")
        self.assertIn("again.so cannot be added: the name 'heat' is taken",
                      self.refused(TUSHAR_PLUGINS=str(self.here)))

    def test_several_ranks_say_it_once(self):
        if not shutil.which("mpirun"):
            self.skipTest("needs mpirun")
        done = modules.run([*on_ranks(2), SUS, SCENE, "--load", "nothere.so", "--output", self.here / "output"])
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(done.stderr.count("there is no module nothere.so"), 1)


if __name__ == "__main__":
    unittest.main()
