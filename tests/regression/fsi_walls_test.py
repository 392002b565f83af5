#!/usr/bin/env python3
"""The gallery of hard cases for walls of bodies in a gas: each ends, conserves, and lets nothing through."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from wall_gallery import CASES, Case


class Walls(unittest.TestCase):
    def test_gallery(self):
        for name in CASES:
            with self.subTest(name):
                case = Case(name)
                self.assertEqual(case.code, 0, case.err)
                self.assertLess(case.drift("GasMass"), 1e-13)
                self.assertLess(case.drift("GasEnergy", "GasWorkOnBodies"), 1e-12)
                self.assertGreaterEqual(case.least("LeastGasMass"), 0)
                self.assertGreaterEqual(case.least("LeastGasHeat"), 0)
                if case.leak is not None:
                    self.assertLessEqual(case.leak, case.most_leak)


if __name__ == "__main__":
    unittest.main()
