#!/usr/bin/env python3
"""Gas around bodies: no cell has a negative content."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from solids import SceneTest, globals_of

# The panel on wider cells.
PANEL = ("Grid/Level/Box/resolution=[150,32,1]", "Grid/Level/Box/upper=[0.25,0.064,0.002]")


class Positivity(SceneTest):
    """No cell, holes in bodies included, has a negative gas mass or heat."""
    LEAST = ("LeastGasMass", "LeastGasHeat")

    def assert_positive(self, name, *sets, least=0):
        text = re.sub(r"( *)<outputInitTimestep/>", "".join(f'<save label="{label}"/>' for label in self.LEAST) +
                      r"<outputInitTimestep/>", fsi.scene(name).read_text())
        for label, lines in globals_of(self.scene(text), *self.LEAST, sets=sets).items():
            self.assertGreaterEqual(min(line[1] for line in lines), least, f"{label} of {name}")

    def test_on_a_line(self):
        for name in ("gun", "plug", "sod_plate", "contact", "elastic_wall", "moving_piston", "slow_piston"):
            self.assert_positive(name)
        self.assert_positive("closed_box", "Time/maxTime=0.2")

    def test_in_a_plane(self):
        for name in ("rest", "burst", "wedge"):
            self.assert_positive(name)
        self.assert_positive("carried_disc", *fsi.resolution("carried_disc", 25))
        self.assert_positive("cylinder", "Time/maxTime=0.1")
        self.assert_positive("panel", *PANEL, "Time/max_Timesteps=200")

    def test_of_several_gases(self):
        self.assert_positive("plug_of_gases")
        # Of air in water as little as nothing may be missing: 1e-9 of the water.
        self.assert_positive("bubble_and_body", *fsi.resolution("bubble_and_body", 50), least=-1e-6)

    def test_in_space(self):
        self.assert_positive("ball", "Grid/Level/Box/resolution=[20,10,10]")


if __name__ == "__main__":
    unittest.main()
