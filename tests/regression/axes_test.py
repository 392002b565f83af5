#!/usr/bin/env python3
"""A shock tube along x, y and z of a line, a plane and a space: same errors, steps and drifts up to round-off."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import run

AFFINE_FLIP = ("MPM/conserving_gas_dynamics/transfer=affine_flip", "MPM/conserving_gas_dynamics/remap/every=4")
GRIDS = {1: ((100, 1, 1), (1, 1, 1)), 2: ((40, 4, 1), (1, .1, 1)), 3: ((40, 4, 3), (1, .1, .075))}


def turned(values, axis):
    """Returns the text of a vector whose first component is moved to `axis`; y and z follow it cyclically."""
    return "[" + ",".join(str(values[(d - axis) % 3]) for d in range(3)) + "]"


def tube(scene, objects, grid, axis, *sets):
    """Returns the report of Sod's tube along an axis; pairs among `sets` hold vectors to be turned as well."""
    cells, lengths = grid
    result = run(scene, "Grid/Level/Box/resolution=" + turned(cells, axis),
                 "Grid/Level/Box/upper=" + turned(lengths, axis),
                 f"{objects}[1]/box/max=" + turned((.5, 1, 1), axis),
                 f"{objects}[2]/box/min=" + turned((.5, 0, 0), axis),
                 "DataAnalysis/Module/normal=" + turned((1, 0, 0), axis),
                 *(item if isinstance(item, str) else item[0] + turned(item[1], axis) for item in sets))
    assert result.code == 0, result.err
    return result.report


class Axes(unittest.TestCase):
    def assert_alike(self, one, other, path=""):
        """Asserts that the numbers of nested reports agree to a relative 1e-13."""
        if isinstance(one, dict):
            self.assertEqual(one.keys(), other.keys(), path)
            for key in one:
                self.assert_alike(one[key], other[key], f"{path}/{key}")
        else:
            self.assertAlmostEqual(one, other, delta=1e-13 * max(1, abs(one)), msg=path)

    def assert_same_along_every_axis(self, scene, objects, *sets):
        for dimension, grid in GRIDS.items():
            with self.subTest(scene=scene, sets=sets, dimension=dimension):
                along_x, *others = [tube(scene, objects, grid, axis, *sets) for axis in range(3)]
                for other in others:
                    for part in ("steps", "particles", "errors", "drift"):
                        self.assert_alike(along_x[part], other[part], part)

    def test_particles(self):
        objects = "MaterialProperties/MPM/material/geom_object"
        self.assert_same_along_every_axis("ups/mpm/sod.ups", objects, (objects + "[1]/res=", (8, 1, 1)))
        self.assert_same_along_every_axis("ups/mpm/sod_conserving.ups", objects)
        self.assert_same_along_every_axis("ups/mpm/sod_conserving.ups", objects, *AFFINE_FLIP)

    def test_finite_volumes(self):
        self.assert_same_along_every_axis("ups/euler/sod.ups", "Euler/geom_object")


if __name__ == "__main__":
    unittest.main()
