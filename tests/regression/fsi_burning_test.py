#!/usr/bin/env python3
"""Burning bodies: rates against closed forms, conservation, bitwise equal results on any layout, wrong scenes."""
import math
import pathlib
import sys
import unittest

from scipy.optimize import brentq

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from same_bits import SameBitsTest
from solids import RefusedSceneTest, SceneTest, globals_of
from sus import run

SLAB, GRAIN, VESSEL = (fsi.scene(name).read_text() for name in ("burning_slab", "burning_grain", "burning_vessel"))
RIGID = ("SimulationComponent/@type=rmpmice",)
GONE = ("Models/Model/Simple_Burn/BurnCoeff=4", "Time/maxTime=3", "Grid/Level/Box/resolution=[20,20,1]",
        "Grid/Level/Box/upper=[1,1,0.05]")


class References(unittest.TestCase):
    """Tests errors against bounds 1.5 times the values in ups/fsi/README.md."""

    def assert_within(self, errors, limit, *names):
        for name in names:
            self.assertLess(abs(errors[name]), limit, errors)

    def test_a_slab_recedes_at_its_rate(self):
        self.assert_within(fsi.burning_slab(50), 1.5 * 1.2e-4, "way")

    def test_the_pressure_of_a_closed_vessel_rises_as_it_must(self):
        errors = fsi.burning_vessel(50)
        self.assert_within(errors, 1.5 * 5.0e-4, "burnt", "p")
        self.assert_within(errors, 1e-14, "mass", "energy")


class Conservation(SceneTest):
    def assert_kept(self, errors):
        for name in ("mass", "mass of air", "energy"):
            self.assertLess(errors[name], 1e-14, errors)

    def test_a_grain_that_does_not_move_keeps_mass_and_energy(self):
        errors = fsi.burning_grain(25, RIGID)
        self.assert_kept(errors)
        self.assertGreater(errors["burnt"], .03)

    def test_a_grain_that_moves_loses_what_its_particles_own_update_does(self):
        errors = fsi.burning_grain(25)
        self.assertLess(errors["energy"], 1.5 * 2.3e-6)
        self.assert_kept(errors | {"energy": 0})

    def test_a_grain_burns_until_nothing_is_left_of_it(self):
        errors = fsi.burning_grain(20, (*RIGID, *GONE))
        self.assert_kept(errors)
        self.assertAlmostEqual(errors["burnt"], 1, delta=1e-12)
        done = run(fsi.scene("burning_grain"), *RIGID, *GONE, options=("--quiet",))
        self.assertEqual(done.report["particles"], 0)

    def test_a_part_of_a_body_becomes_gas_per_time(self):
        model = "<Test><fromMaterial>reactant</fromMaterial><toMaterial>product</toMaterial><rate>0.3</rate></Test>"
        start, _, end = GRAIN.partition('<Model type="Simple_Burn">')
        text = start + '<Model type="Test">' + model + end[end.index("</Simple_Burn>") + len("</Simple_Burn>"):]
        totals = globals_of(self.scene(text), "BurntMass", "TotalMass", "GasMass", sets=("Time/maxTime=0.5", *RIGID))
        before = totals["TotalMass"][0][1] - totals["GasMass"][0][1]
        older = text.replace("<Test>", "").replace("</Test>", "")  # without a section of its own
        prints = {run(self.scene(one), "Time/max_Timesteps=3", *RIGID).report["fingerprint"] for one in (text, older)}
        self.assertEqual(len(prints), 1)
        # Each step takes .3 dt of what is left; steps are less than 1e-2.
        self.assertAlmostEqual(totals["BurntMass"][-1][1] / before, 1 - 2.718281828459045 ** -.15, delta=1e-3)


# A slab of temperature 1 burns at about .02 under pressure 1; see SteadyBurn in components/ice/burn_model.hpp.
STEADY = {"IdealGasConst": 1, "PreExpCondPh": .03, "ActEnergyCondPh": 5, "PreExpGasPh": .08, "CondPhaseHeat": .2,
          "GasPhaseHeat": 1.8, "HeatConductGasPh": .01, "HeatConductCondPh": .01, "SpecificHeatBoth": 1,
          "MoleWeightGasPh": 1}


def reaction(surface, density):
    """Returns m^2 c (T_s - T_0 - Q_c / (2 c)) of a steady deflagration."""
    gas, factor, energy, k = (STEADY[name] for name in ("IdealGasConst", "PreExpCondPh", "ActEnergyCondPh",
                                                        "HeatConductCondPh"))
    return factor * gas * k * density * surface ** 2 * math.exp(-energy / (gas * surface)) / energy


