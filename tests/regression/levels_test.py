#!/usr/bin/env python3
"""Grids of several levels: bitwise equal results on any patches, threads and ranks, after restarts, for mirror images,
and for grids that are specified in another way; conservation between levels; errors of the finest cells."""
import pathlib
import re
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[up] / part) for up, part in
                ((1, "support"), (2, "tools/python"))]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import numpy as np

from sus import ROOT, bits_of, run
from tushar.archive import Archive
from uda import FolderTest

REGRIDDER = "AMR/Regridder/"
BASE = "Grid/Level/Box/resolution="
PLANE = (BASE + "[16,16,1]", REGRIDDER + "min_patch_size=[[4,4,1]]", REGRIDDER + "max_levels=3",
         REGRIDDER + "min_timestep_interval=4")
# Scene -> what makes it small, and steps in which its grid changes several times, unless it stays.
SCENES = {"ups/euler/sod_levels.ups": ((), 60), "ups/euler/lax_liu_3_levels.ups": (PLANE, 80),
          "ups/euler/blast_levels.ups": (PLANE, 120), "ups/heat/levels.ups": ((), 60),
          "ups/euler/noh_levels.ups": ((), 40),
          "ups/heat/spot_levels.ups": (("Heat/refinement_tolerance=.004", REGRIDDER + "min_patch_size=[[4,4,1]]",
                                        REGRIDDER + "min_timestep_interval=4"), 60),
          "ups/burgers/levels.ups": ((), 60)}
SIDE_WALLS = "".join(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                     for side in ("x-", "x+", "y-", "y+", "z-", "z+"))


def steps(count):
    return f"Time/max_Timesteps={count}"


def scene_of(levels="", amr="", pressure="1", density="1", velocity="[0,0,0]", cells=16, sides=SIDE_WALLS):
    """Returns a scene of a gas, between walls by default, in a square whose cell centres are exact numbers."""
    return f"""<Uintah_specification>
  <Meta><title>levels</title></Meta>
  <SimulationComponent type="euler"/>
  <Time><maxTime>0.2</maxTime></Time>
  <Grid>
    <BoundaryConditions>{sides}</BoundaryConditions>
    <Level>
      <Box><lower>[-.5,-.5,0]</lower><upper>[.5,.5,1]</upper><resolution>[{cells},{cells},1]</resolution></Box>
    </Level>
    {levels}
  </Grid>
  <AMR><Regridder><min_patch_size>[[4,4,1]]</min_patch_size>{amr}</AMR>
  <DataArchiver>
    <filebase>levels.uda</filebase>
    <outputInterval>0</outputInterval><outputInitTimestep/><outputLastTimestep/>
    <save label="c.density"/><save label="c.velocity"/><save label="c.pressure"/>
  </DataArchiver>
  <Euler>
    <gas><gamma>1.4</gamma></gas>
    <geom_object>
      <box><min>[-1,-1,0]</min><max>[1,1,1]</max></box>
      <density>{density}</density><velocity>{velocity}</velocity><pressure>{pressure}</pressure>
    </geom_object>
  </Euler>
</Uintah_specification>"""


def adaptive(more=""):
    """Returns the content of <AMR>: three levels where the density or the pressure jumps by a tenth."""
    jumps = "".join(f'<Variable name="{name}" value=".1"/>' for name in ("c.density", "c.pressure"))
    return (f"<max_levels>3</max_levels><min_timestep_interval>4</min_timestep_interval>{more}</Regridder><Euler>"
            f"<Refinement_Criteria_Thresholds>{jumps}</Refinement_Criteria_Thresholds></Euler>")


def levels_like(grid):
    """Returns the <Level>s that reproduce an output's grid: for each level the boxes at least as fine."""
    text = ""
    for level in range(1, grid.levels):
        spacing = list(map(float, grid.level(level).spacing))
        boxes = ""
        for row in grid.boxes[grid.boxes[:, 0] >= level]:
            width = grid.level(int(row[0])).spacing
            corners = [grid.lower + width * ends for ends in (row[1:4], row[4:])]
            lower, upper = ("[" + ",".join(map(repr, map(float, corner))) + "]" for corner in corners)
            boxes += f"<Box><lower>{lower}</lower><upper>{upper}</upper></Box>"
        text += f"<Level>{boxes}<spacing>[{spacing[0]!r},{spacing[1]!r},1]</spacing></Level>"
    return text


