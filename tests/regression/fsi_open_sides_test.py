#!/usr/bin/env python3
"""Bodies that cross an open side of the grid: gas that moves with them keeps its pressure and velocity, as inside, with
the same bits on any layout and after a restart."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_images_test import Image, open_sides
from gas_and_bodies import changed
from same_bits import SameBitsTest
from solids import SceneTest, archive_of, columns

CELLS = {1: (20, 1, 1), 2: (20, 20, 1), 3: (12, 12, 12)}
ROUND_OFF = 1e-11


def leaving(axes, shape, velocity, cut, gas=None, kind="rmpmice", rigid=True):
    """A body in a gas of the same velocity or another, in a grid whose sides along the first axes are open."""
    of = Image()
    upper = [1 if axis < axes else .05 for axis in range(3)]
    body = of.body(shape, 10, velocity, cut, rigid=rigid, temperature=1)
    return of.scene(((0, 0, 0), upper, CELLS[axes]), [body], of.gas(gas or velocity), kind=kind,
                    changes=open_sides("xyz"[:axes]))


def slab(first, last):
    return Image().box((first, -1, -1), (last, 2, 2))


class Uniform(SceneTest):
    def worst(self, text, velocity, *sets):
        """Returns the largest differences of p from 1 and of the velocity from its uniform value, in all outputs."""
        path = self.scene(text)
        archive = archive_of(path, path.parent, "Time/maxTime=0.7", "DataArchiver/outputInterval=0.1", *sets)
        worst = 0
        for time in (.2, .3, .5, .7):  # before, while and after the body leaves
            found = columns(archive, "c.pressure", "c.velocity", "c.density", "c.freeVolume", time=time)
            axes = [axis for axis in "xyz" if f"c.velocity.{axis} [m/s]" in found]
            for k, (mass, free) in enumerate(zip(found["c.density [kg/m^3]"], found["c.freeVolume [1]"])):
                if not (mass > 0 and free >= 1e-9):
                    continue
                worst = max(worst, abs(found["c.pressure [Pa]"][k] - 1),
                            *(abs(found[f"c.velocity.{axis} [m/s]"][k] - velocity["xyz".index(axis)]) for axis in axes))
        return worst

    def assert_uniform(self, axes, shape, velocity, cut, **how):
        self.assertLess(self.worst(leaving(axes, shape, velocity, cut, **how), velocity), ROUND_OFF)

    def test_on_a_line(self):
        """Until 30 November 2026, p was off by half."""
        for cut in (2, 3, 4):
            self.assert_uniform(1, slab(.5, .7), (1, 0, 0), (cut, 1, 1))
        self.assert_uniform(1, slab(.3, .5), (-1, 0, 0), (4, 1, 1))

    def test_with_bodies_that_waves_cross(self):
        for rigid in (False, True):
            self.assert_uniform(1, slab(.5, .7), (1, 0, 0), (2, 1, 1), kind="mpmice", rigid=rigid)

    def test_in_implicit_steps(self):
        solver = "<ImplicitSolver><Solver><tolerance>1e-13</tolerance></Solver></ImplicitSolver>"
        text = leaving(1, slab(.5, .7), (1, 0, 0), (2, 1, 1))
        text = changed(text, ("<ICE>\n      <advection", f"<ICE>{solver}<advection"))
        self.assertLess(self.worst(text, (1, 0, 0)), ROUND_OFF)

    def test_with_two_gases(self):
        text = changed(fsi.scene("contact_of_gases").read_text(), ("<periodic>[1,0,0]</periodic>", ""))
        self.assertLess(self.worst(text, (1, 0, 0)), ROUND_OFF)

    def test_in_a_plane(self):
        self.assert_uniform(2, Image().disc((.7, .5), .2), (1, 0, 0), (4, 4, 1))

    def test_through_a_corner(self):
        self.assert_uniform(2, Image().disc((.7, .7), .2), (1, .8, 0), (3, 3, 1))

    def test_in_space(self):
        self.assert_uniform(3, Image().ball((.7, .5, .5), .2), (1, .3, .2), (2, 2, 2))


class Bits(SceneTest, SameBitsTest):
    def test_are_the_same_on_any_layout(self):
        text = leaving(2, Image().disc((.75, .7), .2), (1, .8, 0), (3, 3, 1), gas=(.5, .2, 0), kind="mpmice")
        self.assert_same(self.scene(text), 50, ("[1,1,1]", "[5,4,1]", "[10,2,1]"), ranks=3)


if __name__ == "__main__":
    unittest.main()
