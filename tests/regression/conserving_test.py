#!/usr/bin/env python3
"""The conserving gas method: its errors on Sod's tube, what it conserves, and the same bits on any patches."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

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


if __name__ == "__main__":
    unittest.main()