def steady(pressure, temperature, density):
    """Returns surface temperature and rate that satisfy both equations of Ward, Son and Brewster."""
    gas, _, _, far, low, high, k_gas, _, c, molar = STEADY.values()

    def rate(surface):
        return math.sqrt(reaction(surface, density) / (c * (surface - temperature - low / (2 * c))))

    def excess(surface):
        m = rate(surface)
        x = 2 * k_gas / (c * (math.sqrt(m * m + 4 * k_gas * far * (molar * pressure) ** 2 / (c * gas ** 2)) - m))
        return surface - temperature - low / c - high / c / (1 + x * m * c / k_gas)

    surface = brentq(excess, temperature + low / c + 1e-9, temperature + (low + high) / c, xtol=1e-14)
    return surface, rate(surface)


UNSTEADY = STEADY | {"CondUnsteadyCoef": .01, "GasUnsteadyCoef": .25, "BurnrateModCoef": 1}


def burnt_unsteadily(time, steps=4000):
    """Returns the mass that has burned in burning_vessel [kg], by the equations of UnsteadyBurn in
    components/ice/burn_model.hpp."""
    k, c, low, high = (STEADY[name] for name in ("HeatConductCondPh", "SpecificHeatBoth", "CondPhaseHeat",
                                                 "GasPhaseHeat"))
    temperature, density, dt = 1, 20, time / steps
    surface, m = steady(1, temperature, density)
    gradient, burnt = m * c * (surface - temperature) / k, 0
    for _ in range(steps):
        pressure = .4 * (1.25 + (low + high + c * temperature) * burnt) / (.5 + burnt / density)
        hot, m = steady(pressure, temperature, density)
        steep, delay = m * c * (hot - temperature) / k, UNSTEADY["CondUnsteadyCoef"] * k * density / (c * m * m)
        gradient = steep + (gradient - steep) * math.exp(-dt / delay)
        surface = hot + (surface - hot) * math.exp(-dt / (UNSTEADY["GasUnsteadyCoef"] * delay))
        flow, reacts = k * gradient, reaction(surface, density)
        burnt += dt * 2 * reacts / (flow + math.sqrt(flow * flow - 2 * low * reacts))
    return burnt


def with_model(text, name, tags):
    """Returns the scene with another burn model."""
    start, end = text.index("<Model type"), text.index("</Models>")
    numbers = "".join(f"<{tag}>{value}</{tag}>" for tag, value in tags.items())
    return (f'{text[:start]}<Model type="{name}"><{name}><fromMaterial>reactant</fromMaterial>'
            f"<toMaterial>product</toMaterial>{numbers}<ThresholdPressure>0.1</ThresholdPressure>"
            f"<IgnitionTemp>0.5</IgnitionTemp></{name}></Model>{text[end:]}")


class Ignition(SceneTest):
    def burnt(self, text, *sets):
        return globals_of(self.scene(text), "BurntMass", sets=sets)["BurntMass"]

    def test_takes_a_hot_neighbour_and_pressure(self):
        model = "Models/Model/Simple_Burn/"
        self.assertGreater(self.burnt(SLAB, "Time/maxTime=1")[-1][1], .01)
        for threshold in ("ThresholdTemp=1.5", "ThresholdPressure=1.5"):
            self.assertEqual(self.burnt(SLAB, "Time/maxTime=1", model + threshold)[-1][1], 0, threshold)

    def test_of_a_hot_gas_sets_a_cold_body_on_fire(self):
        body, gas = SLAB.split("<ICE>\n      <material")
        hot = gas.replace("<temperature>1<", "<temperature>2<", 1)
        burnt = self.burnt(f"{body}<ICE>\n      <material{hot}", "Time/maxTime=1",
                           "Models/Model/Simple_Burn/ThresholdTemp=1.5")
        self.assertGreater(burnt[-1][1], .01)

    def test_of_a_steady_deflagration_is_as_fast_as_its_source_says(self):
        rows = self.burnt(with_model(SLAB, "Steady_Burn", STEADY), "Time/maxTime=40")
        half = next(row for row in rows if row[0] > 20)
        rate = (rows[-1][1] - half[1]) / (rows[-1][0] - half[0])
        self.assertAlmostEqual(rate / steady(1, 1, 20)[1], 1, delta=2e-3)


