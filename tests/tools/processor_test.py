#!/usr/bin/env python3
"""On a processor without the instructions it was compiled for, sus ends with a message, not with SIGILL."""
import pathlib
import shutil
import signal
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import modules  # noqa: E402

QEMU = shutil.which("qemu-x86_64")
SENTENCE = r"\Asus: this processor lacks instructions \({}\) for which sus was compiled; build it [^\n]+ \[T709\]\n\Z"
# A library with an initialiser that uses AVX2, as those of the core may.
LIBRARY = """#include <immintrin.h>
volatile int one = 1;
int sum = _mm256_extract_epi32(_mm256_add_epi32(_mm256_set1_epi32(one), _mm256_set1_epi32(2)), 5);
"""
PROGRAM = "extern int sum;\nint main() { return sum == 3 ? 0 : 9; }\n"


@unittest.skipUnless(QEMU, "needs qemu-x86_64 (Debian: qemu-user)")
class Processor(unittest.TestCase):
    def on(self, processor, *command, **environment):
        return modules.run([QEMU, "-cpu", processor, *command], **environment)

    def refused(self, done, instructions):
        self.assertEqual((done.returncode, done.stdout), (1, ""), done.stderr)
        self.assertRegex(done.stderr, SENTENCE.format(instructions))

    def build(self, here, march):
        """Builds a program with the check, and a library; all but its main is compiled for a given processor."""
        for name, text in (("library.cpp", LIBRARY), ("main.cpp", PROGRAM)):
            pathlib.Path(here, name).write_text(text)
        modules.must(["g++", "-O3", "-mavx2", "-shared", "-fPIC", "-o", f"{here}/liblibrary.so", f"{here}/library.cpp"])
        modules.must(["g++", "-O3", f"-march={march}", "-o", f"{here}/program", f"{here}/main.cpp",
                      ROOT / "tools/processor.cpp", f"{here}/liblibrary.so", f"-Wl,-rpath,{here}"])
        return f"{here}/program"

    def test_the_check_precedes_the_initialisers_of_libraries(self):
        with tempfile.TemporaryDirectory() as here:
            checked = self.build(here, "x86-64-v3")
            self.refused(self.on("Nehalem", checked), "avx")
            self.assertEqual(self.on("Haswell", checked).returncode, 0)
            unchecked = self.build(here, "x86-64")
            self.assertEqual(self.on("Nehalem", unchecked).returncode, -signal.SIGILL)

    def test_sus_has_the_check(self):
        march = [word for word in modules.compile_command() if word.startswith("-march")]
        defined = modules.run(["g++", *march, "-dM", "-E", "-x", "c++", "/dev/null"]).stdout
        if "__AVX__" not in defined or any("-fsanitize" in word for word in modules.compile_command()):
            self.skipTest("this sus runs on a processor without AVX, or has sanitizers")
        self.refused(self.on("Nehalem", modules.SUS, "-V"), "avx")


if __name__ == "__main__":
    unittest.main()
