#!/usr/bin/env python3
"""The conserving gas method: errors for Sod's tube, conserved quantities, and bitwise equal results on any patches."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import archive_of, columns

SUS = os.environ.get("SUS", "build/dev/sus")
# L1 of the density of cells that a prototype of the method reached with these constants (h, L1), rounded up.
EXPECTED = {100: 0.0043, 200: 0.00215, 400: 0.00103, 800: 0.0005}


def report(*sets):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "report.json")
        command = [SUS, "ups/mpm/sod_conserving.ups", "--quiet", "--output", folder, "--json", path]
        for override in ("DataArchiver/outputInterval=0", *sets):
            command += ["--set", override]
        subprocess.run(command, check=True)
        return json.loads(path.read_text())


class Conserving(unittest.TestCase):
    def test_sod_errors_are_those_of_the_prototype_or_less(self):
        for cells, most in EXPECTED.items():
            run = report(f"Grid/Level/Box/resolution=[{cells},1,1]")
            self.assertLessEqual(run["errors"]["density"]["cell"]["L1"], most)
            self.assertLessEqual(abs(run["drift"]["mass"]), 1e-12)
            self.assertLessEqual(abs(run["drift"]["energy"]), 1e-12)
            self.assertAlmostEqual(run["drift"]["momentum"], 0.18, delta=1e-12)  # (p_L - p_R) T, through the walls

    def test_patches_do_not_change_a_bit_even_where_particles_are_halved_across_them(self):
        for longest in ("1.2", "2.5"):
            halving = f"MPM/conserving_gas_dynamics/longest_particle={longest}"
            prints = {report(f"Grid/Level/Box/patches=[{patches},1,1]", halving)["fingerprint"]
                      for patches in (1, 2, 3, 7, 64)}
            self.assertEqual(len(prints), 1)

    def test_a_bubble_of_air_that_water_carries_makes_no_waves(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of("ups/stability/air_bubble.ups", folder)
            for gas in ("water", "air"):
                found = columns(archive, "p.pressure", "p.velocity", material=gas)
                # round-off of p is that of gamma p_inf = 2.6e9 Pa, in 112 steps
                for column, value, most in (("p.pressure [Pa]", 1e5, 0.1), ("p.velocity.x [m/s]", 100, 1e-7),
                                            ("p.velocity.y [m/s]", 60, 1e-7)):
                    self.assertLess(max(abs(one - value) for one in found[column]), most)


if __name__ == "__main__":
    unittest.main()
