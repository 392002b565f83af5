#!/usr/bin/env python3
"""-layout AxBxC: patches from the command line instead of the scene's, at the start and at a restart."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import run
from uda import Folder

SOD = "ups/mpm/sod.ups"
BOX = "Grid/Level/Box/"


class LayoutOption(unittest.TestCase):
    def patches(self, layout, *sets):
        """Returns the patches of a run and its fingerprint."""
        result = run(SOD, "Time/max_Timesteps=5", *sets, options=("--quiet", *layout))
        self.assertEqual((result.code, result.err), (0, ""))
        return result.report["layout"]["patches"], result.report["fingerprint"]

    def test_it_rules_whatever_the_scene_says_and_changes_no_bit(self):
        fingerprint = self.patches(())[1]
        for layout, patches in (("7x1x1", 7), ("100x1x1", 100)):
            self.assertEqual(self.patches(("-layout", layout), BOX + "patches=[3,1,1]"), (patches, fingerprint))

    def test_it_rules_after_a_restart(self):
        here = Folder()
        self.addCleanup(here.cleanup)
        here.run(SOD, "Time/max_Timesteps=5", "DataArchiver/checkpoint/@timestepInterval=5")
        code, errors, report = here.finish(["-restart", here.uda, "-layout", "6x1x1"], ["Time/max_Timesteps=9"])
        self.assertEqual((code, errors, report["layout"]["patches"]), (0, "", 6))

    def test_nonsense_gets_a_sentence(self):
        for layout in ("4", "4x2", "0x1x1", "axbxc", "4x2x1x1"):
            result = run(SOD, options=("-layout", layout))
            self.assertEqual(result.code, 2)
            self.assertEqual(result.err.splitlines()[0], f"--layout: found '{layout}', expected AxBxC, the numbers of "
                                                         "patches along x, y and z, such as 4x2x1 [T701]")
        result = run(SOD, options=("-layout", "101x1x1"))
        self.assertEqual(result.code, 3)
        self.assertIn("there are 101 patches along x in --layout, but only 100 cells", result.err)


if __name__ == "__main__":
    unittest.main()
