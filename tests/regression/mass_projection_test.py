#!/usr/bin/env python3
"""The error of the mass projection: below its bound for any particles at any time; computed only on request."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, run

SCENE = "ups/mpm/mass_projection.ups"
PLACED = "MaterialProperties/MPM/material/geom_object/placement="
MODULE = "DataAnalysis/Module[2]/@name=massProjection"
AT_THE_START = "Time/maxTime=1e-9"


def measured(result):
    """Returns the maximum of |E| relative to its bound, and per cell volume [kg/m^3]."""
    errors = result.report["errors"]
    return errors["mass_projection_over_bound"]["node"]["max"], errors["mass_projection"]["node"]["max"]


class MassProjection(unittest.TestCase):
    def test_ratios_are_near_those_of_a_prototype(self):
        for sets, expected in (((AT_THE_START,), 0), ((AT_THE_START, PLACED + "jittered"), .61),
                               ((AT_THE_START, PLACED + "random"), .89), ((), .56)):
            ratio, _ = measured(run(SCENE, *sets))
            self.assertLess(ratio, 1)
            self.assertAlmostEqual(ratio, expected, delta=.11)  # of other draws and other constants

    def test_the_bound_holds_on_a_shock_tube_with_few_and_many_particles(self):
        for scene in ("ups/mpm/sod.ups", "ups/mpm/sod_redistribute.ups"):
            ratio, error = measured(run(scene, MODULE))
            self.assertTrue(.3 < ratio < 1 and error > .05)

    def test_the_error_does_not_vanish_with_the_cells(self):
        errors = [measured(run(SCENE, f"Grid/Level/Box/resolution=[{cells},1,1]"))[1] for cells in (100, 400)]
        self.assertGreater(errors[1], .5 * errors[0])

    def test_measuring_changes_no_bit_and_patches_none_of_what_is_measured(self):
        plain = run("ups/mpm/sod.ups")
        self.assertFalse(any("MassProjection" in task for task in plain.report["tasks"]["kept"]))
        values = set()
        for patches in (1, 7, 64):
            result = run("ups/mpm/sod.ups", MODULE, f"Grid/Level/Box/patches=[{patches},1,1]")
            self.assertEqual(result.report["fingerprint"], plain.report["fingerprint"])
            values.add(measured(result))
        self.assertEqual(len(values), 1)


if __name__ == "__main__":
    unittest.main()
