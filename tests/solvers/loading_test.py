#!/usr/bin/env python3
"""PETSc is loaded for scenes with a solve that is left to it, and only for these."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, run


def libraries(scene, *options):
    """Returns the libraries that the dynamic linker loads during a run, from the linker's own log."""
    with tempfile.TemporaryDirectory() as folder:
        log = pathlib.Path(folder) / "linker"
        environment = dict(os.environ, LD_DEBUG="files", LD_DEBUG_OUTPUT=str(log))
        subprocess.run([SUS, ROOT / scene, "--quiet", "--output", folder, *options], env=environment, check=True)
        return "".join(file.read_text() for file in pathlib.Path(folder).glob("linker.*"))


class Loading(unittest.TestCase):
    def test_a_scene_without_a_solve_loads_no_petsc(self):
        for scene in ("ups/heat/sine.ups", "ups/mpm/sod.ups", "ups/euler/sod.ups"):
            found = libraries(scene, "--set", "Time/max_Timesteps=2")
            self.assertIn("libc.so", found)
            self.assertFalse("libpetsc" in found, f"{scene} loads PETSc")

    def test_a_scene_with_a_solve_on_levels_does(self):
        self.assertIn("libpetsc", libraries("ups/poisson/levels.ups"))

    def test_cells_of_one_level_on_one_rank_need_none_unless_there_are_options_for_it(self):
        self.assertNotIn("libpetsc", libraries("ups/poisson/sine.ups"))
        self.assertIn("libpetsc", libraries("ups/poisson/sine.ups", "-petsc", "-ksp_max_it 1000"))

    def test_a_small_solve_on_one_rank_loads_none_unless_there_are_options_for_it(self):
        self.assertNotIn("libpetsc", libraries("ups/solid/implicit_cantilever.ups"))
        self.assertIn("libpetsc", libraries("ups/solid/implicit_cantilever.ups", "-petsc", "-snes_rtol 1e-30"))

    def test_options_on_the_command_line_reach_petsc(self):
        result = run("ups/poisson/sine.ups", options=("--quiet", "-petsc", "-ksp_max_it 1"))
        self.assertEqual(result.code, 4)
        self.assertRegex(result.err, r"Poisson's equation did not converge: more iterations than allowed "
                                     r"\(DIVERGED_ITS\), after 1 iteration; residuals \S+, \S+; the largest residual "
                                     r"is in the cell at \(")

    def test_options_that_no_solve_looks_at_are_named_at_the_end(self):
        result = run("ups/poisson/sine.ups", "Poisson/Solver/petsc=-ksp_mxa_it 5",
                     options=("--quiet", "-petsc", "-ksp_rtol 1e-5 -ksp_monitr -log_view :/dev/null"))
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.report["unused_petsc_options"], ["-ksp_monitr", "-ksp_mxa_it"])
        self.assertIn("note: PETSc: no solve has used the option -ksp_monitr [T702]\n", result.err)

    def test_options_of_a_run_without_a_solve_are_told_to_be_useless(self):
        result = run("ups/heat/sine.ups", "Time/max_Timesteps=1", options=("--quiet", "-petsc", "-ksp_monitor"))
        said = "note: --petsc: this run has not used PETSc [T702]\n"
        self.assertEqual((result.code, result.err), (0, said))

    def test_options_that_one_solve_of_several_looks_at_are_not_named(self):
        options = ("--quiet", "-petsc", "-snes_rtol 1e-5 -ksp_gmres_modifiedgramschmidt")
        result = run("ups/solid/implicit_cantilever.ups", "MPM/DoImplicitHeatConduction=true",
                     "MPM/Solver/solver=gmres",
                     "MPM/Solver/preconditioner=ilu", "Time/max_Timesteps=1",
                     "MaterialProperties/MPM/material/specific_heat=1", options=options)
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(result.report["unused_petsc_options"], [])

    def test_the_options_of_the_scene_give_way_to_those_of_the_command_line(self):
        result = run("ups/poisson/sine.ups", "Poisson/Solver/petsc=-ksp_max_it 1",
                     options=("--quiet", "-petsc", "-ksp_max_it 1000"))
        self.assertEqual(result.code, 0, result.err)


if __name__ == "__main__":
    unittest.main()
