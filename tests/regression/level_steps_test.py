#!/usr/bin/env python3
"""Smaller steps on finer levels (<useLockStep> false): bitwise equal results on any patches, threads and ranks, after
restarts and repeated steps; nothing is lost; errors are as with one step for all levels, with fewer updates."""
import pathlib
import re
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[up] / part) for up, part in
                ((1, "support"), (2, "tools/python"))]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import numpy as np

from levels_test import BASE, PLANE, REGRIDDER, adaptive, scene_of, steps
from sus import ROOT, run
from tushar.archive import Archive
from uda import FolderTest

OWN = "AMR/useLockStep=false"
EVERY_STEP = REGRIDDER + "min_timestep_interval=4"  # of three levels
# Scene -> what makes it small, and steps of the coarsest level in which its grid changes several times, if it does.
SCENES = {"ups/euler/sod_levels.ups": ((), 12), "ups/euler/lax_liu_3_levels.ups": (PLANE, 20),
          "ups/euler/blast_levels.ups": (PLANE, 24), "ups/heat/levels.ups": ((), 30),
          "ups/euler/noh_levels.ups": ((), 10), "ups/euler/double_mach.ups": ((BASE + "[32,8,1]", EVERY_STEP), 12),
          "ups/heat/spot_levels.ups": (("Heat/refinement_tolerance=.004", REGRIDDER + "min_patch_size=[[4,4,1]]",
                                        EVERY_STEP), 20)}


