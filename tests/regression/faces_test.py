#!/usr/bin/env python3
"""Particles and cells on the faces of shapes."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, archive_of, columns, globals_of
from sus import ROOT

BARS = (ROOT / "ups/solid/two_material_contact.ups").read_text().replace("[80,1,1]", "[64,1,1]")


class Faces(SceneTest):
    def particles(self, flyer, target):
        """Returns the number of particles of 1/32 m in both bars."""
        text = BARS.replace("[0.2,0,0]</min><max>[1.2", flyer).replace("[1.2,0,0]</min><max>[3.2", target)
        text = text.replace('<save label="TotalMomentum"/>', '<save label="TotalMass"/>')
        lines = globals_of(self.scene(text), "TotalMass", sets=("Time/max_Timesteps=1",))["TotalMass"]
        return round(lines[-1][1] / (1000 * .01 / 32), 9)

    def test_particles_on_both_ends_belong_to_a_bar(self):
        self.assertEqual(self.particles("[0.265625,0,0]</min><max>[0.515625", "[2,0,0]</min><max>[3"), 9 + 32)

    def test_bars_that_share_a_face_both_have_the_particles_on_it(self):
        self.assertEqual(self.particles("[0,0,0]</min><max>[1.015625", "[1.015625,0,0]</min><max>[2"), 33 + 32)

    def test_a_cell_in_the_middle_of_a_shock_tube_has_the_upper_state(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of("ups/euler/sod.ups", folder, "Grid/Level/Box/resolution=[5,1,1]",
                                 "Time/max_Timesteps=1")
            density = columns(archive, "c.density", time=1e-9)["c.density [kg/m^3]"]
        self.assertEqual(list(density), [1, 1, .125, .125, .125])


if __name__ == "__main__":
    unittest.main()
