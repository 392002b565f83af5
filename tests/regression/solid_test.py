#!/usr/bin/env python3
"""Solids compared with results of Uintah of July 2026 for the same bodies; bitwise equal results on any patches."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import globals_of, last_state
from sus import bits_of, run
from uda import Folder

DISCS = "ups/solid/two_discs.ups"
RIEMANN = "ups/solid/riemann.ups"
SPALL = "ups/solid/spall.ups"
TAYLOR = "ups/solid/taylor_bar.ups"


def fields_of(scene, *names, until):
    """Returns the values at a time by column."""
    return last_state(scene, *names, sets=(f"Time/maxTime={until}", "DataArchiver/outputInterval=1",
                                           "DataArchiver/outputLastTimestep=true"))


class Solids(unittest.TestCase):
    def test_two_discs_collide_as_in_uintah(self):
        values = globals_of(DISCS, "KineticEnergy", "StrainEnergy", "TotalMass", "TotalMomentum")
        for name, time, expected in (("KineticEnergy", .101154, 40.7589), ("StrainEnergy", .101154, 5.11508),
                                     ("KineticEnergy", .200116, 33.2219), ("StrainEnergy", .200116, 18.9784)):
            nearest = min(values[name], key=lambda line: abs(line[0] - time))
            self.assertAlmostEqual(nearest[0], time, delta=1e-6)
            self.assertAlmostEqual(nearest[1], expected, delta=1e-3, msg=f"{name} at {time}")
        self.assertAlmostEqual(values["TotalMass"][-1][1], 13, delta=1e-9)
        self.assertLess(max(abs(p) for p in values["TotalMomentum"][-1][1:]), 1e-6)

    def test_a_shock_runs_through_an_ideal_gas_as_in_uintah(self):
        values = globals_of(RIEMANN, "KineticEnergy", "TotalMomentum", "TotalMass", until=".0002535")
        for name, expected in (("KineticEnergy", .0693037), ("TotalMomentum", .000574665),
                               ("TotalMass", 1.618140244e-05)):
            time, value = min(values[name], key=lambda line: abs(line[0] - .000253067))[:2]
            self.assertAlmostEqual(time, .000253067, delta=1e-9)
            self.assertAlmostEqual(value / expected, 1, delta=1e-5, msg=name)  # the digits that are given

    def test_plates_spall_where_the_waves_of_their_free_faces_meet(self):
        fields = fields_of(SPALL, "p.x", "p.displacement", "p.localizedMPM", until="1.6e-6")
        failed = [x - u for x, u, localized in zip(fields["x [m]"], fields["p.displacement.x [m]"],
                                                   fields["p.localizedMPM [1]"]) if localized == 1]
        self.assertGreater(min(failed), .0030)  # 2 mm from the back is at 4 mm; 1 mm for the width of the waves
        self.assertLess(max(failed), .0050)

    def test_a_shock_has_the_pressure_of_its_relation(self):
        fields = fields_of(SPALL, "p.x", "p.stress", until="0.6e-6")
        between = [stress for x, stress in zip(fields["x [m]"], fields["p.stress.xx [Pa]"]) if .0012 < x < .004]
        expected = 8930 * (3940 + 1.489 * 150) * 150
        self.assertAlmostEqual(-sum(between) / len(between) / expected, 1,
                               delta=.01)  # the strength is a fiftieth of it

    def test_yielding_and_failing_bodies_give_the_same_bits_on_any_patches_and_after_a_restart(self):
        for scene, layouts, steps in ((TAYLOR, ("[1,1,1]", "[3,4,1]"), 40), (SPALL, ("[1,1,1]", "[7,1,1]"), 190),
                                      (RIEMANN, ("[1,1,1]", "[6,1,1]"), 30)):
            steps = f"Time/max_Timesteps={steps}"
            prints = {bits_of(run(scene, f"Grid/Level/Box/patches={layout}", steps).report) for layout in layouts}
            folder = Folder()
            self.addCleanup(folder.cleanup)
            folder.run(scene, "DataArchiver/checkpoint/@timestepInterval=13", steps)
            code, errors, report = folder.restart(steps, step=int(folder.checkpoints[0].name[1:]))
            self.assertEqual((code, errors), (0, ""))
            self.assertEqual(len(prints | {bits_of(report)}), 1, scene)

    def test_the_same_bits_on_any_patches(self):
        prints = {bits_of(run(DISCS, f"Grid/Level/Box/patches={layout}", "Time/max_Timesteps=60").report)
                  for layout in ("[1,1,1]", "[2,2,1]", "[3,1,2]", "[7,5,1]")}
        self.assertEqual(len(prints), 1)


if __name__ == "__main__":
    unittest.main()