class LevelSteps(FolderTest):
    maxDiff = None

    def test_finer_levels_take_more_steps(self):
        for scene, (sets, count) in SCENES.items():
            report = run(scene, *sets, OWN, steps(count)).report
            self.assertEqual(report["regrids"] > 1, scene != "ups/heat/levels.ups", scene)
            updates, cells = report["level_updates"], report["levels"]
            self.assertEqual(sum(updates), report["updates"], scene)
            if report["regrids"] == 0:  # cells stay, so that updates are multiples
                self.assertEqual([count * 2 ** k * one for k, one in enumerate(cells)], updates)

    def test_the_same_bits_on_any_patches_and_threads(self):
        for scene, (sets, count) in SCENES.items():
            found = set()
            for threads, layout in enumerate(("1x1x1", "2x1x1", "2x3x1", "8x8x8"), 1):
                options = ("--quiet", "-layout", layout, "-nthreads", str(min(threads, 3)))
                report = run(scene, *sets, OWN, steps(count), options=options).report
                found.add((report["fingerprint"], report["time"], report["regrids"], str(report["level_updates"])))
            self.assertEqual(len(found), 1, f"{scene}: {found}")

    def test_the_same_bits_and_files_on_any_ranks(self):
        for turn, (scene, (sets, count)) in enumerate(SCENES.items()):
            ends = []
            for ranks, layout in ((1, "2x2x2"), (2 + turn % 3, "1x1x1")):
                here = self.folder(ranks)
                words = [scene, "--output", here.path, "-layout", layout]
                ends.append((self.well(here.finish(words, [*sets, OWN, steps(count)])), Archive(str(here.uda))))
            (expected, alone), (report, several) = ends
            for key in ("fingerprint", "steps", "time", "levels", "level_updates", "regrids", "drift", "errors"):
                self.assertEqual(report[key], expected[key], f"{scene} {key}")
            for ours, theirs in zip(alone, several, strict=True):
                for name in ours.variables:
                    np.testing.assert_array_equal(ours[name].values, theirs[name].values, f"{scene} {name}")

    def test_a_run_that_is_cut_goes_on_to_the_same_bits_on_other_ranks(self):
        for turn, (scene, (sets, count)) in enumerate(SCENES.items()):
            expected = run(scene, *sets, OWN, steps(count)).report
            here = self.folder(1 + turn % 2)
            every = ("DataArchiver/checkpoint/@timestepInterval=1", "DataArchiver/checkpoint/@cycle=100")
            self.well(here.run(scene, *sets, OWN, *every, steps(count // 2 + 1)))
            here.ranks = 2 - turn % 2
            for step, layout in ((count // 2, "1x1x1"), (count // 2 - 1, "3x2x1")):
                report = self.well(here.finish(["-restart", here.uda, "-t", step, "-layout", layout], [steps(count)]))
                for key in ("fingerprint", "steps", "time", "levels", "drift", "errors"):
                    self.assertEqual(report[key], expected[key], f"{scene} {key} from step {step}")

    def test_nothing_is_lost_between_levels(self):
        for scene in ("ups/euler/sod_levels.ups", "ups/euler/blast_levels.ups", "ups/euler/noh_levels.ups"):
            drift = run(scene, *SCENES[scene][0], OWN, steps(300)).report["drift"]
            for key in ("mass", "energy"):
                self.assertLessEqual(abs(drift[key]), 1e-13, f"{scene} {key}")
        leaky = run("ups/euler/blast_levels.ups", *PLANE, OWN, "AMR/Euler/do_Refluxing=false", steps(300)).report
        self.assertGreater(abs(leaky["drift"]["mass"]), 1e-11)

    def test_a_mirrored_scene_has_mirrored_bits(self):
        ends = []
        for sign in (1, -1):
            here = self.folder()
            scene = here.path / "levels.ups"
            pressure = f"1 + 10*exp(-((x - {sign * .125})^2 + (y + .25)^2)/0.01)"
            scene.write_text(scene_of(amr=adaptive(), pressure=pressure, velocity=f"[{sign * .5},.25,0]"))
            self.assertGreater(self.well(here.run(scene, OWN, steps(20)))["regrids"], 1)
            ends.append(Archive(str(here.uda))[-1])
        ours, image = ends
        for name in ("c.density", "c.pressure"):
            np.testing.assert_array_equal(np.flip(ours[name].values, 2), image[name].values)

    def test_a_step_that_breaks_a_bound_is_repeated_as_a_whole(self):
        """Steps three times too long lead to a negative pressure in some gas."""
        sets = (*PLANE, OWN, "Time/timestep_multiplier=3", "Time/recompute_timestep=true", steps(20))
        found = set()
        for options in ((), ("-layout", "1x1x1", "-nthreads", "2"), ("-layout", "3x2x1")):
            here = self.folder(2 if "3x2x1" in options else 1)
            report = self.well(here.finish(["ups/euler/blast_levels.ups", "--output", here.path, *options], sets))
            found.add((report["fingerprint"], report["retries"]))
        self.assertEqual(len(found), 1, found)
        self.assertGreater(found.pop()[1], 0)

    def test_after_a_failure_the_last_whole_step_is_saved(self):
        found = set()
        for ranks in (1, 2):
            here = self.folder(ranks)
            sets = [*PLANE, OWN, "Time/timestep_multiplier=3", steps(40)]
            code, err, report = here.finish(["ups/euler/blast_levels.ups", "--output", here.path], sets)
            self.assertEqual(code, 4, err)
            last = report["steps"]
            self.assertIn(f"the last complete step, {last} at", err)
            ended = self.well(here.finish(["-restart", here.uda], [steps(last)]))
            well = run("ups/euler/blast_levels.ups", *sets[:-1], steps(last)).report
            self.assertEqual(ended["fingerprint"], well["fingerprint"])
            found.add((re.search(r"sus: (.*?task euler::advance), ", err).group(1), last))
        self.assertEqual(len(found), 1, found)

    def test_a_step_that_refluxing_breaks_is_undone(self):
        """The fluxes of four levels lead to a negative pressure in a cell of Noh's shock after the steps of all
        levels."""
        scene, sets = "ups/euler/noh_levels.ups", [OWN, REGRIDDER + "max_levels=4"]
        here = self.folder()
        code, err, report = here.finish([scene, "--output", here.path], sets)
        self.assertEqual(code, 4, err)
        self.assertIn("euler::checkRefluxed", err)
        repeats = "Time/recompute_timestep=true"
        ends = [self.well(here.finish(["-restart", here.uda], [repeats]))]
        for options in ((), ("-layout", "3x1x1", "-nthreads", "2")):
            ends.append(run(scene, *sets, repeats, options=("--quiet", *options)).report)
            self.assertGreater(ends[-1]["retries"], 0)
        self.assertEqual(len({end["fingerprint"] for end in ends}), 1, ends)

    def test_nothing_is_lost_in_steps_that_are_repeated(self):
        density = "Euler/geom_object/density=1+0.1*sin(2*pi*x)"
        repeats = ("Time/recompute_timestep=true", REGRIDDER + "max_levels=4")
        report = run("ups/euler/noh_levels.ups", OWN, density, *repeats).report
        self.assertGreater(report["retries"], 0)
        for key in ("mass", "energy"):
            self.assertLessEqual(abs(report["drift"][key]), 1e-13, key)

    def test_sods_tube_has_the_error_of_one_step_for_all_levels(self):
        """Both runs check their grids every 8 steps of the finest level."""
        own = run("ups/euler/sod_levels.ups", OWN).report
        same = run("ups/euler/sod_levels.ups", REGRIDDER + "min_timestep_interval=8").report
        error, limit = (one["errors"]["density"]["cell"]["L1"] for one in (own, same))
        self.assertLessEqual(error, limit)
        self.assertLessEqual(error, .00066)
        self.assertLessEqual(own["updates"], .65 * same["updates"])
        self.assertLessEqual(own["updates"], .24 * own["uniform_updates"])

    def test_heat_is_of_second_order(self):
        errors = []
        for cells in (64, 128, 256):
            sets = [f"Grid/Level[{level}]/Box/resolution=[{cells},1,1]" for level in (1, 2)]
            report = run("ups/heat/levels.ups", *sets, OWN, "Time/maxTime=.02").report
            errors.append(report["errors"]["temperature"]["cell"]["L1"])
        self.assertGreaterEqual(np.log2(errors[1] / errors[2]), 1.9)

    def test_lists_that_need_one_step_for_all_levels_are_refused(self):
        """Each error message names the tag and the first task."""
        for scene, task in (("ups/burgers/levels.ups", "burgers::correct reads the new c.predictedU outside a patch"),
                            ("ups/solid/penetration_levels.ups", "reads stableTimeStep, which is computed over"),
                            ("ups/heat/implicit_levels.ups", "needs all patches at once")):
            text = (ROOT / scene).read_text()
            changed = re.sub("</Grid>", "</Grid><AMR/>", text) if "<AMR>" not in text else text
            here = self.folder()
            copy = here.path / pathlib.Path(scene).name
            copy.write_text(changed)
            code, err, _ = here.run(copy, OWN)
            self.assertEqual(code, 3, err)
            self.assertRegex(err, r"AMR/useLockStep: task .*" + re.escape(task))
            self.assertIn("all levels must take the same time step", err)

    def test_one_level_gets_a_note(self):
        done = run("ups/euler/sod_levels.ups", OWN, REGRIDDER + "max_levels=1", REGRIDDER + "adaptive=false", steps(2),
                   options=())
        self.assertIn("AMR/useLockStep: does nothing: the grid has one level", done.out + done.err)

    def test_the_schedule_shows_what_a_coarser_level_takes_after_the_finer_one(self):
        shown = run("ups/euler/sod_levels.ups", OWN, options=("-schedule",)).out
        advance, after = shown.split("after the steps of the next finer level\n")
        self.assertIn("register fluxes of c.density", advance)
        self.assertIn("reflux c.density", after)
        together = run("ups/euler/sod_levels.ups", options=("-schedule",)).out
        self.assertNotIn("register", together)
        self.assertIn("each task runs on the patches of all 4 levels, with the same time step\n", together)
        self.assertIn("particles are on level 3, the finest",
                      run("ups/solid/penetration_levels.ups", options=("-schedule",)).out)


if __name__ == "__main__":
    unittest.main()
