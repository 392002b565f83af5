#!/usr/bin/env python3
"""The same bits on any patches and threads: every scene, every variant, in one, two and three dimensions."""
import itertools
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, run

TRACKED = "MPM/gas_dynamics/volume_model=tracked"
RESEED = "MPM/gas_dynamics/redistribute/mode=reseed"
PLANE = ("Grid/Level/Box/resolution=[40,6,1]", "Grid/Level/Box/upper=[1,.15,1]")
SPACE = ("Grid/Level/Box/resolution=[20,4,3]", "Grid/Level/Box/upper=[1,.2,.15]")


def scenes(dimensions):
    """The scenes of particles and of heat with so many axes of more than one cell."""
    for scene in sorted((ROOT / "ups/mpm").glob("*.ups")) + sorted((ROOT / "ups/heat").glob("*.ups")) + \
            sorted((ROOT / "ups/burgers").glob("*.ups")) + sorted((ROOT / "ups/poisson").glob("*.ups")):
        cells = re.search(r"<resolution>\s*\[(.*?)\]", scene.read_text()).group(1).split(",")
        if sum(int(count) > 1 for count in cells) == dimensions:
            yield scene


class Layouts(unittest.TestCase):
    def assert_same(self, scene, layouts, *sets):
        """One fingerprint and one number of steps, whatever the patches and threads: 1, 2 and 4 in turn."""
        prints = {}
        for layout, threads in zip(layouts, itertools.cycle((1, 2, 4))):
            options = ("--quiet", "-nthreads", str(threads))
            result = run(scene, *sets, f"Grid/Level/Box/patches={layout}", options=options)
            self.assertEqual(result.code, 0, result.err)
            prints.setdefault((result.report["fingerprint"], result.report["steps"]), []).append((layout, threads))
        self.assertEqual(len(prints), 1, f"{scene} {sets}: {prints}")

    def test_every_scene_in_one_dimension_on_1_2_3_7_and_64_patches(self):
        for scene in scenes(1):
            self.assert_same(scene, [f"[{n},1,1]" for n in (1, 2, 3, 7, 64)])

    def test_every_scene_in_two_dimensions(self):
        for scene in scenes(2):
            self.assert_same(scene, ["[1,1,1]", "[3,2,1]", "[7,5,1]"], "Time/max_Timesteps=12")

    def test_every_scene_in_three_dimensions(self):
        for scene in scenes(3):
            self.assert_same(scene, ["[1,1,1]", "[3,2,2]"], "Time/max_Timesteps=6")

    def test_finite_volumes_in_one_and_two_dimensions(self):
        self.assert_same("ups/euler/sod.ups", [f"[{n},1,1]" for n in (1, 2, 3, 7, 64)])
        for scene in ("lax_liu_3", "sedov", "shock_bubble", "vortex", "gresho", "noh", "sod_diagonal", "kelvin_helmholtz"):
            self.assert_same(f"ups/euler/{scene}.ups", ["[1,1,1]", "[3,2,1]", "[7,5,1]"], "Time/max_Timesteps=12")

    def test_particles_that_keep_their_mass(self):
        self.assert_same("ups/mpm/sod.ups", ["[1,1,1]", "[7,1,1]", "[64,1,1]"], TRACKED)

    def test_redistribution_in_both_modes_and_volume_models(self):
        for sets in ((RESEED,), (TRACKED,), (RESEED, TRACKED)):
            self.assert_same("ups/mpm/sod_redistribute.ups", ["[1,1,1]", "[3,1,1]", "[64,1,1]"], *sets)

    def test_particles_at_drawn_places(self):
        for placement in ("jittered", "random"):
            sets = [f"MaterialProperties/MPM/material/geom_object/placement={placement}",
                    "MaterialProperties/MPM/material/geom_object/seed=5"]
            self.assert_same("ups/mpm/smooth_wave.ups", ["[1,1,1]", "[7,1,1]", "[64,1,1]"], "Time/max_Timesteps=20", *sets)
            self.assert_same("ups/mpm/smooth_wave.ups", ["[1,1,1]", "[3,2,1]"], "Time/max_Timesteps=5", *PLANE, *sets)

    def test_two_dimensions(self):
        for sets in ((), (TRACKED,)):
            self.assert_same("ups/mpm/sod.ups", ["[1,1,1]", "[3,2,1]", "[40,6,1]"], *PLANE, *sets)
        self.assert_same("ups/mpm/sod_redistribute.ups", ["[1,1,1]", "[5,3,1]"], *PLANE, RESEED)
        self.assert_same("ups/heat/sine.ups", ["[1,1,1]", "[3,2,1]"], *PLANE)

    def test_three_dimensions(self):
        self.assert_same("ups/mpm/sod.ups", ["[1,1,1]", "[3,2,2]", "[20,4,3]"], *SPACE)
        self.assert_same("ups/mpm/sod_redistribute.ups", ["[1,1,1]", "[4,2,3]"], *SPACE, TRACKED)

    def test_a_value_that_differs_gives_another_fingerprint(self):
        ours = run("ups/mpm/sod.ups").report["fingerprint"]
        other = run("ups/mpm/sod.ups", "MPM/gas_dynamics/cfl=0.2125000001").report["fingerprint"]
        self.assertNotEqual(ours, other)


if __name__ == "__main__":
    unittest.main()
