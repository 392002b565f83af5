#!/usr/bin/env python3
"""Heat conduction in explicit solids: steps for which it is unstable are refused, with others temperatures stay between
those of the start."""
import math
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of, last_state
from sus import run

PLANES = "".join(f'<Face side="{axis}{end}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                 for axis in "xyz" for end in "-+")


def scene(interpolator, conductivity):
    """A bar of 1 m, whose left half is at 300 K and whose right half is at 400 K."""
    return f"""<?xml version="1.0"?><Uintah_specification><SimulationComponent type="mpm"/>
<Time><maxTime>.05</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>1</delt_max>
<timestep_multiplier>.9</timestep_multiplier></Time>
<Grid><Level><Box><lower>[0,0,0]</lower><upper>[1,.25,.125]</upper><resolution>[8,2,1]</resolution></Box></Level>
<BoundaryConditions>{PLANES}</BoundaryConditions></Grid>
<MPM><time_integrator>explicit</time_integrator><interpolator>{interpolator}</interpolator></MPM>
<MaterialProperties><MPM><material><density>1000</density><specific_heat>100</specific_heat>
<thermal_conductivity>{conductivity}</thermal_conductivity><constitutive_model type="comp_neo_hook">
<bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus></constitutive_model><geom_object>
<box><min>[0,0,0]</min><max>[1,.25,.125]</max></box><res>[2,2,1]</res><velocity>[0,0,0]</velocity>
<temperature>x &lt; .5 ? 300 : 400</temperature></geom_object></material></MPM></MaterialProperties>
<DataArchiver><filebase>o.uda</filebase><outputInterval>.05</outputInterval><save label="ThermalEnergy"/>
<save label="p.x"/><save label="p.temperature"/></DataArchiver></Uintah_specification>"""


class HeatInSolids(SceneTest):
    def test_steps_that_are_too_long_for_conduction_end_the_run(self):
        ended = run(self.scene(scene("gimp", 1e7)))
        self.assertEqual(ended.code, 4)
        self.assertIn("is too long for the heat conduction of", ended.err)
        self.assertIn("which is stable up to 7.813e-05 s", ended.err)
        self.assertIn("a delt_max of 7.03e-05 s, or DoExplicitHeatConduction false", ended.err)

    def test_temperatures_stay_between_those_of_the_start_with_shorter_ones(self):
        for interpolator in ("linear", "gimp", "cpdi", "3rdorderBS"):
            for conductivity, longest in ((1e6, 7.03e-4), (1e7, 7.03e-5)):
                with self.subTest(interpolator=interpolator, conductivity=conductivity):
                    text = self.scene(scene(interpolator, conductivity).replace(
                        "<delt_max>1<", f"<delt_max>{longest}<"))
                    temperature = last_state(text, "p.temperature")["p.temperature [K]"]
                    self.assertGreater(min(temperature), 300 - 1e-9)
                    self.assertLess(max(temperature), 400 + 1e-9)
                    energy = [line[1] for line in globals_of(text, "ThermalEnergy")["ThermalEnergy"]]
                    self.assertLess(max(energy) - min(energy), 1e-11 * energy[0])

    def test_a_jump_of_temperature_diffuses_as_it_must(self):
        """Until 29 November 2026, particles beside the jump kept an error of 33 % of it (two per cell and axis) or 42 %
        (four), with any number of cells, because the nodes that conduct see only the means of their particles."""
        for interpolator, errors in (("linear", (.25, .075)), ("gimp", (.25, .075)), ("cpdi", (.25, .075)),
                                     ("3rdorderBS", (.85, .17))):
            for resolution in (2, 4):
                for cells, error in zip((16, 32), errors):
                    with self.subTest(interpolator, resolution=resolution, cells=cells):
                        text = scene(interpolator, 1e5).replace("[2,2,1]</res>", f"[{resolution},1,1]</res>")
                        text = text.replace("[8,2,1]", f"[{cells},1,1]").replace(".25,.125", f"{1/cells},{1/cells}")
                        text = text.replace("<delt_max>1<", f"<delt_max>{.2/cells**2}<").replace(">.05<", ">.02<")
                        state = last_state(self.scene(text), "p.temperature")
                        for x, temperature in zip(state["x [m]"], state["p.temperature [K]"]):
                            self.assertAlmostEqual(float(temperature), self.diffused(float(x), .02), delta=error)

    @staticmethod
    def diffused(x, time):
        """The temperature [K] in the bar for k / (rho c) = 1 m²/s."""
        return 350 - sum(200 / (math.pi * m) * math.sin(m * math.pi / 2) * math.cos(m * math.pi * x) *
                         math.exp(-(m * math.pi) ** 2 * time) for m in range(1, 100, 2))

    def test_insulated_sides_pass_no_heat(self):
        """A Neumann condition with the value 0 is the natural one: the same bits as none, and no heat is lost."""
        insulated = '<BCType id="all" label="Temperature" var="Neumann"><value>0</value></BCType></Face>'
        for interpolator in ("linear", "gimp"):
            text = scene(interpolator, 1e5).replace("x &lt; .5 ? 300 : 400", "300 + 400 * x + 100 * y").replace(
                "<delt_max>1<", "<delt_max>7e-4<")
            with_condition = self.scene(text.replace("</Face>", insulated))
            states = [last_state(one, "p.temperature") for one in (self.scene(text), with_condition)]
            self.assertEqual(*(list(state["p.temperature [K]"]) for state in states))
            energy = [line[1] for line in globals_of(with_condition, "ThermalEnergy")["ThermalEnergy"]]
            self.assertLess(max(energy) - min(energy), 1e-11 * energy[0])

    def given(self, interpolator, conductivity, resolution, end):
        """Positions and temperatures at the end in a bar at 300 K whose left side has 500 K and whose right side has
        300 K; each particle stands for a column."""
        sides = PLANES
        for side, value in (("x-", 500), ("x+", 300)):
            sides = sides.replace(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>',
                                  f'<Face side="{side}"><BCType id="all" label="Temperature" var="Dirichlet"><value>'
                                  f'{value}</value></BCType></Face>')
        text = scene(interpolator, conductivity).replace(PLANES, sides).replace("x &lt; .5 ? 300 : 400", "300")
        text = text.replace("[2,2,1]</res>", f"[{resolution},2,1]</res>").replace("<delt_max>1<", "<delt_max>7e-4<")
        state = last_state(self.scene(text.replace(">.05<", f">{end}<")), "p.temperature")
        return [(float(x), float(t)) for x, t in zip(state["x [m]"], state["p.temperature [K]"])]

    def test_a_given_temperature_needs_a_specific_heat(self):
        """Without it, temperatures used to become not a number."""
        text = scene("gimp", 0).replace(
            '<Face side="x-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>',
            '<Face side="x-"><BCType id="all" label="Temperature" var="Dirichlet"><value>400</value></BCType></Face>')
        for heat, code in ((1, 0), (0, 3)):
            done = run(self.scene(re.sub("<specific_heat>.*?</specific_heat>", f"<specific_heat>{heat}</specific_heat>",
                                         text)), "Time/max_Timesteps=5")
            self.assertEqual(done.code, code, done.err)
        self.assertIn("missing tag <specific_heat>: a side of the grid has a given Temperature", done.err)

    def test_particles_follow_given_temperatures_without_overshoot(self):
        """Until 29 November 2026, particles beside the side reached 540 K with two particles per cell, 567 K with
        four, even without conduction."""
        for interpolator in ("linear", "gimp", "cpdi", "3rdorderBS"):
            for resolution in (1, 2, 4):
                for conductivity in (1e-6, 1e6):
                    for end in (7e-4, 2e-3, .05):  # after the first step, the third, and many
                        with self.subTest(interpolator, resolution=resolution, conductivity=conductivity, end=end):
                            values = [t for _, t in self.given(interpolator, conductivity, resolution, end)]
                            self.assertGreater(min(values), 300 - 1e-9)
                            self.assertLess(max(values), 500)

    def test_steady_temperatures_between_given_ones_are_exact(self):
        for interpolator in ("linear", "gimp", "cpdi"):
            for resolution in (1, 2, 4):
                with self.subTest(interpolator, resolution=resolution):
                    for x, temperature in self.given(interpolator, 1e6, resolution, 4):
                        self.assertAlmostEqual(temperature, 500 - 200 * x, delta=1e-5)

    @staticmethod
    def cut(text):
        """The same bar of two materials that touch at x = .5."""
        material = re.search("<material>.*</material>", text, re.S).group()
        halves = [material.replace("<max>[1,", "<max>[.5,"), material.replace("<min>[0,", "<min>[.5,")]
        return text.replace(material, "".join(halves) + "<contact><type>single_velocity</type></contact>"
                            "<thermal_contact/>")

    def test_two_bodies_in_thermal_contact_conduct_as_one(self):
        """Until 30 November 2026, particles beside the cut were off by 4 K in a steady state, and by more in shorter
        steps."""
        for interpolator in ("linear", "gimp", "cpdi"):
            for text in (scene(interpolator, 1e6), scene(interpolator, 1e5)):
                text = text.replace("<delt_max>1<", "<delt_max>7e-4<").replace(">.05<", ">.02<")
                states = [last_state(self.scene(one), "p.temperature") for one in (text, self.cut(text))]
                one, two = (sorted(zip(state["x [m]"], state["y [m]"], state["p.temperature [K]"])) for state in states)
                self.assertEqual(len(one), len(two))
                for whole, half in zip(one, two):
                    self.assertAlmostEqual(whole[2], half[2], delta=1e-9)
                energy = [line[1] for line in globals_of(self.scene(self.cut(text)), "ThermalEnergy")["ThermalEnergy"]]
                self.assertLess(max(energy) - min(energy), 1e-11 * energy[0])

    def test_thermal_contact_gives_no_heat_to_what_does_not_conduct(self):
        text = self.cut(scene("gimp", 1e5)).replace("<delt_max>1<", "<delt_max>7e-4<")
        text = text.replace("<thermal_conductivity>100000.0<", "<thermal_conductivity>0<", 1)
        for material, temperature in (("material0", 300), ("material1", 400)):
            state = last_state(self.scene(text), "p.temperature", material=material)
            for found in state["p.temperature [K]"]:
                self.assertAlmostEqual(float(found), temperature, delta=1e-9)

    def test_flows_of_heat_through_a_side_are_refused(self):
        flow = '<BCType id="all" label="Temperature" var="Neumann"><value>5</value></BCType></Face>'
        ended = run(self.scene(scene("gimp", 1e5).replace("</Face>", flow, 1)))
        self.assertEqual(ended.code, 3)
        self.assertIn("value: found '5'; solids take Neumann for Temperature only with 0", ended.err)

    def test_scenes_that_need_no_temperature_are_not_concerned(self):
        text = scene("gimp", 1e7).replace('<save label="ThermalEnergy"/>', "").replace(
            '<save label="p.temperature"/>', "")
        self.assertEqual(run(self.scene(text)).code, 0)


if __name__ == "__main__":
    unittest.main()
