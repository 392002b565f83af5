#!/usr/bin/env python3
"""Solids against what Uintah of July 2026 computes for the same bodies, and the same bits on any patches."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import globals_of
from sus import run

DISCS = "ups/solid/two_discs.ups"


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

    def test_the_same_bits_on_any_patches(self):
        prints = {run(DISCS, f"Grid/Level/Box/patches={layout}", "Time/max_Timesteps=60").report["fingerprint"]
                  for layout in ("[1,1,1]", "[2,2,1]", "[3,1,2]", "[7,5,1]")}
        self.assertEqual(len(prints), 1)


if __name__ == "__main__":
    unittest.main()
