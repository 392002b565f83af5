#!/usr/bin/env python3
"""Gases with laws of their own that share cells, and JWL++: contacts, exact solutions, conservation, equal bits."""
import math
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import LIGHT, ConservationTest, also, changed, rigid
from same_bits import SameBitsTest
from solids import RefusedSceneTest, globals_of
from sus import ROOT, run

DRIFT, IMPACT, DETONATION = (ROOT / f"ups/ice/{name}.ups"
                             for name in ("explosive_drifts", "explosive_impact", "detonation"))
CONTACT = fsi.scene("contact_of_gases").read_text()
JWL = '<EOS type="JWL"><A>300</A><B>2</B><R1>5</R1><R2>1.5</R2><om>0.4</om><rho0>1</rho0></EOS>'
JWLC = re.search(r'<EOS type="JWLC">.*?</EOS>', DETONATION.read_text(), re.S).group()
# A body between JWL's products and a gas; heat flows between all three.
BESIDE = changed(CONTACT, ("<heat>[0, 0, 0]", "<heat>[50, 20, 1e15]"), ("<temperature>10<", "<temperature>30<"),
                 ("</constitutive_model>", "</constitutive_model><specific_heat>1</specific_heat>"
                                           "<thermal_conductivity>0</thermal_conductivity>"),
                 ("<res>[4,1,1]</res>", "<res>[4,1,1]</res><temperature>5</temperature>"))
BESIDE = BESIDE.replace('<EOS type="ideal_gas"/>', JWL, 1)
WATER = ('<EOS type="Thomsen_Hartka_water"><a>2e-7</a><b>2.6</b><co>4205.7</co><ko>5e-10</ko><To>277</To><L>8e-6</L>'
         "<vo>1.00008e-3</vo></EOS>")
MURNAGHAN = re.search(r'<EOS type="Murnaghan">.*?</EOS>', DETONATION.read_text(), re.S).group()


def measuring(text, variable, value):
    module = f'<DataAnalysis><Module name="exactSolution">{variable}<value>{value}</value></Module></DataAnalysis>'
    return changed(text, ("</Uintah_specification>", module + "</Uintah_specification>"))


# Water at 300 K and 1 atm in place of the explosive.
DRIFTING_WATER = changed(DRIFT.read_text(), (MURNAGHAN, WATER), ("<specific_heat>1500<", "<specific_heat>4145<"),
                         ("<density>1160<", "<density>995.7490146145051<"))


class Contacts(RefusedSceneTest):
    def greatest(self, variable, value, *sets, text=DRIFT.read_text()):
        report = run(self.scene(measuring(text, variable, value)), "Time/maxTime=0.001", *sets).report
        return next(iter(report["errors"].values()))["cell"]["max"]

    def test_of_an_explosive_and_air_stay_quiet(self):
        for order in ("FirstOrder", "SecondOrder"):
            sets = (f"CFD/ICE/advection/@type={order}",)
            self.assertLess(self.greatest("<label>c.pressure</label>", 101325, *sets), 1e-5)
            self.assertLess(self.greatest("<label>c.velocity</label><component>x</component>", 100, *sets), 1e-10)
            self.assertLess(self.greatest("<label>c.temperature</label>", 300, *sets), 1e-8)

    def test_of_water_and_air_stay_quiet(self):
        for order in ("FirstOrder", "SecondOrder"):
            sets = (f"CFD/ICE/advection/@type={order}",)
            self.assertLess(self.greatest("<label>c.pressure</label>", 101325, *sets, text=DRIFTING_WATER), 1e-5)
            self.assertLess(self.greatest("<label>c.temperature</label>", 300, *sets, text=DRIFTING_WATER), 1e-9)

    def test_keep_mass_momentum_and_energy(self):
        for scene in (DRIFT, self.scene(DRIFTING_WATER)):
            drift = run(scene, "Time/maxTime=0.001").report["drift"]
            for name in ("mass", "momentum", "energy"):
                self.assertLess(abs(drift[name]), 1e-13, name)


class Heat(RefusedSceneTest):
    def test_is_given_by_mass(self):
        """Each gas gets its rate [W/kg]; the gases of a cell share what they get, since they have one temperature."""
        names = ("TotalMass-explosive", "TotalMass-air", "TotalEnergy")
        tags = ("<add_heat_matls>[0,1]</add_heat_matls><add_heat_coeff>[2e7,5e8]</add_heat_coeff>"
                "<add_heat_t_start>0</add_heat_t_start><add_heat_t_final>1</add_heat_t_final>")
        text = changed(DRIFT.read_text(), ('<advection type="SecondOrder"/>',
                                           f'<advection type="SecondOrder"/><ADD_HEAT>{tags}</ADD_HEAT>'),
                       ('<save label="TotalIntEng"/>', "".join(f'<save label="{name}"/>' for name in names)))
        found = globals_of(self.scene(text), *names,
                           sets=("Time/maxTime=2e-4", "Grid/Level/Box/resolution=[16,16,1]"))
        time, energy = found["TotalEnergy"][-1][0], [row[1] for row in found["TotalEnergy"]]
        gained = time * (2e7 * found["TotalMass-explosive"][0][1] + 5e8 * found["TotalMass-air"][0][1])
        self.assertGreater(gained, .005 * energy[0])
        self.assertAlmostEqual((energy[-1] - energy[0]) / gained, 1, delta=1e-10)


