#!/usr/bin/env python3
"""Several gases around bodies: exactness, errors, the mass of each, the same bits on any layout."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from same_bits import SameBitsTest


class Gases(unittest.TestCase):
    def assert_within(self, errors, limit, *names):
        for name in names:
            self.assertLess(abs(errors[name]), limit, errors)

    def test_a_body_and_gases_of_two_laws_that_move_alike_go_on_as_they_are(self):
        for cells in (50, 100):
            errors = fsi.contact_of_gases(cells)
            self.assert_within(errors, 1e-11, *errors)

    def test_a_plug_between_two_gases_each_of_which_keeps_its_mass(self):
        errors = fsi.plug_of_gases(100)
        self.assert_within(errors, 1.5 * 2.6e-4, "v")
        self.assert_within(errors, 1.5 * 1.9e-4, "x")
        self.assert_within(errors, 1e-14, "energy", "mass of stiff", "mass of soft")

    def test_a_bubble_and_a_body_in_water_under_a_shock(self):
        errors = fsi.bubble_and_body(100)
        self.assert_within(errors, 1e-13, "mass of air", "impulse")
        self.assert_within(errors, .03, "p behind the shock")


class Bits(SameBitsTest):
    SPACE = ("Grid/Level/Box/resolution=[20,10,10]", "Grid/Level/Box/upper=[0.1,0.05,0.05]")

    def test_are_the_same_on_a_line(self):
        self.assert_same("plug_of_gases", 150, ("[1,1,1]", "[7,1,1]", "[50,1,1]"), ranks=1)

    def test_are_the_same_in_a_plane(self):
        self.assert_same("bubble_and_body", 60, ("[1,1,1]", "[5,3,1]", "[20,4,1]"), ranks=3)

    def test_are_the_same_in_space(self):
        self.assert_same("bubble_and_body", 15, ("[1,1,1]", "[3,2,2]", "[5,1,4]"), *self.SPACE, ranks=1)


if __name__ == "__main__":
    unittest.main()
