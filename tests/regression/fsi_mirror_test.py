#!/usr/bin/env python3
"""Mirrored scenes of gas and bodies: the same bits around fixed bodies, and round-off around others."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import DISC, changed, rigid
from solids import SceneTest, archive_of, columns, last_state
from uda import FolderTest

PRESSURE, UP = "c.pressure [Pa]", "c.velocity.y [m/s]"
RESTING = changed(DISC, ("<lower>[0,0,0]<", "<lower>[-0.5,-0.5,0]<"),
                  ("<upper>[1,1,0.02]<", "<upper>[0.5,0.5,0.015625]<"),
                  ("[50,50,1]", "[64,64,1]"), ("[0.5,0.5,-1]", "[0,0,-1]"), ("[0.5,0.5,1]", "[0,0,1]"),
                  ("<min>[0,0,0]</min><max>[1,1,1]", "<min>[-1,-1,0]</min><max>[1,1,1]"),
                  ("<min>[0,0,0]</min><max>[0.5,1,1]", "<min>[-1,-1,0]</min><max>[-0.25,1,1]"),
                  ("<velocity>[1,0.618,0]<", "<velocity>[0.75,0,0]<"))
# Wind along x, and a disc at rest in its middle.
WIND = RESTING.replace("<velocity>[0.75,0,0]<", "<velocity>[0,0,0]<", 1)


class Mirror(SceneTest):
    def asymmetry(self, text):
        """Returns the greatest differences of pressure and velocity between mirrored cells after 40 steps."""
        scene = self.scene(text)
        found = columns(archive_of(scene, scene.parent, "Time/max_Timesteps=40"), "c.pressure", "c.velocity")
        places = [(round(x, 9), round(y, 9)) for x, y in zip(found["x [m]"], found["y [m]"])]
        number = {place: k for k, place in enumerate(places)}
        pairs = [(k, number[x, -y]) for k, (x, y) in enumerate(places)]
        return (max(abs(found[PRESSURE][a] - found[PRESSURE][b]) for a, b in pairs),
                max(abs(found[UP][a] + found[UP][b]) for a, b in pairs), max(map(abs, found[UP])))

    def test_of_a_fixed_disc_in_wind_has_the_same_bits(self):
        pressure, up, greatest = self.asymmetry(changed(WIND, ('type="mpmice"', 'type="rmpmice"')))
        self.assertEqual((pressure, up), (0, 0))
        self.assertGreater(greatest, .1)

    def test_of_a_burning_disc_in_the_middle_of_a_row_differs_by_round_off(self):
        """Cells inside the disc lie between neighbours that suit equally well. Until 29 November 2026, the lower one
        got their gas: pressures differed by 936 Pa, and velocities by 4.3 m/s of 16."""
        burning = "<Models><Model type='Test'><Test><fromMaterial>disc</fromMaterial><toMaterial>gas</toMaterial>" \
                  "<rate>2</rate></Test></Model></Models></Uintah_specification>"
        disc = changed(WIND, ('type="mpmice"', 'type="rmpmice"'), ("[64,64,1]", "[16,15,1]"), ("0.015625", "0.0625"),
                       ("<radius>0.2</radius>", "<radius>0.23</radius>"), ("</Uintah_specification>", burning),
                       ("<density>1000</density>", "<density>1000</density><specific_heat>1</specific_heat>"))
        pressure, up, greatest = self.asymmetry(disc)
        self.assertLess(up, 1e-12)
        self.assertLess(pressure, 1e-10)
        self.assertGreater(greatest, 10)

    def test_of_a_rigid_disc_that_wind_moves_differs_by_round_off(self):
        pressure, up, greatest = self.asymmetry(changed(rigid(WIND), ("<density>1000<", "<density>10<")))
        self.assertLess(max(pressure, up), 1e-12)
        self.assertGreater(greatest, .1)

    def test_of_a_rigid_block_that_leaves_a_wall_differs_by_round_off(self):
        """A corner of the block opens the cells beside it, from which only round-off must not let gas in."""
        block = changed(rigid(RESTING), ("<cylinder", "<box"), ("</cylinder>", "</box>"), ("<radius>0.2</radius>", ""),
                        ("<bottom>[0,0,-1]</bottom>", "<min>[-0.5,-0.3125,0]</min>"),
                        ("<top>[0,0,1]</top>", "<max>[0,0.3125,1]</max>"),
                        ("<velocity>[0.75,0,0]<", "<velocity>[0,0,0]<"), ("<periodic>[1,1,0]", "<periodic>[0,1,0]"))
        side = '<Face side="{}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
        block = block.replace("<BoundaryConditions>", "<BoundaryConditions>" + side.format("x-") + side.format("x+"))
        start = block.index("<material name")
        end = block.index("</material>", start)
        moving = block[start:end].replace("<velocity>[0,0,0]<", "<velocity>[1,0,0]<")
        pressure, up, greatest = self.asymmetry(block[:start] + moving + block[end:])
        self.assertLess(max(pressure, up), 1e-12)
        self.assertGreater(greatest, .1)


class Burst(SceneTest):
    def pressures(self, text, sign):
        """The pressure after four steps in the cells of a scene, by (sign x, y)."""
        scene = self.scene(text)
        found = columns(archive_of(scene, scene.parent, "Time/max_Timesteps=4", "DataArchiver/outputInterval=1"),
                        "c.pressure")
        places = zip(found["x [m]"], found["y [m]"])
        return {(round(sign * x, 9), round(y, 9)): p for (x, y), p in zip(places, found[PRESSURE])}

    def test_mirrored_differs_by_round_off(self):
        """Edges of particles start on faces of cells. On which side round-off puts them must not decide how walls move:
        until 29 November 2026, pressures differed by 1.4e-5 after one step."""
        text = fsi.scene("burst").read_text()
        mirrored = changed(text, ("<lower>[0,0,0]<", "<lower>[-1,0,0]<"), ("<upper>[1,1,0.02]<", "<upper>[0,1,0.02]<"),
                           ('side="x-"', 'side="x+"'),
                           ("<min>[0,0,0]</min><max>[1,1,1]", "<min>[-1,0,0]</min><max>[0,1,1]"))
        one, other = self.pressures(text, 1), self.pressures(mirrored, -1)
        self.assertEqual(one.keys(), other.keys())
        self.assertLess(max(abs(p - other[place]) for place, p in one.items()), 1e-11 * max(one.values()))


class Quarter(SceneTest):
    def test_between_symmetry_planes_is_that_of_the_whole(self):
        """The gas compresses a block, two cells wide, from all sides. Linear functions do not reach beyond planes.
        After the first step, cells at a plane open that hold a part of the block."""
        whole = changed(fsi.scene("rest").read_text(), ("<outputInitTimestep/>", '<save label="p.velocity"/>'),
                        ("<lower>[0,0,0]<", "<lower>[-0.5,-0.5,0]<"), ("[50,50,1]", "[16,16,1]"),
                        ("<upper>[1,1,0.02]<", "<upper>[0.5,0.5,0.0625]<"),
                        ("<cylinder", "<box"), ("</cylinder>", "</box>"),
                        ("<bottom>[0.5,0.5,-1]</bottom>", "<min>[-0.0625,-0.0625,-1]</min>"),
                        ("<top>[0.5,0.5,1]</top>", "<max>[0.0625,0.0625,1]</max>"), ("<radius>0.2</radius>", ""),
                        ("<density>1000<", "<density>3<"), ("0.0</bulk_modulus>", "</bulk_modulus>"),
                        ("0.0</shear_modulus>", "</shear_modulus>"), ("<min>[0,0,0]</min>", "<min>[-1,-1,0]</min>"),
                        ("<temperature>1<", "<temperature>2<"), (">gimp<", ">linear<"))
        quarter = changed(whole, ("<lower>[-0.5,-0.5,0]<", "<lower>[0,0,0]<"), ("[16,16,1]", "[8,8,1]"))
        steps = ("Time/max_Timesteps=20",)
        found = [last_state(self.scene(text), "p.velocity", sets=steps) for text in (whole, quarter)]
        there = [{(int(64 * x), int(64 * y)): v for x, y, v in zip(*list(one.values())[:2], one["p.velocity.x [m/s]"])
                  if min(x, y) > 0} for one in found]
        self.assertEqual(len(there[0]), 16)
        self.assertEqual(sorted(there[0]), sorted(there[1]))
        most = max(map(abs, there[0].values()))
        self.assertGreater(most, 1e-4)
        self.assertLess(max(abs(v - there[1][place]) for place, v in there[0].items()), 1e-12 * most)


class Half(SceneTest):
    """A disc or a ball in hot gas, carried along the planes that cut it: half of it, in front of one plane, is half of
    the whole. The whole itself is symmetric only to round-off, which cells that the body nearly fills enlarge."""
    MOST = 1e-7  # before 29 November 2026: 2e-6 to 1e-5 in a plane, .02 in three dimensions
    CELLS = 16

    def part(self, axis, side, dimension, changes):
        """Returns the scene with a plane through the middle, normal to `axis`, at the lower (0) or upper (1) side; the
        whole without a side."""
        lower, upper, cells = [-.5] * 3, [.5] * 3, [self.CELLS] * 3
        if dimension == 2:
            lower[2], upper[2], cells[2] = 0, 1 / self.CELLS, 1
        if side is not None:
            (lower, upper)[side][axis] = 0
            cells[axis] //= 2
        along = 1 if axis == 0 else 0
        wind, hot = [0, 0, 0], [1, 1, 1]
        wind[along], hot[along] = .5, -.25
        text = changed(fsi.scene("rest").read_text(), ("<outputInitTimestep/>", '<save label="p.velocity"/>'),
                       ("<lower>[0,0,0]<", f"<lower>{lower}<"), ("<upper>[1,1,0.02]<", f"<upper>{upper}<"),
                       ("[50,50,1]", str(cells)), ("[0.5,0.5,-1]", "[0,0,-1]"), ("[0.5,0.5,1]", "[0,0,1]"),
                       ("<density>1000<", "<density>10<"), ("<bulk_modulus>10000.0<", "<bulk_modulus>100<"),
                       ("<shear_modulus>1000.0<", "<shear_modulus>50<"), (">gimp<", ">linear<"),
                       ("<min>[0,0,0]</min>", "<min>[-1,-1,-1]</min>"),
                       ("<res>[4,4,1]</res>", f"<res>[2,2,{dimension - 1}]</res><velocity>{wind}</velocity>"),
                       ("</geom_object>\n      </material>\n    </ICE>", "</geom_object><geom_object>"
                        f"<box><min>[-1,-1,-1]</min><max>{hot}</max></box><density>1.5</density>"
                        "<temperature>1.5</temperature></geom_object></material></ICE>"), *changes)
        if dimension == 2:
            return text
        return changed(text, ("<cylinder", "<sphere"), ("</cylinder>", "</sphere>"),
                       ("<bottom>[0,0,-1]</bottom><top>[0,0,1]</top>", "<origin>[0,0,0]</origin>"))

    def assert_half_is_half_of_the_whole(self, axis, dimension=2, steps=10, changes=()):
        states = []
        for side in (None, 0, 1):
            scene = self.scene(self.part(axis, side, dimension, changes))
            archive = archive_of(scene, scene.parent, f"Time/max_Timesteps={steps}")
            states.append([columns(archive, "c.pressure", "c.velocity", "c.freeVolume"),
                           columns(archive, "p.velocity")])
        for half in states[1:]:
            for whole, part in zip(states[0], half):
                places = [name for name in ("x [m]", "y [m]", "z [m]") if name in part]
                whole, found = ({tuple(round(4 * self.CELLS * x) for x in place): values for place, values in
                                 zip(zip(*(of[name] for name in places)),
                                     zip(*(of[name] for name in of if name not in places)))} for of in (whole, part))
                self.assertEqual(2 * len(found), len(whole))
                error = max(abs(a - b) for place, values in found.items() for a, b in zip(values, whole[place]))
                self.assertLess(error, self.MOST, (axis, dimension))

    def test_of_a_disc_is_half_of_the_whole(self):
        for axis in (0, 1):
            self.assert_half_is_half_of_the_whole(axis)

    def test_of_a_ball_is_half_of_the_whole(self):
        for axis in (0, 1, 2):
            self.assert_half_is_half_of_the_whole(axis, 3, 5)

    def test_of_a_disc_in_viscous_gas_is_half_of_the_whole(self):
        self.assert_half_is_half_of_the_whole(1, changes=[("<dynamic_viscosity>0<", "<dynamic_viscosity>0.01<"),
                                                          ("<thermal_conductivity>0<", "<thermal_conductivity>0.03<")])

    def test_of_a_disc_with_implicit_steps_is_half_of_the_whole(self):
        solver = "<ImplicitSolver><Solver><tolerance>1e-13</tolerance></Solver></ImplicitSolver>"
        self.assert_half_is_half_of_the_whole(0, changes=[("<ICE>\n      <advection", f"<ICE>{solver}<advection")])

    def test_of_two_bodies_is_half_of_the_whole(self):
        """The second body is a block in the way of the disc."""
        block = """<material name="block"><density>12</density><constitutive_model type="comp_neo_hook">
          <bulk_modulus>100</bulk_modulus><shear_modulus>50</shear_modulus></constitutive_model><geom_object>
          <box><min>[-.1,.22,-1]</min><max>[.1,.34,1]</max></box><res>[2,2,1]</res></geom_object></material>"""
        contact = "<contact><type>friction</type><materials>[0,1]</materials><mu>0</mu></contact>"
        self.assert_half_is_half_of_the_whole(0, steps=5, changes=[
            ("</material>\n    </MPM>", f"</material>{block}{contact}</MPM>"),
            ("<momentum>[1e15]<", "<momentum>[0,1e15,1e15]<"), ("<heat>[0]<", "<heat>[0,0,0]<")])


class Hole(FolderTest):
    def test_with_a_negligible_negative_mass_ends_no_run(self):
        fine = ("Grid/Level/Box/resolution=[800,160,1]", "Grid/Level/Box/upper=[1,0.2,0.00125]", "Time/max_Timesteps=2")
        self.assertEqual(self.well(self.folder().run("ups/fsi/cylinder.ups", *fine))["steps"], 2)


if __name__ == "__main__":
    unittest.main()