class Impact(unittest.TestCase):
    def mean_error(self, cells):
        report = run(IMPACT, f"Grid/Level/Box/resolution=[{cells},1,1]").report
        return report["errors"]["pressure"]["cell"]["L1"]

    def test_of_an_explosive_on_products_converges_to_two_shocks(self):
        coarse, fine = self.mean_error(200), self.mean_error(800)
        self.assertLess(fine, 3.2e6)
        self.assertGreater(coarse / fine, 3)


class Burning(RefusedSceneTest):
    # The curve of the products touches the line from the explosive's state in the plane of p and v.
    CHAPMAN_JOUGUET = 5899.279  # m/s

    def test_runs_at_the_speed_of_chapman_and_jouguet(self):
        mass = globals_of(DETONATION, "TotalMass-products")["TotalMass-products"]
        (t0, m0), (t1, m1) = (min(mass, key=lambda row: abs(row[0] - time)) for time in (7e-5, 1.15e-4))
        self.assertAlmostEqual((m1 - m0) / (t1 - t0) / 1160 / self.CHAPMAN_JOUGUET, 1, delta=.002)

    def test_has_the_rate_of_the_law(self):
        """Both gases have one law, and a pressure that depends on the density alone: it stays as it is."""
        density, factor, time = 1300, 1e-9, 1e-4
        text = DETONATION.read_text()
        text = re.sub(r'<material name="air">.*?</material>', "", text, flags=re.S)
        text = changed(text, (MURNAGHAN, JWLC), ("<density>1160<", f"<density>{density}<"), ("[0.9,1,1]", "[1,1,1]"),
                       ("3.5083e-7", str(factor)), ("[1e15, 1e15, 1e15]", "[1e15]"))
        rows = globals_of(self.scene(text), "TotalMass-products", sets=(f"Time/maxTime={time}",
                          "Grid/Level/Box/resolution=[20,1,1]"))["TotalMass-products"]
        volume = 1160 / density
        pressure = (2.9867e11 * math.exp(-4.95 * volume) + 4.11706e9 * math.exp(-1.15 * volume)
                    + 7.206147e8 * volume**-1.35)
        rate = factor * pressure**1.3
        left = (density - rows[-1][1]) / (density - rows[0][1])
        self.assertAlmostEqual(left / math.exp(-rate * time), 1, delta=1e-9)
        self.assertLess(left, .9)

    def test_adds_its_heat(self):
        sets = ("Time/maxTime=4e-5", "Grid/Level/Box/resolution=[100,1,1]")
        text = changed(DETONATION.read_text(), ('<save label="TotalIntEng"/>', '<save label="TotalEnergy"/>'),
                       ('<Face side="x-">', '<Face side="x+"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                                            '<Face side="x-">'))
        found = globals_of(self.scene(text), "TotalMass-products", "TotalEnergy", sets=sets)
        mass, energy = found["TotalMass-products"], found["TotalEnergy"]
        gained, heat = energy[-1][1] - energy[0][1], 5.558e6 * (mass[-1][1] - mass[0][1])
        self.assertAlmostEqual(gained / heat, 1, delta=1e-12)

    def test_needs_gases_at_one_temperature(self):
        text = changed(DETONATION.read_text(), ("<heat>[1e15, 1e15, 1e15]", "<heat>[1e15, 5, 1e15]"))
        self.assert_refused(text, "5 between gases is not available")


class Conservation(ConservationTest):
    def test_of_a_rigid_body_between_products_and_another_gas(self):
        text = changed(also(rigid(BESIDE), *self.KEPT), LIGHT, ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept(text, "Time/maxTime=0.5")


class Bits(SameBitsTest):
    def test_are_the_same_on_any_patches(self):
        self.assert_same(DETONATION, 60, ("[1,1,1]", "[7,1,1]", "[20,1,1]"), "Grid/Level/Box/resolution=[100,1,1]",
                         ranks=2)

    def test_are_the_same_in_a_plane(self):
        self.assert_same(DRIFT, 20, ("[1,1,1]", "[3,2,1]", "[4,4,1]"), ranks=3)

    def test_are_the_same_beside_a_body(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(BESIDE)
            self.assert_same(scene, 100, ("[1,1,1]", "[7,1,1]", "[25,1,1]"), ranks=2)


if __name__ == "__main__":
    unittest.main()