class Levels(FolderTest):
    maxDiff = None

    def ran(self, text, *sets):
        """Runs a scene given as text; returns its archive and its report."""
        here = self.folder()
        scene = here.path / "levels.ups"
        scene.write_text(text)
        report = self.well(here.run(scene, *sets))
        return Archive(str(here.uda)), report

    def test_the_grids_of_the_tests_change(self):
        for scene, (sets, count) in SCENES.items():
            report = run(scene, *sets, steps(count)).report
            self.assertEqual(report["regrids"] > 1, scene != "ups/heat/levels.ups", scene)
            self.assertGreater(sum(cells > 0 for cells in report["levels"]), 1, scene)

    def test_the_same_bits_on_any_patches_and_threads(self):
        for scene, (sets, count) in SCENES.items():
            found = set()
            for threads, layout in enumerate(("1x1x1", "2x1x1", "2x3x1", "8x8x8"), 1):
                options = ("--quiet", "-layout", layout, "-nthreads", str(min(threads, 3)))
                report = run(scene, *sets, steps(count), options=options).report
                found.add((bits_of(report), report["steps"], report["regrids"], str(report["levels"])))
            self.assertEqual(len(found), 1, f"{scene}: {found}")

    def test_the_same_bits_and_files_on_any_ranks(self):
        for turn, (scene, (sets, count)) in enumerate(SCENES.items()):
            ends = []
            for ranks, layout in ((1, "2x2x2"), (2 + turn % 2, "1x1x1")):
                here = self.folder(ranks)
                words = [scene, "--output", here.path, "-layout", layout]
                ends.append((self.well(here.finish(words, [*sets, steps(count)])), Archive(str(here.uda))))
            (expected, alone), (report, several) = ends
            for key in ("fingerprint", "steps", "time", "levels", "updates", "regrids", "drift", "errors"):
                self.assertEqual(report[key], expected[key], f"{scene} {key}")
            self.assertEqual([one.step for one in several], [one.step for one in alone])
            for ours, theirs in zip(alone, several):
                for name in ours.variables:
                    np.testing.assert_array_equal(ours[name].values, theirs[name].values, f"{scene} {name}")

    def test_a_run_goes_on_on_other_ranks(self):
        scene, here = "ups/euler/lax_liu_3_levels.ups", self.folder(3)
        self.well(here.run(scene, *PLANE, "DataArchiver/checkpoint/@timestepInterval=10", steps(12)))
        here.ranks = 1
        report = self.well(here.restart(steps(60), step=10))
        self.assertEqual(report["fingerprint"], run(scene, *PLANE, steps(60)).report["fingerprint"])

    def test_a_run_that_is_cut_at_a_regrid_or_between_two_goes_on_to_the_same_bits(self):
        for scene, (sets, count) in SCENES.items():
            expected = run(scene, *sets, steps(count)).report
            here = self.folder()
            every = ("DataArchiver/checkpoint/@timestepInterval=2", "DataArchiver/checkpoint/@cycle=100")
            self.well(here.run(scene, *sets, *every, steps(count // 2 + 6)))
            between = count // 2 // 4 * 4 + 2  # all look at their grids every 4 steps
            for step, layout in ((between + 2, "1x1x1"), (between, "3x2x1"), (between - 2, "2x2x1")):
                report = self.well(here.finish(["-restart", here.uda, "-t", step, "-layout", layout], [steps(count)]))
                for key in ("fingerprint", "steps", "time", "levels", "drift", "errors"):
                    self.assertEqual(report[key], expected[key], f"{scene} {key} from step {step}")

    def test_nothing_is_lost_between_levels(self):
        for scene, (sets, _) in SCENES.items():
            if scene.startswith("ups/euler") and "lax" not in scene:
                drift = run(scene, *sets, steps(2000)).report["drift"]
                for key in ("mass", "energy"):
                    self.assertLessEqual(abs(drift[key]), 1e-13, f"{scene} {key}")
        drift = run("ups/burgers/levels.ups").report["drift"]
        self.assertLessEqual(abs(drift["momentum"]), 1e-13)

    def mirrored(self, axis):
        """Returns the final states of an off-centre blast in a wind and of its mirror image."""
        ends = []
        for sign in (1, -1):
            place, wind = [.125, -.25], [.5, .25]
            place[axis] *= sign
            wind[axis] *= sign
            pressure = f"1 + 10*exp(-((x - {place[0]})^2 + (y - {place[1]})^2)/0.01)"
            text = scene_of(amr=adaptive(), pressure=pressure, velocity=f"[{wind[0]},{wind[1]},0]")
            archive, report = self.ran(text, steps(60))
            self.assertGreater(report["regrids"], 1)
            ends.append(archive[-1])
        return ends

    def test_a_mirrored_scene_has_mirrored_bits(self):
        for axis in (0, 1):
            ours, image = self.mirrored(axis)
            for name in ("c.density", "c.pressure"):
                np.testing.assert_array_equal(np.flip(ours[name].values, 2 - axis), image[name].values)
            signs = np.array([-1 if axis == d else 1 for d in range(3)])
            np.testing.assert_array_equal(np.flip(ours["c.velocity"].values, 2 - axis) * signs,
                                          image["c.velocity"].values)
            self.assertEqual(ours.grid.counts, image.grid.counts)

    def assert_like_static(self, text, described):
        """Asserts that a run ends like one whose <Level>s give its initial grid."""
        archive, report = self.ran(text, steps(40))
        self.assertEqual(report["regrids"], 0)
        grid = archive[0].grid
        self.assertTrue(all(count > 0 for count in grid.counts), grid.counts)
        static, again = self.ran(scene_of(levels=levels_like(grid), amr="</Regridder>", **described), steps(40))
        for key in ("fingerprint", "steps", "time", "levels"):
            self.assertEqual(again[key], report[key], key)

    def test_a_grid_that_is_refined_once_is_that_of_further_levels(self):
        described = {"pressure": "1 + 10*exp(-((x - .25)^2 + (y + .125)^2)/0.01)", "cells": 32}
        self.assert_like_static(scene_of(amr=adaptive("<regrid_once>true</regrid_once>"), **described), described)

    def test_a_grid_that_has_no_reason_to_change_is_that_of_further_levels(self):
        described = {"density": "x*x + y*y &lt; .01 ? 2 : 1", "cells": 32}
        self.assert_like_static(scene_of(amr=adaptive(), **described), described)

    def test_one_level_is_the_grid_without_refinement(self):
        described = {"pressure": "1 + 10*exp(-(x^2 + y^2)/0.01)"}
        text = scene_of(amr="<adaptive>false</adaptive><max_levels>1</max_levels></Regridder>", **described)
        refined = self.ran(text, steps(40))[1]
        plain = self.ran(re.sub("<AMR>.*</AMR>", "", text), steps(40))[1]
        self.assertEqual(refined["fingerprint"], plain["fingerprint"])
        refined = run("ups/euler/sod_levels.ups", REGRIDDER + "max_levels=1", steps(40)).report  # adaptive, by criteria
        plain = run("ups/euler/sod.ups", BASE + "[100,1,1]", steps(40)).report
        self.assertEqual(refined["fingerprint"], plain["fingerprint"])

    def test_levels_everywhere_are_the_uniform_fine_grid(self):
        described = {"pressure": "1 + 10*exp(-((x - .25)^2 + (y + .125)^2)/0.01)"}
        box = "<Box><lower>[-.5,-.5,0]</lower><upper>[.5,.5,1]</upper><resolution>[64,64,1]</resolution></Box>"
        fine = self.ran(scene_of(levels=f"<Level>{box}</Level>", amr="</Regridder>", **described), steps(40))[0]
        plain = self.ran(re.sub("<AMR>.*</AMR>", "", scene_of(**{**described, "cells": 64})), steps(40))[0]
        self.assertEqual(fine[-1].time, plain[-1].time)
        for name in ("c.density", "c.velocity", "c.pressure"):
            np.testing.assert_array_equal(fine[-1][name].values, plain[-1][name].values)

    def test_a_uniform_grid_would_take_the_steps_of_its_cells(self):
        """Nothing moves, so no cell is refined: steps are those of cells four times as wide."""
        _, report = self.ran(scene_of(amr=adaptive()), steps(3))
        self.assertEqual(report["levels"], [16 ** 2, 0, 0])
        self.assertEqual(report["uniform_updates"], 4 * 3 * 64 ** 2)

    def test_sods_tube_has_the_error_of_eight_times_as_many_cells_for_less(self):
        report = run("ups/euler/sod_levels.ups").report
        fine = run("ups/euler/sod.ups", BASE + "[800,1,1]").report
        error, limit = (one["errors"]["density"]["cell"]["L1"] for one in (report, fine))
        self.assertLessEqual(error, .00066)
        self.assertLessEqual(error, 1.02 * limit)
        self.assertLessEqual(report["updates"], .45 * 800 * fine["steps"])

    def test_heat_is_as_good_as_its_coarse_cells_or_better_and_of_second_order(self):
        errors = []
        for cells in (64, 128, 256):
            sets = [f"Grid/Level[{level}]/Box/resolution=[{cells},1,1]" for level in (1, 2)]
            report = run("ups/heat/levels.ups", *sets, "Time/maxTime=.02").report
            coarse = run("ups/heat/sine.ups", BASE + f"[{cells},1,1]", "Time/maxTime=.02").report
            errors.append(report["errors"]["temperature"]["cell"]["L1"])
            self.assertLessEqual(errors[-1], coarse["errors"]["temperature"]["cell"]["L1"])
        self.assertGreaterEqual(np.log2(errors[1] / errors[2]), 1.9)

    def test_heat_marks_the_cells_of_a_spot_itself(self):
        """Two fifths of the updates that the finest grid would need everywhere give the same error."""
        report = run("ups/heat/spot_levels.ups").report
        text = re.sub("<AMR>.*</AMR>", "", (ROOT / "ups/heat/spot_levels.ups").read_text(), flags=re.S)
        fine = self.ran(text, BASE + "[128,128,1]")[1]
        error, limit = (one["errors"]["temperature"]["cell"]["L1"] for one in (report, fine))
        self.assertLessEqual(error, 1.05 * limit)
        self.assertLessEqual(report["updates"], .45 * 128 * 128 * fine["steps"])
        refused = run("ups/heat/spot_levels.ups", "Heat/refinement_tolerance=0")
        self.assertIn("<adaptive> true needs a <Variable>", refused.err)

    def test_a_stream_that_interpolation_would_leave_without_pressure_goes_on(self):
        """Expanding cold gas, refined where it is thin: in new cells, the separately interpolated energy would be less
        than the kinetic energy."""
        thin = '<Variable name="c.density" value=".9" type="below"/>'
        amr = (f"<max_levels>2</max_levels><min_timestep_interval>4</min_timestep_interval></Regridder><Euler>"
               f"<Refinement_Criteria_Thresholds>{thin}</Refinement_Criteria_Thresholds></Euler>")
        open_sides = re.sub('<Face side="[xy].*?</Face>', "", SIDE_WALLS)
        text = scene_of(amr=amr, velocity="[100*x,100*y,0]", pressure=".1", sides=open_sides)
        found = set()
        for options in ((), ("-layout", "1x1x1", "-nthreads", "2"), ("-layout", "3x2x1")):
            here = self.folder(2 if "3x2x1" in options else 1)
            scene = here.path / "stream.ups"
            scene.write_text(text)
            report = self.well(here.finish([scene, "--output", here.path, *options], [steps(30)]))
            self.assertEqual((report["levels"], report["regrids"]), ([0, 1024], 1))
            found.add(report["fingerprint"])
        self.assertEqual(len(found), 1)

    def test_a_wave_of_cold_gas_that_runs_into_a_wall_goes_on_beside_coarser_cells(self):
        """With ghosts of density, momentum and energy each by itself, refluxing left a coarse cell without pressure."""
        wave = ("Euler/geom_object/density=1+0.1*sin(2*pi*x)", REGRIDDER + "max_levels=2")
        done = run("ups/euler/noh_levels.ups", *wave)
        self.assertEqual(done.code, 0, done.err)
        for key in ("mass", "energy"):
            self.assertLessEqual(abs(done.report["drift"][key]), 1e-13, key)

    def test_a_vortex_that_is_carried_through_a_periodic_box_is_as_good_as_on_fine_cells(self):
        sets = (BASE + "[32,32,1]", REGRIDDER + "max_levels=2", "Time/maxTime=2")
        levels = run("ups/euler/vortex_levels.ups", *sets).report
        fine = run("ups/euler/vortex.ups", BASE + "[64,64,1]", "Time/maxTime=2").report
        error, limit = (one["errors"]["density"]["cell"]["L1"] for one in (levels, fine))
        self.assertLessEqual(error, 1.05 * limit)
        leaky = run("ups/euler/vortex_levels.ups", *sets, "AMR/Euler/do_Refluxing=false").report
        for key in ("mass", "energy"):
            self.assertLessEqual(abs(levels["drift"][key]), 1e-13)
            self.assertGreater(abs(leaky["drift"][key]), 1e-9)


if __name__ == "__main__":
    unittest.main()
