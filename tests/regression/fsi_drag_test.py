#!/usr/bin/env python3
"""Momentum by exchange coefficients between bodies and gases: the same wherever in a cell a surface is, conserved,
never past a common velocity, and with the same bits on any layout."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_gases_test import DISC_OF_GASES
from gas_and_bodies import changed
from same_bits import SameBitsTest
from solids import SceneTest, globals_of, last_state
from sus import bits_of, run

DISC = changed(fsi.scene("carried_disc").read_text(), fsi.LIGHT)
RUNS_PAST = changed(DISC, (fsi.RESTING, fsi.RESTING.replace("[1,0.618,0]", "[0.2,-0.3,0]")),
                    ('<save label="GasEnergy"/>',
                     '<save label="TotalMomentum"/><save label="GasImpulseOnBodies"/><save label="GasEnergy"/>'
                     '<save label="GasWorkOnBodies"/>'))
HEIGHT, WIDTH = .5, 1 / 50


def plate(k, shift, *changes):
    """A heavy plate below gas of density 1 that slides along it by 1 m/s; its surface is `shift` cells above a face."""
    cut = DISC.index("<cylinder"), DISC.index("</cylinder>") + len("</cylinder>")
    box = f'<box label="plate"><min>[0,0,0]</min><max>[1,{HEIGHT + shift * WIDTH},1]</max></box>'
    text = DISC[:cut[0]] + box + DISC[cut[1]:]
    light = text.index("<geom_object>\n          <box label=\"light\">"), text.rindex("</geom_object>")
    text = text[:light[0]] + text[light[1] + len("</geom_object>"):]
    return changed(text, ("<periodic>[1,1,0]<", "<periodic>[1,0,0]<"), ("[1,0.618,0]</velocity>\n        </geom_object>"
                   "\n      </material>\n    </MPM>", "[0,0,0]</velocity>\n        </geom_object>\n      </material>\n"
                   "    </MPM>"), ("<velocity>[1,0.618,0]<", "<velocity>[1,0,0]<"),
                   ("<BoundaryConditions>", "<BoundaryConditions>" + "".join(
                       f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                       for side in ("y-", "y+"))),
                   ("<momentum>[1e15]", f"<momentum>[{k:g}]"), ("<density>10<", "<density>1e6<"),
                   ('<save label="GasEnergy"/>', '<save label="GasImpulseOnBodies"/>'), *changes)


class Drag(SceneTest):
    def impulse(self, k, shift, time):
        sets = (f"Time/maxTime={time}", "SimulationComponent/@type=rmpmice", "Grid/Level/Box/resolution=[8,50,1]")
        return globals_of(self.scene(plate(k, shift)), "GasImpulseOnBodies", sets=sets)["GasImpulseOnBodies"][-1][1]

    def test_is_a_quarter_of_a_cell_times_the_coefficient(self):
        """For a plane, the force per area is K h / 4 times the velocity, wherever in a cell the surface is."""
        k, time = 1, .01
        for shift in (0, .25, .5, .75):
            exact = k * WIDTH / 4 * 1 * time * (1 * .02)  # of an area of 1 m x .02 m
            self.assertLess(abs(self.impulse(k, shift, time) / exact - 1), .01, shift)

    def test_takes_gas_to_the_velocity_of_walls_but_not_past_it(self):
        """Slow gas in the row beside the plate decays by exp(-K t / 4 rho); for a large K it stops."""
        for k, most in ((10, None), (1e8, 1e-12)):
            sets = ("SimulationComponent/@type=rmpmice", "Time/maxTime=0.4", "Grid/Level/Box/resolution=[8,50,1]")
            slow = self.scene(plate(k, 0, ("<velocity>[1,0,0]<", "<velocity>[0.01,0,0]<")))
            state = last_state(slow, "c.velocity", "c.freeVolume", sets=sets)
            row = [v for v, y in zip(state["c.velocity.x [m/s]"], state["y [m]"]) if abs(y - HEIGHT - WIDTH / 2) < 1e-9]
            self.assertGreaterEqual(min(row), 0)
            if most:
                self.assertLess(max(row), most)
            else:
                self.assertLess(abs(max(row) / (.01 * math.exp(-k * .4 / 4)) - 1), .02, row)

    def test_of_an_oblique_wall_does_not_turn_the_wind(self):
        """Small cells along a disc at rest share the gas of their neighbours. In a step so short, only drag acts."""
        text = changed(DISC, (fsi.RESTING, fsi.RESTING.replace("1,0.618", "0,0")), ("[0.5,0.5,", "[0.51,0.49,"))
        state = last_state(self.scene(text), "c.velocity", "c.freeVolume", sets=(
            "SimulationComponent/@type=rmpmice", "Time/max_Timesteps=1", *fsi.resolution("carried_disc", 25),
            "Time/delt_max=1e-6", "MaterialProperties/exchange_properties/exchange_coefficients/momentum=[9e8]"))
        along = [(u + .618 * v) / (1 + .618 ** 2) for u, v, free in
                 zip(*(state[f"c.velocity.{a} [m/s]"] for a in "xy"), state[fsi.FREE]) if free > .2]
        self.assertLess(min(along), .1)
        self.assertGreater(min(along), -1e-3)

    def test_does_not_throw_light_bodies(self):
        """A node belongs to several faces, all of which drag: a thin plate as dense as the gas must not pass it."""
        for rows in (1, 4):
            light = changed(plate(1e8, 1.2), ("<density>1e6<", "<density>1<"), ("<res>[4,4,1]", "<res>[2,5,1]"),
                            ('label="plate"><min>[0,0,0]', 'label="plate"><min>[0,.5,0]'),
                            ("<outputInitTimestep/>", '<outputInitTimestep/><save label="p.velocity"/>'))
            sets = ("Time/max_Timesteps=1", f"Grid/Level/Box/resolution=[8,50,{rows}]",
                    f"Grid/Level/Box/upper=[1,1,{.02 * rows}]")
            found = last_state(self.scene(light), "p.velocity", sets=sets)["p.velocity.x [m/s]"]
            self.assertGreater(min(found), 0)
            self.assertLessEqual(max(found), 1)

    def test_conserves_momentum_and_energy(self):
        for k in (5, 1e3, 1e8):
            done = globals_of(self.scene(RUNS_PAST), "TotalMomentum", "GasImpulseOnBodies", "GasEnergy",
                              "GasWorkOnBodies",
                              sets=(f"MaterialProperties/exchange_properties/exchange_coefficients/momentum=[{k}]",
                                    "Time/maxTime=0.1", *fsi.resolution("carried_disc", 25)))
            momenta = [row[1:4] for row in done["TotalMomentum"]]
            for axis in (0, 1):
                self.assertLess(max(abs(one[axis] - momenta[0][axis]) for one in momenta), 1e-15, k)
            sums = [e[1] + w[1] for e, w in zip(done["GasEnergy"], done["GasWorkOnBodies"])]
            self.assertLess(max(abs(one / sums[0] - 1) for one in sums), 1e-13, k)
            self.assertGreater(abs(done["GasImpulseOnBodies"][-1][1]), 1e-6)

    def test_is_noted(self):
        for k, note in ((7, "that drag it along, with 7 h / 4 times the relative velocity per area"),
                        (0, "along which it slips, all the same")):
            note = f"{k}: body 0 consists of walls to the gas, {note}"
            self.assertIn(note, run(self.scene(plate(k, 0)), "Time/max_Timesteps=1", options=()).err)
        self.assertNotIn("walls to the gas", run(self.scene(plate(1e9, 0)), "Time/max_Timesteps=1", options=()).err)


class SameBits(SceneTest, SameBitsTest):
    LAYOUTS = ("[1,1,1]", "[5,3,1]", "[25,4,1]")
    SETS = tuple(fsi.resolution("carried_disc", 25))

    def assert_drag_is_the_same(self, text, walls, drag):
        scene = self.scene(changed(text, (walls, drag)))
        self.assert_same(scene, 30, self.LAYOUTS, *self.SETS, ranks=3)
        sets = (*self.SETS, "Time/max_Timesteps=30")
        self.assertNotEqual(*(bits_of(run(one, *sets).report) for one in (scene, self.scene(text))))

    def test_of_one_gas(self):
        self.assert_drag_is_the_same(RUNS_PAST, "[1e15]", "[30]")

    def test_of_two_gases(self):
        past = changed(DISC_OF_GASES, (fsi.RESTING, fsi.RESTING.replace("1,0.618", "0.2,-0.3")))
        self.assert_drag_is_the_same(past, "[1e15, 1e15, 1e15]", "[30, 500, 1e15]")


if __name__ == "__main__":
    unittest.main()