class Unsteady(SceneTest):
    def burnt(self, text, model, tags, time):
        scene = self.scene(with_model(text, model, tags))
        return globals_of(scene, "BurntMass", sets=(f"Time/maxTime={time}",))["BurntMass"][-1][1]

    def test_burning_at_constant_pressure_is_steady(self):
        still = self.burnt(SLAB, "Steady_Burn", STEADY, 40)
        self.assertAlmostEqual(self.burnt(SLAB, "Unsteady_Burn", UNSTEADY, 40) / still, 1, delta=2e-4)

    def test_burning_overshoots_where_the_pressure_rises(self):
        mass = self.burnt(VESSEL, "Unsteady_Burn", UNSTEADY, 20)
        self.assertAlmostEqual(mass / burnt_unsteadily(20), 1, delta=2e-3)
        self.assertGreater(mass / self.burnt(VESSEL, "Steady_Burn", STEADY, 20), 1.04)

    def test_burning_of_a_grain_keeps_mass_and_energy(self):
        names = ("TotalMass", "GasEnergy", "ThermalEnergy", "ReactionHeat", "BurntMass")
        totals = globals_of(self.scene(with_model(GRAIN, "Unsteady_Burn", UNSTEADY)), *names,
                            sets=(*RIGID, "Time/maxTime=.5", *fsi.resolution("burning_grain", 25)))
        self.assertGreater(totals["BurntMass"][-1][1], 1e-4)
        first, last = ({name: totals[name][k][1] for name in names} for k in (0, -1))
        self.assertAlmostEqual(last["TotalMass"] / first["TotalMass"], 1, delta=1e-14)
        energies = [one["GasEnergy"] + one["ThermalEnergy"] - one["ReactionHeat"] for one in (first, last)]
        self.assertAlmostEqual(energies[1] / energies[0], 1, delta=1e-14)


class Bits(SameBitsTest, SceneTest):
    def test_are_the_same_on_a_line(self):
        self.assert_same("burning_slab", 400, ("[1,1,1]", "[7,1,1]", "[50,1,1]"),
                         "Models/Model/Simple_Burn/BurnCoeff=10", ranks=1)

    def test_are_the_same_in_a_plane(self):
        self.assert_same("burning_grain", 60, ("[1,1,1]", "[5,3,1]", "[20,4,1]"),
                         "Models/Model/Simple_Burn/BurnCoeff=10", ranks=3)

    def test_are_the_same_where_surfaces_remember(self):
        grain = self.scene(with_model(GRAIN, "Unsteady_Burn", UNSTEADY | {"PreExpCondPh": .3}))
        self.assert_same(grain, 60, ("[1,1,1]", "[5,3,1]", "[20,4,1]"), ranks=3)


class WrongScenes(RefusedSceneTest):
    def test_names_of_materials(self):
        self.assert_refused(SLAB.replace("<fromMaterial>reactant", "<fromMaterial>wood"), "'wood'")
        self.assert_refused(SLAB.replace("<toMaterial>product", "<toMaterial>smoke"), "'smoke'")

    def test_bodies_and_gases_are_not_mixed_up(self):
        self.assert_refused(SLAB.replace("<fromMaterial>reactant", "<fromMaterial>product"),
                            "fromMaterial: found 'product', which is a gas, expected a body")
        self.assert_refused(SLAB.replace("<toMaterial>product", "<toMaterial>reactant"),
                            "toMaterial: found 'reactant', which is a body, expected a gas")

    def test_what_would_change_the_rate(self):
        self.assert_refused(SLAB.replace("<ICE>", "<ICE>\n<thin_walls>true</thin_walls>", 1),
                            "ICE/thin_walls: is not available with a burning body")

    def test_steps_are_explicit_whatever_the_scene_says(self):
        implicit = SLAB.replace("<ICE>", "<ICE>\n<ImplicitSolver/>", 1)
        done = run(self.scene(implicit), options=("--check",))
        self.assertIn("ICE/ImplicitSolver: does nothing: with a burning body, steps are explicit", done.out + done.err)
        prints = {run(self.scene(text), "Time/max_Timesteps=5").report["fingerprint"] for text in (SLAB, implicit)}
        self.assertEqual(len(prints), 1)

    def test_what_burns_has_a_specific_heat(self):
        self.assert_refused(SLAB.replace("<specific_heat>1</specific_heat>", ""),
                            "missing tag <specific_heat>: the body burns")

    def test_a_model_that_is_not_there(self):
        self.assert_refused(SLAB.replace("Simple_Burn", "Complex_Burn"), "the type 'Complex_Burn' is not available")

    def test_one_body_burns(self):
        model = SLAB[SLAB.index("    <Model "):SLAB.index("  </Models>")]
        self.assert_refused(SLAB.replace(model, 2 * model), "only one body of a scene can burn")


if __name__ == "__main__":
    unittest.main()
