#!/usr/bin/env python3
"""Grids whose level consists of several boxes: inner sides act like sides of the grid, particles that pass them leave
it, results do not depend on patches, and what cannot run on such a grid is refused."""
import pathlib
import re
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
import tushar
from solids import RefusedSceneTest, SceneTest, archive_of, globals_of
from sus import ROOT, bits_of, run
from uda import FolderTest

SCENE = (ROOT / "ups/solid/shaft.ups").read_text()
SYMMETRY = '<BCType id="all" label="Symmetric" var="symmetry"/>'
FIXED = '<BCType id="all" label="Velocity" var="Dirichlet"><value>[0,0,0]</value></BCType>'
BLOCK = "<min>[0.375,0.625,0]</min><max>[0.625,0.875,0.03125]</max>"
GRAVITY = "[2,-9.81,0]"
SIDES = ("x-", "x+", "y+")
INTERPOLATORS = ("linear", "gimp", "mirrored gimp", "cpdi", "mirrored cpdi", "3rdorderBS")


def box_of(label):
    """The text of a box of the scene."""
    start = SCENE.index(f'      <Box label="{label}">')
    return SCENE[start:SCENE.index("</Box>", start) + len("</Box>\n")]


SHAFT, CHANNEL = box_of("shaft"), box_of("channel")


def scene(interpolator="gimp", condition=SYMMETRY, **changes):
    """The scene with another condition at the sides x-, x+ and y+, and with other texts."""
    images = "<mirror_images>true</mirror_images>" if interpolator.startswith("mirrored ") else ""
    text = SCENE.replace("<interpolator>gimp", f"{images}<interpolator>{interpolator.removeprefix('mirrored ')}")
    for side in SIDES:
        text = text.replace(f'<Face side="{side}">{SYMMETRY}</Face>',
                            f'<Face side="{side}">{condition}</Face>' if condition else "")
    for before, after in changes.items():
        text = text.replace(globals()[before], after)
    return text


def half_a_box_beside(text):
    """A box to the right of that of a scene, half as high."""
    lower, upper, cells = ([float(number) for number in re.search(rf"<{tag}>\s*\[(.*?)\]", text).group(1).split(",")]
                           for tag in ("lower", "upper", "resolution"))
    width, height = (upper[0] - lower[0]) / cells[0], (upper[1] - lower[1]) / cells[1]
    rows = int(cells[1]) // 2
    return (f"<Box><lower>[{upper[0]},{lower[1]},{lower[2]}]</lower>"
            f"<upper>[{upper[0] + 4 * width},{lower[1] + rows * height},{upper[2]}]</upper>"
            f"<resolution>[4,{rows},{int(cells[2])}]</resolution></Box>")


def sorted_rows(*arrays):
    """The rows of arrays side by side, in the order of their values, which does not depend on ids."""
    rows = np.hstack(arrays)
    return rows[np.lexsort(rows.T)]


