#!/usr/bin/env python3
"""Global solves on grids of several levels: the order of the error, what conserves, how many iterations it takes, the
same on any patches and, but for rounding, ranks; restarts; grids that change."""
import pathlib
import re
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[up] / part) for up, part in
                ((1, "support"), (2, "tools/python"))]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import numpy as np

from sus import ROOT, run
from tushar.archive import Archive
from uda import FolderTest

POISSON, HEAT = "ups/poisson/levels.ups", "ups/heat/implicit_levels.ups"
ONE_SOLVE = ("Time/delt_init=1", "Time/delt_max=1")
BOX = "Grid/Level[{}]/Box/"
# The third Level of POISSON, and so the finest cells, everywhere.
EVERYWHERE = tuple(BOX.format(3) + end for end in ("lower=[0,0,0]", "upper=[1,1,1]", "resolution=[128,128,1]"))
FURTHER = re.compile(r'    <Level>\n      <Box label="(around|peak|spot)">.*?</Level>\n', re.DOTALL)
AMR = re.compile(r"  <AMR>.*?</AMR>\n", re.DOTALL)


def finer(scene, times):
    """Refines the cells of all levels by `times`; for HEAT the time steps shrink by the same factor."""
    counts = {POISSON: ((32, 32), (32, 40), (32, 32)), HEAT: ((32, 32),) * 3}[scene]
    sets = [BOX.format(level) + f"resolution=[{x * times},{y * times},1]" for level, (x, y) in enumerate(counts, 1)]
    if scene == POISSON:
        return (*sets, *ONE_SOLVE)
    return (*sets, f"Time/delt_init={.0005 / times}", f"Time/delt_max={.0005 / times}")


def without_levels(scene):
    """Returns the text of a scene with only the coarsest Level and without <AMR>."""
    return AMR.sub("", FURTHER.sub("", (ROOT / scene).read_text()))


def adaptive(scene, section, criterion):
    regridder = ('<Regridder type="Tiled"><adaptive>true</adaptive><max_levels>3</max_levels><min_patch_size>[[4,4,1]]'
                 "</min_patch_size><min_timestep_interval>2</min_timestep_interval></Regridder>")
    thresholds = f"<Refinement_Criteria_Thresholds>{criterion}</Refinement_Criteria_Thresholds>"
    return without_levels(scene).replace("  <DataArchiver>", f"  <AMR>{regridder}<{section}>{thresholds}</{section}>"
                                                             "</AMR>\n  <DataArchiver>")


# A hot spot that spreads until the finest cells are not wanted any more.
FADING = adaptive(HEAT, "Heat", '<Variable name="c.temperature" type="gradient" value="3"/>')


