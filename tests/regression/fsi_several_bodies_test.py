#!/usr/bin/env python3
"""Several bodies in a gas: a wall has the velocity of the bodies that form it; conservation and equal bits."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import ConservationTest, changed, saving
from same_bits import SameBitsTest
from solids import SceneTest, archive_of, columns, globals_of
from sus import run

PISTON, DISC = (fsi.scene(name).read_text() for name in ("moving_piston", "carried_disc"))
CONTACT = "<contact><type>null</type></contact>"


def with_second_body(text, first, second):
    """Returns a scene whose body is replaced by two, each with changes to the original."""
    start, end = text.index("<material name"), text.index("</MPM>\n    <ICE>")
    body = text[start:end]
    return changed(text[:start] + changed(body, *first) + changed(body, *second) + CONTACT + text[end:],
                   ("[1e15]", "[0,1e15,1e15]"), ("<heat>[0]", "<heat>[0,0,0]"))


# A light plate at rest, and a heavy piston that moves away behind it, less than a cell from the plate.
PLATE = with_second_body(
    PISTON, (("[1,0,0]</min><max>[1.2,1,1]", "[0.985,0,0]</min><max>[1,1,1]"), ('"piston"', '"plate"'),
             (">1000</density>", ">10</density>"), ("<velocity>[1,0,0]</velocity>", "")),
    (("[1,0,0]</min>", "[1.0075,0,0]</min>"),))
# A light disc, and a heavy one that moves through it.
DISCS = with_second_body(
    saving(DISC, *ConservationTest.KEPT, "GasWorkOnBodies"), ((">1000<", ">10<"),),
    ((">1000<", ">100<"), ('name="disc"', 'name="heavy"'), ('label="disc"', 'label="second"'),
     ("[1,0.618,0]", "[-1,0.3,0]"), ("[0.5,0.5,", "[0.62,0.47,")))
# Two blocks that touch, and part in a gas at rest. The space between them is a vacuum at first.
BLOCKS = with_second_body(
    changed(saving(DISC, "LeastGasHeat", "TotalMass", "TotalEnergy"),
            ("<cylinder", "<box"), ("</cylinder>", "</box>"), ("<radius>0.2</radius>", ""),
            ("<bottom>[0.5,0.5,-1]</bottom><top>[0.5,0.5,1]</top>", "<min>[0.3,0.3,0]</min><max>[0.5,0.7,1]</max>"),
            ("<velocity>[1,0.618,0]", "<velocity>[0,0,0]"), ("<density>0.2<", "<density>1<"),
            ("<temperature>5<", "<temperature>1<"), ("<reference_pressure>1<", "<reference_pressure>0<"),
            (">1000<", ">50<")),
    (("<velocity>[0,0,0]", "<velocity>[-1,0,0]"),),
    (("<velocity>[0,0,0]", "<velocity>[1,0,0]"), ('name="disc"', 'name="right"'), ('label="disc"', 'label="right"'),
     ("[0.3,0.3,0]</min><max>[0.5,", "[0.5,0.3,0]</min><max>[0.7,")))

RIGID_BLOCKS = changed(BLOCKS, ("<density>50<", "<is_force_transmitting_material>true</is_force_transmitting_material>"
                                                "<density>50<"))


def with_two_gases(text):
    """Returns BLOCKS with a lighter gas of another law in the right half."""
    start = text.index('<material name="gas">')
    end = text.index("</ICE>", start)
    gas = text[start:end].replace('label="light"', 'label="right"')
    first, last = gas.index("<geom_object>"), gas.rindex("<geom_object>")
    left = gas[:last] + "</material>\n"
    right = changed(gas[:first] + gas[last:], ("<density>1<", "<density>0.2<"), ("<temperature>1<", "<temperature>5<"),
                    ("<min>[0,0,0]</min><max>[0.5,1,1]", "<min>[0.5,0,0]</min><max>[1,1,1]"), ("1.4<", "1.6667<"),
                    ('"gas"', '"other"'), ("2.5<", "1.5<"))
    left = changed(left, ("<max>[1,1,1]", "<max>[0.5,1,1]"))
    return changed(text[:start] + left + right + text[end:], ("[0,1e15,1e15]", "[0,1e15,1e15,1e15,1e15,1e15]"),
                   ("<heat>[0,0,0]", "<heat>[0,0,0,0,0,0]"),
                   ('<save label="TotalMass"/>', '<save label="TotalMass-gas"/><save label="TotalMass-other"/>'))


class Walls(SceneTest):
    def test_of_a_plate_do_not_move_with_a_body_behind_it(self):
        scene = self.scene(PLATE)
        found = columns(archive_of(scene, scene.parent, "Time/maxTime=0.05"), "c.pressure")
        left = [p for x, p in zip(found["x [m]"], found["c.pressure [Pa]"]) if x < .98]
        self.assertLess(max(abs(p - 1) for p in left), 1e-12)


class Parting(SceneTest):
    SETS = fsi.resolution("carried_disc", 50)

    def assert_filled(self, text, *masses):
        """Asserts that all free cells have gas, and that the given totals of mass remain the same."""
        scene, sets = self.scene(text), (*self.SETS, "Time/maxTime=0.15")
        found = columns(archive_of(scene, scene.parent, *sets), "c.density", "c.freeVolume")
        free = [rho for rho, room in zip(found["c.density [kg/m^3]"], found["c.freeVolume [1]"]) if room > .5]
        self.assertGreater(min(free), 1e-6)
        totals = {name: [row[1] for row in rows]
                  for name, rows in globals_of(scene, "LeastGasHeat", *masses, sets=sets).items()}
        self.assertGreaterEqual(min(totals["LeastGasHeat"]), 0)
        for name in masses:
            self.assertLess(max(totals[name]) - min(totals[name]), 1e-13 * totals[name][0])

    def test_of_blocks_lets_gas_into_the_vacuum_between_them(self):
        self.assert_filled(BLOCKS, "TotalMass")

    def test_of_blocks_lets_each_of_two_gases_in(self):
        self.assert_filled(with_two_gases(BLOCKS), "TotalMass-gas", "TotalMass-other")

    def test_of_rigid_blocks_with_thin_walls_ends_where_a_wall_closes_a_cell(self):
        text = changed(RIGID_BLOCKS, ("<adv", "<thin_walls>true</thin_walls><adv"))
        done = run(self.scene(text), *fsi.resolution("carried_disc", 32), "Time/maxTime=0.05")
        self.assertEqual(done.code, 0, done.err)
        self.assertLess(done.report["retries"], 5)

    def test_of_blocks_is_not_held_up_by_friction(self):
        """Gas compresses the surfaces on both sides of a gap, so their stress does not tell whether they touch."""
        prints = {}
        for kind in ("approach", "friction", "friction_conserving"):
            scene = self.scene(BLOCKS.replace(CONTACT, f"<contact><type>{kind}</type><mu>0.2</mu></contact>"))
            told = run(scene, options=("--check",)).err
            self.assertEqual("lets bodies part under compression" in told, kind != "approach", told)
            prints[kind] = run(scene, *self.SETS, "Time/maxTime=0.05").report["fingerprint"]
        self.assertEqual(prints["approach"], prints["friction"])
        totals = globals_of(scene, "TotalEnergy", sets=(*self.SETS, "Time/maxTime=0.25"))["TotalEnergy"]
        self.assertLess(max(row[1] for row in totals) / totals[0][1] - 1, 1e-6)


class Sliding(SceneTest):
    def test_of_blocks_at_mach_7_ends_although_walls_of_one_corner_move_apart(self):
        text = changed(BLOCKS, ("[0.3,0.3,0]</min><max>[0.5,0.7", "[0.3,0.3,0]</min><max>[0.6,0.5"),
                       ("[0.5,0.3,0]</min><max>[0.7,0.7", "[0.3,0.5,0]</min><max>[0.6,0.7"),
                       ("<velocity>[-1,", "<velocity>[-7,"), ("<velocity>[1,", "<velocity>[7,"),
                       ('type="mpmice"', 'type="rmpmice"'))
        done = run(self.scene(text), *fsi.resolution("carried_disc", 24), "Time/maxTime=0.0143")
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(done.report["retries"], 0)


class Conservation(ConservationTest):
    SETS = (*fsi.resolution("carried_disc", 32), "Time/maxTime=0.1")

    def test_of_two_discs_that_overlap(self):
        self.assert_kept(DISCS, *self.SETS, elastic=True)
        totals = globals_of(self.scene(DISCS), "GasEnergy", "GasWorkOnBodies", sets=self.SETS)
        sums = [energy[1] + work[1] for energy, work in zip(*totals.values())]
        self.assertLess(max(abs(one / sums[0] - 1) for one in sums), 1e-12)


class Bits(SameBitsTest, SceneTest):
    def test_are_the_same_around_two_discs(self):
        self.assert_same(self.scene(DISCS), 40, ("[1,1,1]", "[5,3,1]", "[4,4,1]"),
                         *fsi.resolution("carried_disc", 32), ranks=3)

    def test_are_the_same_around_a_vacuum(self):
        for text in (BLOCKS, with_two_gases(BLOCKS)):
            self.assert_same(self.scene(text), 80, ("[1,1,1]", "[5,3,1]", "[4,4,1]"),
                             *fsi.resolution("carried_disc", 50), ranks=3)


if __name__ == "__main__":
    unittest.main()
