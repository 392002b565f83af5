#!/usr/bin/env python3
"""A truncated or altered checkpoint is reported and skipped, or the damage has no effect.

Some places of each file; PLACES=1000 tests/regression/damage_test.py harms more.
"""
import os
import pathlib
import random
import re
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from uda import Folder

PLACES = int(os.environ.get("PLACES", 30))
RANKS = 2
SOD = "ups/mpm/sod.ups"
PAGE = 4096


class Damage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Makes a run with its last two checkpoints that ends a few steps later; the tests restart from it."""
        cls.whole = Folder()
        cls.addClassCleanup(cls.whole.cleanup)
        cls.fingerprint = cls.whole.run(SOD)[2]["fingerprint"]
        cls.cut = Folder()
        cls.addClassCleanup(cls.cut.cleanup)
        cls.cut.run(SOD, "Time/max_Timesteps=215", "DataArchiver/checkpoint/@timestepInterval=5",
                    "DataArchiver/checkpoint/@cycle=2")
        cls.files = [path.relative_to(cls.cut.uda) for path in cls.cut.checkpoints[-1].iterdir()]
        cls.files.append(pathlib.Path("checkpoints/LATEST"))

    def go_on(self, file, content, ranks=1):
        """Restarts with other content of a file; whether it reports the damage. The bits are the same
        whatever happens."""
        here = Folder(ranks=ranks)
        self.addCleanup(here.cleanup)
        shutil.copytree(self.cut.path, here.path, symlinks=True, dirs_exist_ok=True)
        (here.uda / file).write_bytes(content)
        code, errors, report = here.restart("Time/max_Timesteps=1000")
        here.cleanup()
        self.assertEqual((code, report and report["fingerprint"]), (0, self.fingerprint), errors)
        told = re.search(r"sus: the checkpoint \S+t00215 is damaged: .*\n"
                         r"sus: continues from the checkpoint of step 210\n", errors)
        self.assertTrue(told or errors == "", errors)
        return bool(told)

    def content(self, file):
        return (self.cut.uda / file).read_bytes()

    def flipped(self, file, chance):
        content = bytearray(self.content(file))
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
        return bytes(content)

    def test_a_file_that_is_cut_short_at_any_page(self):
        for file in self.files:
            for length in range(0, len(self.content(file)), PAGE):
                told = self.go_on(file, self.content(file)[:length])
                self.assertEqual(told, file.name != "LATEST", f"{file} of {length} bytes")

    def test_a_byte_that_has_changed(self):
        chance = random.Random(1000)
        sizes = [max(PAGE, len(self.content(file))) for file in self.files]
        for file in chance.choices(self.files, sizes, k=PLACES):
            self.assertEqual(self.go_on(file, self.flipped(file, chance)), file.name != "LATEST", file)

    def test_damage_under_ranks(self):
        chance = random.Random(2)
        for file in self.files:
            for _ in range(max(1, PLACES // 30)):
                content = self.content(file)
                self.go_on(file, self.flipped(file, chance), RANKS)
                self.go_on(file, content[:chance.randrange(len(content))], RANKS)


if __name__ == "__main__":
    unittest.main()
