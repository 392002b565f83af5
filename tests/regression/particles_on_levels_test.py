#!/usr/bin/env python3
"""Particles on the finest of several levels: the bits of the uniform fine grid, and refused scenes."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import archive_of, columns
from sus import bits_of, run
from uda import Folder

SCENE = "ups/solid/penetration_levels.ups"
SHORT = ("MaterialProperties/MPM/material[1]/geom_object/velocity=[4000,0,0]", "Time/max_Timesteps=160")


def changed(folder, *changes):
    """Replaces texts of the scene, [(pattern, text)], and returns its path."""
    text = pathlib.Path(SCENE).read_text()
    for pattern, replacement in changes:
        text, count = re.subn(pattern, replacement, text, flags=re.DOTALL)
        assert count, pattern
    path = pathlib.Path(folder) / "scene.ups"
    path.write_text(text)
    return str(path)


class ParticlesOnLevels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def particles(self, scene, name):
        """Returns position, velocity and stress of all particles at the end of a short run."""
        pathlib.Path(self.folder, name).mkdir()
        archive = archive_of(scene, f"{self.folder}/{name}", *SHORT)
        return [columns(archive, label, time=1) for label in ("p.velocity", "p.stress")]

    def test_have_the_bits_of_the_uniform_fine_grid(self):
        uniform = changed(self.folder, (r"  <AMR>.*</AMR>\n", ""), (r"\[32,32,1\]", "[256,256,1]"))
        self.assertEqual(self.particles(SCENE, "levels"), self.particles(uniform, "uniform"))

    def test_more_levels_than_the_grid_has_follow_them_unless_the_scene_says_no(self):
        silent = changed(self.folder, ("<adaptive>true</adaptive>", ""))
        self.assertEqual(run(silent, *SHORT).report["fingerprint"], run(SCENE, *SHORT).report["fingerprint"])
        still = changed(self.folder, ("<adaptive>true</adaptive>", "<adaptive>false</adaptive>"))
        self.assertIn("max_levels: does nothing", run(still, *SHORT[:1], "Time/max_Timesteps=1", options=()).err)

    def test_the_finest_level_follows_them(self):
        report = run(SCENE, *SHORT).report
        self.assertGreater(report["regrids"], 0)
        self.assertLess(sum(report["levels"]), .3 * 256 * 256)

    def test_layouts_threads_and_a_restart_change_no_bit(self):
        expected = bits_of(run(SCENE, *SHORT).report)
        for options in (("-layout", "1x1x1"), ("-layout", "4x4x1", "-nthreads", "2")):
            self.assertEqual(bits_of(run(SCENE, *SHORT, options=options).report), expected, options)
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(SCENE, *SHORT[:1], "DataArchiver/checkpoint/@timestepInterval=52", "Time/max_Timesteps=60")
        code, errors, report = folder.restart(SHORT[1], step=52)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(bits_of(report), expected)

    def test_a_body_that_is_too_thin_for_coarse_cells_is_there(self):
        thin = (r"\[0.1875,0.26,1\]", "[0.1775,0.26,1]")
        uniform = changed(self.folder, thin, (r"  <AMR>.*</AMR>\n", ""), (r"\[32,32,1\]", "[256,256,1]"))
        expected = run(uniform, "Time/max_Timesteps=1").report["particles"]
        levels = changed(self.folder, thin)
        self.assertEqual(run(levels, "Time/max_Timesteps=1").report["particles"], expected)

    def still(self, upper, resolution):
        """The scene with static refinement up to a corner."""
        blocks = "<AMR><Regridder><min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>"
        level = (f"</Level>\n<Level><Box label=\"fine\"><lower>[0.1,0.1,0]</lower><upper>{upper}</upper>"
                 f"<resolution>{resolution}</resolution></Box></Level>")
        return changed(self.folder, (r"<AMR>.*</AMR>", blocks), (r"</Level>", level))

    def test_bodies_in_coarse_cells_are_refused(self):
        result = run(self.still("[0.2,0.2,0.0015625]", "[16,16,1]"))
        self.assertEqual(result.code, 3)
        self.assertRegex(result.err, r"scene\.ups:\d+:\d+: particles of ball, plate are in coarser cells, or too close")

    def test_one_that_leaves_the_finest_cells_ends_the_run(self):
        result = run(self.still("[0.25,0.3,0.0015625]", "[24,32,1]"), SHORT[0])
        self.assertEqual(result.code, 4)
        self.assertRegex(result.err, r"particle \d+ came within \d cells of coarser cells, where particles are not "
                                     r"allowed")
        self.assertIn("try <adaptive>true</adaptive> in <AMR>", result.err)

    def test_one_that_leaves_cells_that_were_refined_once_ends_the_run(self):
        once = "<adaptive>true</adaptive><regrid_once>true</regrid_once>"
        result = run(changed(self.folder, ("<adaptive>true</adaptive>", once)), SHORT[0])
        self.assertEqual(result.code, 4)
        self.assertIn("of coarser cells, where particles are not allowed", result.err)
        self.assertIn("try no <regrid_once> in <AMR>", result.err)


if __name__ == "__main__":
    unittest.main()
