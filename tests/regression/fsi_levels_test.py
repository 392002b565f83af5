#!/usr/bin/env python3
"""Gas and bodies on grids of several levels: the finest level follows bodies; conservation between levels."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_gases_test import CONTACT as GASES
from fsi_test import DISC, LIGHT, ConservationTest, also, changed, saving
from solids import SceneTest, archive_of, columns, globals_of
from sus import bits_of, run
from uda import FolderTest

END = "</Uintah_specification>"
LEVELS = """<AMR><Regridder><max_levels>2</max_levels><cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>
<min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>"""
SIZE = (*fsi.resolution("carried_disc", 64),)
WAVES = (("<temperature>5<", "<temperature>15<"), LIGHT, ("<reference_pressure>1<", "<reference_pressure>0<"))


def refined(text):
    return changed(text, (END, LEVELS + END))


class Conservation(ConservationTest):
    def assert_kept_on_levels(self, text, *sets):
        """Asserts conservation, except for the body's strain energy, which is not summed; the gas loses what the body
        gains."""
        names = ("GasEnergy", "GasWorkOnBodies")
        self.assert_kept(refined(saving(text, *self.KEPT)), *sets, elastic=True)
        found = globals_of(self.scene(refined(saving(text, *names))), *names, sets=sets)
        sums = [energy[1] + work[1] for energy, work in zip(*found.values())]
        self.assertLess(max(abs(one / sums[0] - 1) for one in sums), 1e-12)

    def test_of_a_disc_between_waves(self):
        self.assert_kept_on_levels(changed(DISC, *WAVES), *SIZE, "Time/maxTime=0.02")

    def test_of_two_gases_and_a_body(self):
        text = changed(GASES, LIGHT, ("<temperature>10<", "<temperature>30<"),
                       ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept_on_levels(text, "Grid/Level/Box/resolution=[80,1,1]", "Time/maxTime=0.3")

    def test_of_a_disc_in_viscous_gas(self):
        self.assert_kept_on_levels(changed(DISC, *WAVES, ("<dynamic_viscosity>0", "<dynamic_viscosity>0.01"),
                                           ("<thermal_conductivity>0", "<thermal_conductivity>0.03")),
                                   *SIZE, "Time/maxTime=0.01")


class Levels(SceneTest):
    FIELDS = ("c.pressure", "c.velocity", "c.density", "c.freeVolume")

    def test_leave_what_moves_alike_as_it_is(self):
        scene = self.scene(refined(DISC))
        found = columns(archive_of(scene, scene.parent, *SIZE, "Time/maxTime=0.02"), *self.FIELDS)
        held = zip(found["c.freeVolume [1]"], found["c.density [kg/m^3]"])
        gas = [k for k, (free, mass) in enumerate(held) if free >= 1e-9 and mass > 0]
        for column, value in (("c.pressure [Pa]", 1), ("c.velocity.x [m/s]", 1), ("c.velocity.y [m/s]", .618)):
            self.assertLess(max(abs(found[column][k] - value) for k in gas), 1e-11, column)

    def test_are_fewer_cells_than_a_fine_grid(self):
        report = run(self.scene(refined(DISC)), *SIZE, "Time/max_Timesteps=20").report
        coarse, fine = report["levels"]
        self.assertLess(coarse + fine, .7 * 128 * 128)

    def test_that_stay_must_reach_beyond_bodies(self):
        level = """<Level><Box label="fine"><lower>[0.25,0.25,0]</lower><upper>[0.75,0.75,0.015625]</upper>
            <resolution>[64,64,1]</resolution></Box></Level>"""
        blocks = "<AMR><Regridder><min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>"
        still = changed(DISC, ("[50,50,1]", "[64,64,1]"), ("[1,1,0.02]", "[1,1,0.015625]"),
                        ("</Level>", "</Level>" + level), (END, blocks + END))
        done = run(self.scene(still), "Time/maxTime=0.3")
        self.assertNotEqual(done.code, 0)
        self.assertIn("not on the finest level", done.err)


class Shares(SceneTest):
    """Several gases on several levels: each gas is interpolated separately between levels."""

    def test_add_up_to_one(self):
        text = changed(GASES, LIGHT, ("<temperature>10<", "<temperature>30<"),
                       ("<reference_pressure>1<", "<reference_pressure>0<"))
        names = ("c.shareOfGas0", "c.shareOfGas1", "c.density")
        scene = self.scene(also(refined(text), *names))
        archive = archive_of(scene, scene.parent, "Grid/Level/Box/resolution=[80,1,1]", "Time/maxTime=0.3")
        found = columns(archive, *names)
        shares = zip(found["c.shareOfGas0 [1]"], found["c.shareOfGas1 [1]"], found["c.density [kg/m^3]"])
        sums = [a + b for a, b, mass in shares if mass > 0]
        self.assertGreater(len(sums), 80)
        self.assertLess(max(abs(one - 1) for one in sums), 1e-12)


SPHERES = '<EOS type="hard_sphere_gas"><b>0.3</b></EOS>'
# Two gases with one temperature and one pressure that move alike with a body; one is of hard spheres.
QUIET = changed(GASES.replace('<EOS type="ideal_gas"/>', SPHERES, 1), ("<density>1<", "<density>1/1.3<"),
                ("<density>0.1<", "<density>1<"), ("<temperature>10<", "<temperature>1<"),
                ("<heat>[0, 0, 0]", "<heat>[0, 0, 1e15]"), ("<velocity>[1,0,0]", "<velocity>[0.2,0,0]"),
                ("</constitutive_model>", "</constitutive_model><specific_heat>1</specific_heat>"))
COARSE = "Grid/Level/Box/resolution=[80,1,1]"


def burning_grain():
    """Returns a grain that burns between two gases, one of hard spheres, on two levels, and its overrides."""
    text = fsi.scene("burning_grain").read_text()
    start = text.index('<material name="product"')
    text = text[:start] + text[start:].replace('<EOS type="ideal_gas"/>', SPHERES, 1)
    return refined(changed(text, ("<heat>[0,0,0]", "<heat>[0,0,1e15]"))), (
        "SimulationComponent/@type=rmpmice", *fsi.resolution("burning_grain", 32),
        "Models/Model/Simple_Burn/BurnCoeff=1")


class OwnLaws(SceneTest):
    """Gases with laws of their own beside bodies, on several levels."""

    def test_leave_what_moves_alike_as_it_is(self):
        names = ("c.pressure", "c.velocity", "c.temperature", "c.density", "c.freeVolume")
        for text, sets in ((QUIET, ()), (refined(QUIET), (COARSE,))):
            scene = self.scene(also(text, *names))
            found = columns(archive_of(scene, scene.parent, *sets), *names)
            held = zip(found["c.freeVolume [1]"], found["c.density [kg/m^3]"])
            gas = [k for k, (free, mass) in enumerate(held) if free >= 1e-9 and mass > 0]
            self.assertGreater(len(gas), 80)
            for column, value in (("c.pressure [Pa]", 1), ("c.velocity.x [m/s]", .2), ("c.temperature [K]", 1)):
                self.assertLess(max(abs(found[column][k] - value) for k in gas), 1e-11, column)

    def assert_kept(self, text, masses, energies, *sets):
        """Asserts that masses and the sum of energies are conserved; energies with a minus are subtracted."""
        names = (*masses, *(name.lstrip("-") for name in energies))
        totals = globals_of(self.scene(also(text, *names)), *names, sets=sets)
        for name in masses:
            start = totals[name][0][1]
            self.assertLess(max(abs(row[1] / start - 1) for row in totals[name]), 1e-13, name)
        parts = [[(-1 if name.startswith("-") else 1) * row[1] for row in totals[name.lstrip("-")]]
                 for name in energies]
        sums = [sum(row) for row in zip(*parts)]
        self.assertLess(max(abs(one / sums[0] - 1) for one in sums), 1e-13)
        return totals

    def test_keep_masses_and_energy_in_waves(self):
        text = changed(QUIET, LIGHT, ("<density>1<", "<density>3<"),
                       ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept(refined(text), ("TotalMass-air", "TotalMass-helium"), ("GasEnergy", "GasWorkOnBodies"), COARSE,
                         "Time/maxTime=0.3")

    def test_keep_masses_and_energy_around_a_burning_grain(self):
        text, sets = burning_grain()
        totals = self.assert_kept(text, ("TotalMass", "TotalMass-air"), ("GasEnergy", "ThermalEnergy", "-ReactionHeat"),
                                  *sets, "Time/maxTime=0.1")
        self.assertGreater(totals["ReactionHeat"][-1][1], .005)


class Bits(SceneTest, FolderTest):
    def test_are_the_same_with_gases_of_their_own_laws(self):
        text, sets = burning_grain()
        self.assert_same(self.scene(text), *sets, "Time/max_Timesteps=25", steps=25)

    def test_are_the_same_on_any_layout_and_after_a_restart(self):
        self.assert_same(self.scene(refined(changed(DISC, *WAVES))), *SIZE, "Time/max_Timesteps=12", steps=12)

    def assert_same(self, scene, *sets, steps):
        expected = bits_of(run(scene, *sets).report)
        for options in (("-layout", "1x1x1"), ("-layout", "4x2x1", "-nthreads", "2")):
            self.assertEqual(bits_of(run(scene, *sets, options=options).report), expected, options)
        self.assertEqual(bits_of(run(scene, *sets, ranks=2).report), expected)
        self.assertEqual(self.bits_of_two_parts(scene, steps, *sets), expected)


if __name__ == "__main__":
    unittest.main()
