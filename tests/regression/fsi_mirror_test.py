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
        places = list(zip(found["x [m]"], found["y [m]"]))
        number = {place: k for k, place in enumerate(places)}
        pairs = [(k, number[x, -y]) for k, (x, y) in enumerate(places)]
        return (max(abs(found[PRESSURE][a] - found[PRESSURE][b]) for a, b in pairs),
                max(abs(found[UP][a] + found[UP][b]) for a, b in pairs), max(map(abs, found[UP])))

    def test_of_a_fixed_disc_in_wind_has_the_same_bits(self):
        pressure, up, greatest = self.asymmetry(changed(WIND, ('type="mpmice"', 'type="rmpmice"')))
        self.assertEqual((pressure, up), (0, 0))
        self.assertGreater(greatest, .1)

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


class Quarter(SceneTest):
    def test_between_symmetry_planes_is_that_of_the_whole(self):
        """The gas compresses a block, two cells wide, from all sides. Linear functions do not reach beyond planes. One
        step: later, cells at a plane open that hold a part of the block."""
        whole = changed(fsi.scene("rest").read_text(), ("<outputInitTimestep/>", '<save label="p.velocity"/>'),
                        ("<lower>[0,0,0]<", "<lower>[-0.5,-0.5,0]<"), ("<upper>[1,1,0.02]<", "<upper>[0.5,0.5,0.05]<"),
                        ("[50,50,1]", "[20,20,1]"), ("<cylinder", "<box"), ("</cylinder>", "</box>"),
                        ("<bottom>[0.5,0.5,-1]</bottom>", "<min>[-0.05,-0.05,-1]</min>"),
                        ("<top>[0.5,0.5,1]</top>", "<max>[0.05,0.05,1]</max>"), ("<radius>0.2</radius>", ""),
                        ("<density>1000<", "<density>3<"), ("0.0</bulk_modulus>", "</bulk_modulus>"),
                        ("0.0</shear_modulus>", "</shear_modulus>"), ("<min>[0,0,0]</min>", "<min>[-1,-1,0]</min>"),
                        ("<temperature>1<", "<temperature>2<"), (">gimp<", ">linear<"))
        quarter = changed(whole, ("<lower>[-0.5,-0.5,0]<", "<lower>[0,0,0]<"), ("[20,20,1]", "[10,10,1]"))
        one_step = ("Time/max_Timesteps=1",)
        found = [last_state(self.scene(text), "p.velocity", sets=one_step) for text in (whole, quarter)]
        there = [{(int(80 * x), int(80 * y)): v for x, y, v in zip(*list(one.values())[:2], one["p.velocity.x [m/s]"])
                  if min(x, y) > 0} for one in found]
        self.assertEqual(len(there[0]), 16)
        self.assertEqual(sorted(there[0]), sorted(there[1]))
        most = max(map(abs, there[0].values()))
        self.assertGreater(most, 1e-4)
        self.assertLess(max(abs(v - there[1][place]) for place, v in there[0].items()), 1e-12 * most)


class Hole(FolderTest):
    def test_with_a_negligible_negative_mass_ends_no_run(self):
        fine = ("Grid/Level/Box/resolution=[800,160,1]", "Grid/Level/Box/upper=[1,0.2,0.00125]", "Time/max_Timesteps=2")
        self.assertEqual(self.well(self.folder().run("ups/fsi/cylinder.ups", *fine))["steps"], 2)


if __name__ == "__main__":
    unittest.main()
