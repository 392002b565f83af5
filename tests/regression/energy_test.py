#!/usr/bin/env python3
"""The energy budget of solids: gains and losses, the residual, and bitwise equal results on any layout."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import globals_of
from sus import run
from uda import Folder

BUDGET = "DataAnalysis/Module/@name=energyBudget"
BAR, CYLINDER, BILLET, DISCS = (f"ups/solid/{name}.ups" for name in ("bar_vibration", "thick_cylinder", "billet",
                                                                     "two_discs"))
NAMES = {"start": "kinetic energy at the start", "loads": "work of loads and gravity", "contact": "work of contact",
         "faces": "work of faces of the grid", "kinetic": "kinetic energy", "strain": "strain",
         "plastic": "plastic flow",
         "lost": "viscosity and damping"}
# Its right end goes inwards with 1 cm/s, and all between with it.
DRIVEN = ("Grid/BoundaryConditions/Face[2]/BCType/value=[-0.01,0,0]", "Time/maxTime=.05",
          "MaterialProperties/MPM/material/geom_object/velocity=[-0.01*x,0,0]")


class EnergyBudget(unittest.TestCase):
    def amounts_of(self, scene, *sets, present):
        """Returns the energies of a run by short names, and the residual; all that are not `present` must be 0."""
        energies = run(scene, BUDGET, *sets).report["energies"]
        found = energies["came"] | energies["went"]
        self.assertEqual(set(found), set(NAMES.values()))
        amounts = {short: found[name] for short, name in NAMES.items()}
        self.assertEqual({name for name, amount in amounts.items() if amount != 0}, set(present), amounts)
        return amounts, energies["unaccounted"]

    def assert_halves_with_the_time_step(self, sets, present):
        left = [self.amounts_of(BAR, *sets, f"Time/timestep_multiplier={factor}", present=present)[1]
                for factor in (.2, .1)]
        self.assertAlmostEqual(left[0] / left[1], 2, delta=.2)

    def test_a_free_bar_keeps_its_energy_to_first_order_in_the_time_step(self):
        present = ("start", "kinetic", "strain")
        amounts, left = self.amounts_of(BAR, present=present)
        self.assertLess(abs(left), 1e-3 * amounts["start"])  # 2546 steps of a fifth of what is stable
        self.assert_halves_with_the_time_step((), present)

    def test_a_wall_that_presses_a_bar_does_the_work_that_the_bar_stores(self):
        present = ("start", "faces", "kinetic", "strain")
        amounts, left = self.amounts_of(BAR, *DRIVEN, present=present)
        # (K + 4 G / 3) strain^2 / 2 of .01 m^3, strained by 5e-4; hypo_elastic and linear differ by the strain.
        self.assertAlmostEqual(amounts["faces"] / 1.25e-5, 1, delta=3e-3)
        self.assertAlmostEqual(amounts["strain"] / 1.25e-5, 1, delta=3e-3)
        self.assertLess(abs(left), 2e-3 * amounts["faces"])
        self.assert_halves_with_the_time_step(DRIVEN, present)

    def test_a_pressure_does_the_work_that_a_cylinder_stores(self):
        amounts, left = self.amounts_of(CYLINDER, present=("loads", "kinetic", "strain"))
        self.assertLess(abs(left), 1e-4 * amounts["loads"])
        worked = globals_of(CYLINDER, "StrainWork", sets=("DataArchiver/save[1]/@label=StrainWork",
                                                          ))["StrainWork"][-1][1]
        # Strain energy by W(F), the work of the stresses step by step: they differ by less than the strain, squared.
        self.assertAlmostEqual(worked / amounts["strain"], 1, delta=1e-6)

    def test_discs_that_collide_store_what_they_lose(self):
        amounts, left = self.amounts_of(DISCS, present=("start", "contact", "kinetic", "strain"))
        self.assertLess(abs(amounts["contact"]), 1e-12 * amounts["start"])  # what one body gives the other takes
        self.assertLess(abs(left), .01 * amounts["start"])

    def test_a_die_does_the_work_that_flow_and_strain_take(self):
        amounts, left = self.amounts_of(BILLET, present=("start", "contact", "kinetic", "strain", "plastic", "lost"))
        self.assertGreater(amounts["plastic"], .8 * amounts["contact"])
        self.assertGreater(amounts["lost"], 0)
        self.assertLess(abs(left), 5e-3 * amounts["contact"])

    def test_is_the_same_to_the_last_bit_on_any_patches_and_after_a_restart(self):
        steps = "Time/max_Timesteps=40"
        reports = [run(BILLET, BUDGET, steps, f"Grid/Level/Box/patches={layout}",
                       options=("--quiet", "-nthreads", threads)).report
                   for layout, threads in (("[1,1,1]", "1"), ("[3,2,1]", "2"))]
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(BILLET, BUDGET, "DataArchiver/checkpoint/@timestepInterval=13", steps)
        code, errors, report = folder.restart(steps, step=int(folder.checkpoints[0].name[1:]))
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(reports[0]["energies"], reports[1]["energies"])
        self.assertEqual(reports[0]["energies"], report["energies"])

    def test_does_not_change_a_bit_of_the_run(self):
        steps = "Time/max_Timesteps=20"
        self.assertEqual(run(BILLET, BUDGET, steps).report["fingerprint"], run(BILLET, steps).report["fingerprint"])

    def test_is_kept_once(self):
        result = run(BILLET, BUDGET, BUDGET.replace("/@name", "[2]/@name"), outputs=True)
        self.assertEqual(result.code, 3)
        self.assertIn("a module above already has the energy budget; keep one", result.err)

    def test_what_is_summed_can_be_saved(self):
        sets = ("Time/max_Timesteps=50", "DataArchiver/save[1]/@label=ContactWork",
                "DataArchiver/save[2]/@label=PlasticWork")
        works = globals_of(BILLET, "ContactWork", "PlasticWork", sets=sets)
        self.assertEqual(works["ContactWork"][0], [0, 0])
        energies = run(BILLET, BUDGET, "Time/max_Timesteps=50").report["energies"]
        self.assertAlmostEqual(works["ContactWork"][-1][1] / energies["came"]["work of contact"], 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
