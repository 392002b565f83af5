#!/usr/bin/env python3
"""A shock tube along x, y and z of a line, a plane and a space: same errors, steps and drifts up to round-off. Turned
scenes whose sides have different conditions, so that corners of the grid matter: the same state, turned."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, last_state
from sus import ROOT, run

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


class Corners(SceneTest):
    """A box of gas between sides with different conditions, turned."""
    CELLS = 8
    SIDES = {"lid": {"x-": "[0,0,0]", "x+": "[0,0,0]", "y-": "[0,0,0]", "y+": "[.5,0,0]"},
             "wind": {"x-": "[.5,.2,0]", "y+": "[.3,-.4,0]", "x+": "symmetry"},
             "doors": {"x-": "[.3,.3,0]", "y-": "[0,.2,.1]", "z-": "[.1,0,.4]", "z+": "[0,0,0]"}}

    def turned_scene(self, sides, dimension, turn, tags, changes):
        """Returns the scene after `turn(vector)`, which maps axes to axes; see SIDES."""
        cells = [self.CELLS] * dimension + [1] * (3 - dimension)
        faces = ['<Face side="z-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>',
                 '<Face side="z+"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'] if dimension == 2 else []
        for side, given in sides.items():
            outward = turn([(1 if side[1] == "+" else -1) * (axis == side[0]) for axis in "xyz"])
            axis = next(d for d in range(3) if outward[d])
            name = "xyz"[axis] + ("+" if outward[axis] > 0 else "-")
            wind = "" if given == "symmetry" else turn([float(v) for v in given.strip("[]").split(",")])
            condition = (f'<BCType id="0" label="Velocity" var="Dirichlet"><value>{wind}</value></BCType>'
                         '<BCType id="0" label="Temperature" var="Dirichlet"><value>1.2</value></BCType>'
                         if wind else '<BCType id="all" label="Symmetric" var="symmetry"/>')
            faces.append(f'<Face side="{name}">{condition}</Face>')
        text = (ROOT / "ups/ice/channel.ups").read_text()
        start, end = text.index("<BoundaryConditions>"), text.index("</BoundaryConditions>")
        text = text[:start] + "<BoundaryConditions>" + "".join(faces) + text[end:]
        for before, after in (("<periodic>[1,0,0]</periodic>", ""), ("<upper>[0.25,1,1]<", "<upper>[1,1,1]<"),
                              ("[8,32,1]", str(cells)), ("[0.04,0,0]", "[0,0,0]"),
                              ('"vel_CC"', '"c.velocity"'), ('"temp_CC"', '"c.density"'),
                              ("<dynamic_viscosity>0.1<", "<dynamic_viscosity>0.02<"),
                              ("<advection type=", tags + "<advection type="), *changes):
            self.assertIn(before, text)
            text = text.replace(before, after)
        return text[:text.index("<DataAnalysis>")] + "</Uintah_specification>"

    def assert_turns(self, sides, dimension, turn, steps=12, tags="", changes=()):
        def place(x):
            return tuple(round(2 * self.CELLS * (v - .5)) if d < dimension else 0 for d, v in enumerate(x))
        states = []
        for way in (list, turn):
            scene = self.scene(self.turned_scene(self.SIDES[sides], dimension, way, tags, changes))
            of = last_state(scene, "c.density", "c.velocity", sets=[f"Time/max_Timesteps={steps}"])
            names = list(of)
            columns = list(zip(*(of[name] for name in names)))
            positions = [names.index(f"{axis} [m]") if f"{axis} [m]" in names else None for axis in "xyz"]
            speeds = [names.index(f"c.velocity.{axis} [m/s]") for axis in "xyz"]
            density = next(k for k, name in enumerate(names) if name.startswith("c.density"))
            states.append({place([row[k] if k is not None else .5 for k in positions]):
                           ([row[k] for k in speeds], row[density]) for row in columns})
        self.assertEqual(len(states[0]), self.CELLS**dimension)
        greatest = 0
        for x, (v, density) in states[0].items():
            u, other = states[1][tuple(turn(list(x)))]
            greatest = max(greatest, *map(abs, v))
            self.assertLess(max(abs(density - other), *(abs(a - b) for a, b in zip(turn(v), u))), 1e-13)
        self.assertGreater(greatest, .05)

    def test_of_a_plane_do_not_depend_on_the_order_of_axes(self):
        turn = lambda v: [-v[1], v[0], v[2]]  # noqa: E731
        sutherland = ("<dynamic_viscosity>0.02<", "<dynamicViscosityModels><Model name='Sutherland'><a>.04</a><b>1</b>"
                      "</Model></dynamicViscosityModels><dynamic_viscosity>0.02<")
        solver = "<ImplicitSolver><Solver><tolerance>1e-15</tolerance></Solver></ImplicitSolver>"
        for sides in ("lid", "wind"):
            for tags in ("", solver):
                with self.subTest(sides=sides, tags=tags):
                    self.assert_turns(sides, 2, turn, tags=tags)
            with self.subTest(sides=sides, viscosity="varies"):
                self.assert_turns(sides, 2, turn, changes=[sutherland])

    def test_of_a_space_do_not_depend_on_the_order_of_axes(self):
        for sides in ("lid", "doors"):
            with self.subTest(sides):
                self.assert_turns(sides, 3, lambda v: [v[2], v[0], v[1]])


if __name__ == "__main__":
    unittest.main()