class SolvesOnLevels(FolderTest):
    def written(self, text, name="solve.ups"):
        """Writes the text of a scene into a file."""
        path = self.folder().path / name
        path.write_text(text)
        return path

    def greatest_error(self, scene, times):
        errors = run(scene, *finer(scene, times)).report["errors"]
        return next(iter(errors.values()))["cell"]["max"]

    def iterations(self, scene, *sets):
        """Returns the number of iterations of the last solve."""
        here = self.folder()
        self.well(here.run(scene, *sets))
        return int((here.uda / "KrylovIterations.dat").read_text().split()[-1])

    def test_the_greatest_error_is_of_second_order(self):
        for scene in (POISSON, HEAT):
            coarse, fine = (self.greatest_error(scene, times) for times in (1, 2))
            self.assertGreaterEqual(np.log2(coarse / fine), 1.9, scene)

    def test_the_greatest_error_is_that_of_the_finest_cells_everywhere(self):
        levels, uniform = (run(POISSON, *sets, *ONE_SOLVE).report for sets in ((), EVERYWHERE))
        self.assertEqual(uniform["levels"], [0, 0, 128 * 128])
        self.assertLess(sum(levels["levels"]), .2 * 128 * 128)
        error, limit = (report["errors"]["phi"]["cell"]["max"] for report in (levels, uniform))
        self.assertLessEqual(error, 1.02 * limit)

    def test_a_solve_takes_at_most_half_as_many_iterations_more_than_on_a_uniform_grid(self):
        uniform = self.written(without_levels(POISSON))
        for preconditioner in ("gamg", "hypre"):
            with_it = f"Poisson/Solver/preconditioner={preconditioner}"
            limit = self.iterations(uniform, "Grid/Level/Box/resolution=[128,128,1]", "Poisson/Solver/solver=cg",
                                    with_it, *ONE_SOLVE)
            for times in (1, 2):
                self.assertLessEqual(self.iterations(POISSON, with_it, *finer(POISSON, times)), 1.5 * limit)

    def test_the_finest_cells_everywhere_are_a_uniform_grid(self):
        fields = []
        for scene, sets in ((POISSON, EVERYWHERE),
                            (self.written(without_levels(POISSON)), ["Grid/Level/Box/resolution=[128,128,1]"])):
            here = self.folder()
            self.well(here.run(scene, *sets, *ONE_SOLVE, "Poisson/Solver/tolerance=1e-13"))
            fields.append(Archive(str(here.uda))[-1]["c.phi"].values)
        np.testing.assert_allclose(*fields, rtol=0, atol=1e-10)

    def test_one_level_is_the_grid_without_refinement(self):
        amr = "  <AMR><Regridder><adaptive>false</adaptive><max_levels>1</max_levels></Regridder></AMR>\n"
        for scene in (POISSON, HEAT):
            plain = without_levels(scene)
            one = plain.replace("  <DataArchiver>", amr + "  <DataArchiver>")
            self.assertNotEqual(one, plain)
            prints = {run(self.written(text), "Time/max_Timesteps=2").report["fingerprint"] for text in (plain, one)}
            self.assertEqual(len(prints), 1, scene)

    def test_the_same_bits_on_any_patches_and_threads(self):
        for scene, count in ((POISSON, 2), (HEAT, 4), (self.written(FADING), 24)):
            found = set()
            for threads, layout in enumerate(("1x1x1", "2x3x1", "8x8x8"), 1):
                options = ("--quiet", "-layout", layout, "-nthreads", str(threads))
                sets = ("Time/maxTime=1", f"Time/max_Timesteps={count}")
                report = run(scene, *sets, options=options).report
                found.add((report["fingerprint"], report["regrids"], str(report["levels"])))
            self.assertEqual(len(found), 1, f"{scene}: {found}")

    def test_the_same_fields_on_any_ranks(self):
        for scene, label, section in ((POISSON, "c.phi", "Poisson"), (HEAT, "c.temperature", "Heat")):
            fields = []
            for ranks in (1, 2, 3):
                here = self.folder(ranks)
                report = self.well(here.run(scene, f"{section}/Solver/tolerance=1e-13", "Time/max_Timesteps=2"))
                self.assertEqual(report["layout"]["ranks"], ranks)
                fields.append(Archive(str(here.uda))[-1][label].values)
            for field in fields[1:]:
                np.testing.assert_allclose(field, fields[0], rtol=0, atol=1e-10, err_msg=scene)

    def test_heat_stays_in_an_insulated_box(self):
        # The systems are solved to 1e-12.
        for scene, regrids in ((HEAT, False), (self.written(FADING), True)):
            for integrator in ("backward_euler", "crank_nicolson"):
                report = run(scene, f"Heat/time_integrator={integrator}", "Time/maxTime=.012").report
                self.assertEqual(report["regrids"] > 0, regrids)
                self.assertLessEqual(abs(report["drift"]["energy"]), 1e-11, f"{scene} {integrator}")

    def test_a_run_that_is_cut_goes_on_to_the_same_bits(self):
        every = ("DataArchiver/checkpoint/@timestepInterval=3", "DataArchiver/checkpoint/@cycle=100")
        for scene, steps in ((HEAT, 8), (self.written(FADING), 24)):
            sets = ("Time/maxTime=1", f"Time/max_Timesteps={steps}")
            expected = run(scene, *sets).report
            here = self.folder()
            self.well(here.run(scene, *every, "Time/maxTime=1", "Time/max_Timesteps=7"))
            for step, layout in ((6, [1, 1, 1]), (3, [2, 3, 1])):
                words = ["-restart", here.uda, "-t", step, "-layout", "x".join(map(str, layout))]
                report = self.well(here.finish(words, sets))
                for key in ("fingerprint", "steps", "time", "levels", "drift", "errors"):
                    self.assertEqual(report[key], expected[key], f"{scene} {key} from step {step}")

    def test_poissons_equation_follows_its_solution(self):
        criterion = '<Variable name="c.phi" type="gradient" value=".5"/>'
        scene = self.written(adaptive(POISSON, "Poisson", criterion))
        report = run(scene, "Time/delt_init=.1", "Time/delt_max=.1").report
        self.assertGreater(report["regrids"], 0)
        self.assertGreater(report["levels"][2], 0)
        uniform = run(self.written(without_levels(POISSON)), "Grid/Level/Box/resolution=[128,128,1]", *ONE_SOLVE).report
        error, limit = (one["errors"]["phi"]["cell"]["max"] for one in (report, uniform))
        self.assertLessEqual(error, 1.5 * limit)


if __name__ == "__main__":
    unittest.main()
