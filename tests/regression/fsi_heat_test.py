#!/usr/bin/env python3
"""Heat between bodies and gases, by exchange coefficients and by conduction: the same wherever in a cell a surface is,
conserved, and with the same bits on any layout."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_images_test import Image, warm_discs
from gas_and_bodies import changed
from same_bits import SameBitsTest
from solids import SceneTest, globals_of, last_state
from sus import run

PLANE = '<BCType id="all" label="Symmetric" var="symmetry"/>'
WALL = """
        <BCType id="1" label="Velocity" var="Dirichlet"><value>[0,0,0]</value></BCType>
        <BCType id="1" label="Temperature" var="Dirichlet"><value>1</value></BCType>
        <BCType id="1" label="Pressure" var="Neumann"><value>0</value></BCType>
      """
BODY = """<material name="{}"><density>{}</density><constitutive_model type="comp_neo_hook">
<bulk_modulus>50</bulk_modulus><shear_modulus>25</shear_modulus></constitutive_model><specific_heat>{}</specific_heat>
<thermal_conductivity>0</thermal_conductivity><geom_object><box label="{}"><min>[{},0,0]</min><max>[{},1,1]</max></box>
<res>[4,1,1]</res><temperature>{}</temperature></geom_object></material>"""


def slab(first, last, cells=20, temperature=2):
    """A body between two cells, whose numbers may be fractions."""
    name = f"from{first:g}"
    return BODY.format(name, 1000, 1, name, first / cells, last / cells, temperature)


def line(bodies, heat, *changes):
    """A line of 20 cells, closed on both sides, with gas of the temperature 1 around bodies at rest."""
    text = fsi.scene("warm_body").read_text()
    first, last = text.index('<material name="body">'), text.index("</MPM>\n    <ICE>")
    momentum = [1e15] * (len(bodies) * (len(bodies) + 1) // 2)
    return changed(text[:first] + "".join(bodies) + text[last:], (WALL, PLANE), ("<maxTime>30<", "<maxTime>0.05<"),
                   ("<thermal_conductivity>0.25<", "<thermal_conductivity>0<"), ("[1e15]", str(momentum)),
                   ("<heat>[1e-6]", f"<heat>{heat}"), ('<save label="GasEnergy"/>', "".join(
                       f'<save label="{name}"/>' for name in ("GasEnergy", "TotalEnergy", "ThermalEnergy"))), *changes)


CLOSED, SWITCH = "</exchange_coefficients>", "<do_convective_heat_transfer>true</do_convective_heat_transfer>"


def convection(fluid, solid):
    """The change by which the surface of a body also exchanges heat with the fluid in front of it."""
    return CLOSED, (f"{CLOSED}{SWITCH}<convective_fluid>{fluid}</convective_fluid>"
                    f"<convective_solid>{solid}</convective_solid>")


class Coefficients(SceneTest):
    def heat_from(self, bodies, heat=(1,), *changes):
        """Returns the heat that bodies give to the gas, and the relative change of all energy."""
        found = globals_of(self.scene(line(bodies, list(heat), *changes)), "GasHeatToBodies", "TotalEnergy")
        energies = [row[1] for row in found["TotalEnergy"]]
        return -found["GasHeatToBodies"][-1][1], max(abs(one / energies[0] - 1) for one in energies)

    def test_act_wherever_in_a_cell_a_surface_is(self):
        """H theta_a theta_b is H / 4 in a cell of which a body fills one half, and a plane surface has one such cell.
        Until 30 November 2026, a surface on a face exchanged no heat."""
        found = [self.heat_from([slab(6 + shift, 12 + shift)])[0] for shift in (0, .25, .5, .75)]
        exact = 2 * (1 / 4) * .05 * (2 - 1) * .05  # two surfaces with H = 1, cells of .05 m, 1 K, .05 s
        for heat in found:
            self.assertLess(abs(heat / exact - 1), .01, found)
        self.assertLess(max(found) / min(found) - 1, .005, found)

    def test_act_between_bodies_in_neighbouring_cells(self):
        """The colder one of two bodies that touch at a face, or within a cell, gets H / 4 of a cell times 1 K."""
        for shift in (0, .25, .5, .75):
            scene = self.scene(line([slab(4, 8 + shift, temperature=1), slab(8 + shift, 12)], [1, 0, 0],
                                    ('<save label="c.density"/>', '<save label="p.temperature"/>')))
            found = last_state(scene, "p.temperature", material="from4")["p.temperature [K]"]
            gained = sum(one - 1 for one in found) / len(found) * 1000 * (4 + shift) * .05
            self.assertLess(abs(gained / (1 / 4 * .05 * .05) - 1), .01, shift)

    def test_of_convection_add_another_quarter_of_a_cell(self):
        exact = 2 * (1 / 4 + 1 / 4) * .05 * (2 - 1) * .05
        for shift in (0, .25, .5, .75):
            heat, drift = self.heat_from([slab(6 + shift, 12 + shift)], [1], convection(1, 0))
            self.assertLess(abs(heat / exact - 1), .01, shift)
            self.assertLess(drift, 1e-14, shift)
        heat, drift = self.heat_from([slab(6.25, 12.25)], [1e15], convection(1, 0))
        self.assertLess(drift, 1e-14)

    def test_of_convection_act_on_one_body(self):
        """Two bodies in the gas: the second one convects."""
        both = [slab(2, 5.5), slab(12, 15.5)]
        alone = self.heat_from(both, [0, 1, 1])[0]
        self.assertLess(abs(self.heat_from(both, [0, 1, 1], convection(2, 1))[0] / alone - 1.5), .02)

    def test_of_convection_need_a_body_and_a_gas(self):
        for fluid, solid, message in ((0, 0, "found 0, expected a gas: 1 to 1"),
                                      (1, 1, "found 1, expected a body: 0 to 0")):
            done = run(self.scene(line([slab(6, 12)], [1], convection(fluid, solid))), options=("--check",))
            self.assertEqual(done.code, 3)
            self.assertIn(message, done.err)
        done = run(self.scene(line([slab(6, 12)], [1], (CLOSED, f"{CLOSED}{SWITCH}"))), options=("--check",))
        self.assertIn("missing tag <convective_fluid>: do_convective_heat_transfer is true", done.err)
        self.assertIn("missing tag <convective_solid>: do_convective_heat_transfer is true", done.err)

    def test_conserve_heat(self):
        for heat in (1, 100, 1e4, 1e15):
            for shift in (0, .25, .5):
                given, drift = self.heat_from([slab(6 + shift, 12 + shift)], [heat])
                self.assertGreater(given, 1e-4)
                self.assertLess(drift, 1e-14, (heat, shift))

    def test_conserve_heat_of_several_bodies(self):
        for heat in ([3, 5, 7], [1e15, 1e15, 1e15], [1e15, 0, 2]):
            drift = self.heat_from([slab(4, 8.5, temperature=1.5), slab(8.5, 12)], heat)[1]
            self.assertLess(drift, 1e-14, heat)


class Conduction(SceneTest):
    """The gas of lines conducts heat to bodies, beside what they exchange by coefficients, which hardly acts here."""

    def scene_of(self, bodies, conductivity):
        heat = [1e-9] * (len(bodies) * (len(bodies) + 1) // 2)
        text = line(bodies, heat)
        last = text.rindex("<thermal_conductivity>0<")
        return self.scene(text[:last] + text[last:].replace("<thermal_conductivity>0<",
                                                            f"<thermal_conductivity>{conductivity}<", 1))

    def test_conserves_heat(self):
        """Of a thick body, of two that share cells, and of one that is thinner than a cell."""
        for conductivity in (.25, 1e4):
            for bodies in ([slab(6.3, 12.7)], [slab(4, 8.5, temperature=1.5), slab(8.5, 12)], [slab(7.8, 8.3)]):
                found = globals_of(self.scene_of(bodies, conductivity), "GasHeatToBodies", "TotalEnergy",
                                   sets=("Time/max_Timesteps=400",))
                energies = [row[1] for row in found["TotalEnergy"]]
                self.assertLess(max(abs(one / energies[0] - 1) for one in energies), 1e-14)
                self.assertGreater(-found["GasHeatToBodies"][-1][1], 1e-5)

    def test_is_that_of_half_a_cell_of_gas_wherever_the_surface_is(self):
        """The first step: k A / (h / 2 of the gas in the cell or, if the cell is small, of it and its neighbour)."""
        for shift, layer in ((0, 1), (.25, .75), (.75, 1.25)):
            found = globals_of(self.scene_of([slab(6 + shift, 12 + shift)], .25), "GasHeatToBodies",
                               sets=("Time/max_Timesteps=1", "Time/delt_max=1e-6"))["GasHeatToBodies"]
            mirrored = {1: 1, .75: 1.25, 1.25: .75}[layer]  # at the other end of the body
            exact = .25 * found[-1][0] * (1 / (.5 * .05 * layer) + 1 / (.5 * .05 * mirrored))
            self.assertLess(abs(-found[-1][1] / exact - 1), 1e-3, shift)


class Bits(SceneTest, SameBitsTest):
    def test_of_conduction_are_the_same_on_any_layout(self):
        text = warm_discs(Image())
        last = text.rindex("<thermal_conductivity>0<")
        warm = text[last:].replace("<thermal_conductivity>0<", "<thermal_conductivity>.02<")
        scene = self.scene(text[:last] + warm)
        self.assert_same(scene, 30, ("[1,1,1]", "[4,3,1]", "[8,4,1]"), ranks=3)

    def test_are_the_same_on_any_layout(self):
        self.assert_same(self.scene(warm_discs(Image())), 30, ("[1,1,1]", "[4,3,1]", "[8,4,1]"), ranks=3)

    def test_of_convection_are_the_same_on_any_layout(self):
        scene = self.scene(changed(warm_discs(Image()), convection(2, 0)))
        self.assert_same(scene, 30, ("[1,1,1]", "[4,3,1]", "[8,4,1]"), ranks=3)


if __name__ == "__main__":
    unittest.main()