class InnerSides(SceneTest):
    def particles_of(self, text, end):
        """Positions and velocities at the end."""
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(self.scene(text), folder, f"Time/maxTime={end}", f"DataArchiver/outputInterval={end}")
            with tushar.open(archive)[-1] as last:
                return sorted_rows(last["p.x"][:], last["p.velocity"][:])

    def assert_same(self, text, alone, end):
        """The particles of a scene must have the same bits in the scene with one of its boxes `alone`."""
        found, expected = (self.particles_of(one, end) for one in (text, text.replace(alone, "")))
        self.assertEqual(found.tobytes(), expected.tobytes(), np.abs(found - expected).max()
                         if found.shape == expected.shape else (found.shape, expected.shape))
        return found

    def test_a_block_in_the_shaft_moves_as_in_a_grid_of_the_shaft_alone(self):
        for interpolator in INTERPOLATORS:
            with self.subTest(interpolator):
                found = self.assert_same(scene(interpolator), CHANNEL, .035)
                self.assertLess(found[:, 4].mean(), -.9 * 9.81 * .035)

    def test_a_block_thrown_against_the_ceiling_of_the_channel_rebounds_as_from_a_side_of_the_grid(self):
        up = {"BLOCK": "<min>[0.75,0.25,0]</min><max>[0.9375,0.375,0.03125]</max>", "GRAVITY": "[9.81,19.62,0]"}
        for interpolator in INTERPOLATORS[1:]:
            for condition in (SYMMETRY, FIXED):
                with self.subTest(interpolator=interpolator, condition=condition):
                    found = self.assert_same(scene(interpolator, condition, **up), SHAFT, .13)
                    self.assertEqual(len(found), 12 * 8)
                    self.assertLess(found[:, 4].mean(), .5 * 19.62 * .13, "the ceiling stops it")

    def test_particles_leave_through_free_inner_sides_as_through_sides_of_the_grid(self):
        in_shaft = "<min>[0.4375,0.6875,0]</min><max>[0.5625,0.8125,0.0313]</max>"
        in_channel = "<min>[0.75,0.25,0]</min><max>[0.875,0.375,0.0313]</max>"
        for name, alone, block, end in (("shaft", CHANNEL, in_shaft, .2), ("channel", SHAFT, in_channel, .14)):
            with self.subTest(name):
                text = scene(condition="", BLOCK=block, GRAVITY="[4,0,0]" if name == "shaft" else "[0,19.62,0]")
                found = self.assert_same(text, alone, end)
                self.assertTrue(0 < len(found) < 64, len(found))

    def test_a_block_falls_out_of_the_shaft_like_a_free_body(self):
        for interpolator in ("linear", "gimp"):
            text = scene(interpolator, GRAVITY="[0,-9.81,0]")
            report = run(self.scene(text), "Time/maxTime=.3").report
            self.assertEqual((report["particles_dropped"], report["particles_removed"]), (0, 0))
            found = self.particles_of(text, .3)
            self.assertLess(found[:, 1].max(), .5, "all of it is in the channel")
            self.assertLess(np.ptp(found[:, 4]) / 9.81 / .3, 1e-9, "nothing holds it at the edges of the shaft")
            self.assertLess(np.abs(found[:, 3]).max(), 1e-9)

    def test_gravity_accelerates_a_block_that_is_pressed_against_the_wall_of_the_shaft(self):
        lines = globals_of("ups/solid/shaft.ups", "TotalMomentum", until=.3)["TotalMomentum"]
        mass = 1000 * .25 * .25 * .03125
        slower = [1 + line[2] / (mass * 9.81 * line[0]) for line in lines if line[0] > 0]
        self.assertLess(max(map(abs, slower[:len(slower) // 2])), 1e-8, "in the shaft")
        self.assertLess(max(map(abs, slower)), 1e-4, "while its upper end passes the edge")

    def test_several_boxes_that_fill_a_box_are_as_this_box(self):
        low = CHANNEL.replace("upper>[1,0.5", "upper>[1,0.25").replace("[32,16,1]", "[32,8,1]")
        high = CHANNEL.replace("lower>[0,0,", "lower>[0,0.25,").replace("[32,16,1]", "[32,8,1]")
        one = scene(BLOCK="<min>[0.25,0.125,0]</min><max>[0.5,0.375,0.03125]</max>").replace(SHAFT, "")
        two = one.replace(CHANNEL, low + high)
        prints = {run(self.scene(text), "Time/maxTime=.1").report["fingerprint"] for text in (one, two)}
        self.assertEqual(len(prints), 1)

    def test_outputs_say_which_cells_are_inside(self):
        with tempfile.TemporaryDirectory() as folder:
            with tushar.open(archive_of(self.scene(scene("linear")), folder, "Time/maxTime=.035",
                                         "DataArchiver/outputInterval=.035"))[-1] as last:
                grid, mass = last.grid, last["g.mass"][:]
        self.assertEqual(grid.inside.tolist(), [[0, 0, 0, 32, 16, 1], [12, 16, 0, 20, 32, 1]])
        self.assertEqual(grid.counts, [640])
        self.assertEqual(int(grid.mask("node").sum()), 33 * 17 + 9 * 16)
        self.assertTrue((mass[~grid.mask("node")] == 0).all())
        self.assertAlmostEqual(float(mass.sum()), 1000 * .25 * .25 * .03125, places=9)


class Patches(FolderTest):
    def test_the_same_bits_on_any_patches_threads_ranks_and_after_a_restart(self):
        name, steps = "ups/solid/shaft.ups", 1300  # it has passed the edges of the shaft, and landed
        prints = {self.bits_of_two_parts(name, steps)}
        for layout, threads, ranks in (("1x1x1", 1, 1), ("2x2x1", 2, 1), ("3x3x1", 1, 3), ("32x32x1", 2, 1),
                                       ("1x7x1", 1, 2), ("5x1x1", 2, 1)):
            done = run(name, f"Time/max_Timesteps={steps}", ranks=ranks,
                       options=("--quiet", "-layout", layout, "-nthreads", str(threads)))
            self.assertIsNotNone(done.report, done.err)
            prints.add(bits_of(done.report))
        self.assertEqual(len(prints), 1)

    def test_cuts_may_follow_the_particles(self):
        steps = "Time/max_Timesteps=700"
        expected = run("ups/solid/shaft.ups", steps, options=("--quiet", "-layout", "1x1x1")).report["fingerprint"]
        self.assertEqual(run("ups/solid/shaft.ups", steps, ranks=3).report["fingerprint"], expected)

    def test_a_restart_with_other_boxes_is_refused(self):
        folder = self.folder()
        folder.run("ups/solid/shaft.ups", "DataArchiver/checkpoint/@timestepInterval=2", "Time/max_Timesteps=3")
        code, errors, _ = folder.restart("Grid/Level/Box[2]/upper=[0.625,0.96875,0.03125]",
                                         "Grid/Level/Box[2]/resolution=[8,15,1]",
                                         "Grid/Level/Box[1]/upper=[1,0.5,0.03125]", step=2)
        self.assertEqual(code, 3)
        self.assertIn("the checkpoint has a different grid from the scene", errors)


class Refusals(RefusedSceneTest):
    def test_boxes_that_do_not_form_a_level(self):
        apart = SHAFT.replace("lower>[0.375,0.5,", "lower>[0.375,0.53125,").replace("[8,16,1]", "[8,15,1]")
        for text, sentence in (
                (SHAFT.replace("[8,16,1]", "[8,17,1]"),
                 "its cells are 0.0294118 m wide along y, but those of the first "),
                (SHAFT.replace("[0.375,", "[0.36,").replace("[0.625,", "[0.61,"),
                 "its lower corner is 0.36 m from that of the first Box along x, at "),
                (SHAFT.replace("lower>[0.375,0.5,", "lower>[0.375,0.375,").replace("[8,16,1]", "[8,20,1]"),
                 "overlaps the Box at "),
                (apart, "is apart from the Box at "),
                (SHAFT + SHAFT.replace("[0.375,", "[0.6875,").replace("[0.625,", "[0.9375,"),
                 "comes too close to the Box at "),
                (SHAFT + "<periodic>[1,0,0]</periodic>",
                 "found [1,0,0], expected [0,0,0]: a Level of several boxes cannot be periodic")):
            with self.subTest(sentence):
                self.assert_refused(SCENE.replace(SHAFT, text), sentence)

    def test_components_that_know_one_box_only(self):
        for name in ("poisson/sine", "euler/sedov", "ice/jet", "mpm/sedov", "solid/implicit_cantilever"):
            with self.subTest(name):
                text = (ROOT / f"ups/{name}.ups").read_text()
                kind = re.search('SimulationComponent type="(.*?)"', text).group(1)
                self.assert_refused(text.replace("</Box>", f"</Box>{half_a_box_beside(text)}", 1),
                                    f"Grid/Level/Box: '{kind}' needs a grid of one box: it takes the cells between "
                                    "the boxes for cells of the grid")

    def test_what_solids_cannot_do_on_several_boxes(self):
        regridder = "<AMR><Regridder><max_levels>2</max_levels></Regridder></AMR>"
        module = ('<DataAnalysis><Module name="minMax"><samplingFrequency>1</samplingFrequency><timeStart>0</timeStart>'
                  '<timeStop>1</timeStop><Variables>'
                  '<analyze label="g.mass"/></Variables></Module></DataAnalysis>')
        solution = (ROOT / "ups/solid/axis_aligned.ups").read_text()
        solution = solution.replace("</Box>", f"</Box>{half_a_box_beside(solution)}", 1)
        for text, sentence in ((solution, "needs a grid of one box: the solution of <RunMMSProblem> fills the box"),
                               (SCENE.replace("</Grid>", f"</Grid>{regridder}"),
                                "a grid of several levels needs one Box in its first Level"),
                               (SCENE.replace("</Grid>", f"</Grid>{module}"),
                                "DataAnalysis/Module: needs a grid of one box: the first Level has several")):
            with self.subTest(sentence):
                self.assert_refused(text, sentence)


if __name__ == "__main__":
    unittest.main()
