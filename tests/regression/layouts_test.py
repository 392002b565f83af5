#!/usr/bin/env python3
"""Results are bitwise equal on any patches and threads: every scene, every variant, in one, two and three dimensions.
For a grid of several levels, a layout is the largest number of blocks in a patch along each axis."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, bits_of, run
from uda import words_of

TRACKED = "MPM/gas_dynamics/volume_model=tracked"
RESEED = "MPM/gas_dynamics/redistribute/mode=reseed"
PLANE = ("Grid/Level/Box/resolution=[40,6,1]", "Grid/Level/Box/upper=[1,.15,1]")
SPACE = ("Grid/Level/Box/resolution=[20,4,3]", "Grid/Level/Box/upper=[1,.2,.15]")


# Patches along the axes with several cells, by their number: 1, 2, 7 and 64 and some more.
LAYOUTS = {1: ((1,), (2,), (3,), (7,), (64,)), 2: ((1, 1), (2, 1), (1, 7), (3, 2), (8, 8)),
           3: ((1, 1, 1), (2, 1, 1), (1, 7, 1), (3, 2, 2), (4, 4, 4))}
STEPS = {1: 250, 2: 12, 3: 6}
THREADS = (1, 2, 4)
# A global solve may round otherwise on other patches.
IMPLICIT = re.compile(r'<time_integrator>\s*implicit\s*<|type="impm"')


def cells_of(scene):
    """Returns the number of cells along x, y, z."""
    return [int(count) for count in re.search(r"<resolution>\s*\[(.*?)\]", scene.read_text()).group(1).split(",")]


def layouts_of(cells):
    """Layouts for a grid, with no more patches along an axis than cells; one where a symmetry plane leaves an axis
    out."""
    axes = [axis for axis in range(3) if cells[axis] > 1] or [0]
    for patches in LAYOUTS[len(axes)]:
        layout = [1, 1, 1]
        for axis, count in zip(axes, patches):
            layout[axis] = min(count, cells[axis])
        yield str(layout).replace(" ", "")


class Layouts(unittest.TestCase):
    def assert_same(self, scene, layouts, *sets, turn=0):
        """Asserts the same outcome, fingerprint and number of steps for any patches, on 1, 2 and 4 threads in turn."""
        prints = {}
        for place, layout in enumerate(layouts):
            threads = THREADS[(turn + place) % len(THREADS)]
            options = ("--quiet", "-nthreads", str(threads), "-layout", words_of(layout))
            result = run(scene, *sets, options=options)
            self.assertIsNotNone(result.report, result.err)
            found = (result.code, bits_of(result.report), result.report["steps"])
            prints.setdefault(found, []).append((layout, threads))
        self.assertEqual(len(prints), 1, f"{scene} {sets}: {prints}")

    def assert_all_same(self, folders):
        scenes = sorted(path for folder in folders for path in (ROOT / "ups" / folder).glob("*.ups"))
        for turn, scene in enumerate(scene for scene in scenes if not IMPLICIT.search(scene.read_text())):
            cells = cells_of(scene)
            steps = STEPS[max(1, sum(count > 1 for count in cells))]
            self.assert_same(scene, layouts_of(cells), f"Time/max_Timesteps={steps}", turn=turn)

    def test_every_scene_of_gas_particles(self):
        self.assert_all_same(["mpm"])

    def test_every_scene_of_solids(self):
        self.assert_all_same(["solid"])

    def test_every_scene_of_the_gallery_of_extremes(self):
        self.assert_all_same(["stability"])

    def test_every_other_scene(self):
        folders = {path.parent.name for path in (ROOT / "ups").glob("*/*.ups")}
        self.assert_all_same(sorted(folders - {"mpm", "solid", "stability"}))

    def test_particles_that_keep_their_mass(self):
        self.assert_same("ups/mpm/sod.ups", ["[1,1,1]", "[7,1,1]", "[64,1,1]"], TRACKED)

    def test_redistribution_in_both_modes_and_volume_models(self):
        for sets in ((RESEED,), (TRACKED,), (RESEED, TRACKED)):
            self.assert_same("ups/mpm/sod_redistribute.ups", ["[1,1,1]", "[3,1,1]", "[64,1,1]"], *sets)

    def test_particles_at_drawn_places(self):
        for placement in ("jittered", "random"):
            sets = [f"MaterialProperties/MPM/material/geom_object/placement={placement}",
                    "MaterialProperties/MPM/material/geom_object/seed=5"]
            self.assert_same("ups/mpm/smooth_wave.ups", ["[1,1,1]", "[7,1,1]", "[64,1,1]"], "Time/max_Timesteps=20",
                             *sets)
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
