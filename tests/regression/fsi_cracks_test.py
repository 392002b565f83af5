#!/usr/bin/env python3
"""Bodies that burn by DDT1, at their surfaces and in cracks: conservation, bitwise equal results on any layout, wrong
scenes."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import changed
from same_bits import SameBitsTest
from solids import RefusedSceneTest, SceneTest, archive_of, columns, globals_of
from sus import run

CRACKS, DISC = (fsi.scene(name).read_text() for name in ("burning_cracks", "lit_disc"))
HEAT, SPECIFIC = 3.418e6, 996  # of the reaction, J/kg, and of the body, J/(kg K)
NONE, SURFACE, IN_CRACKS, WAITING = range(4)
ELASTIC = ('<constitutive_model type="comp_neo_hook"><bulk_modulus>1e10</bulk_modulus>'
           "<shear_modulus>5e9</shear_modulus></constitutive_model>")


def with_model(text, model):
    """The scene with another constitutive model of its body."""
    start, end = text.index("<constitutive_model"), text.index("</constitutive_model>") + len("</constitutive_model>")
    return text[:start] + model + text[end:]


class Conservation(SceneTest):
    def assert_kept(self, text, temperature, steps):
        names = ("TotalMass", "GasMass", "GasEnergy", "GasWorkOnBodies", "BurntMass", "ReactionHeat")
        totals = globals_of(self.scene(text), *names, sets=(f"Time/max_Timesteps={steps}",))
        first, last = ({name: totals[name][k][1] for name in names} for k in (0, -1))
        burnt = last["BurntMass"]
        self.assertGreater(burnt, 1e-3 * first["GasMass"])
        self.assertAlmostEqual(last["TotalMass"] / first["TotalMass"], 1, delta=1e-14)
        self.assertAlmostEqual((last["GasMass"] - first["GasMass"]) / burnt, 1, delta=1e-10)
        self.assertAlmostEqual(last["ReactionHeat"] / (HEAT * burnt), 1, delta=1e-14)
        gained = last["GasEnergy"] - first["GasEnergy"] + last["GasWorkOnBodies"]
        # The body is warmer than at the start where its cracks grow, and brings its speed.
        self.assertAlmostEqual(gained / ((HEAT + SPECIFIC * temperature) * burnt), 1, delta=1e-4)

    def test_in_cracks_of_a_slab(self):
        self.assert_kept(CRACKS, 650, 200)

    def test_of_a_disc_that_a_flame_enters(self):
        self.assert_kept(DISC, 300, 300)


class Modes(SceneTest):
    def modes_at(self, text, *sets):
        scene = self.scene(text)
        found = columns(archive_of(scene, scene.parent, *sets), "c.burnMode")
        return [int(mode) for mode in found["c.burnMode [1]"]]

    def test_cracks_of_a_slab_burn_once_a_wave_has_loaded_them(self):
        # The wave goes 2300 m/s, 2.3 cells in a microsecond.
        for time, least, most in ("2e-7", 0, 2), ("5e-6", 9, 14):
            modes = self.modes_at(CRACKS, f"Time/maxTime={time}")
            self.assertEqual(modes.count(SURFACE), 1)
            self.assertTrue(least <= modes.count(IN_CRACKS) <= most, modes)

    def test_without_cracks_only_the_surface_burns(self):
        text = changed(CRACKS, ("<useCrackModel>true", "<useCrackModel>false"))
        self.assertEqual(set(self.modes_at(text)), {NONE, SURFACE})

    def test_a_flame_takes_its_time(self):
        self.assertEqual(set(self.modes_at(DISC, "Time/maxTime=1e-6")), {NONE, WAITING})
        self.assertIn(SURFACE, self.modes_at(DISC))

    def test_without_cracks_a_body_may_be_of_any_model(self):
        text = changed(with_model(CRACKS, ELASTIC), ("<useCrackModel>true", "<useCrackModel>false"))
        self.assertEqual(set(self.modes_at(text, "Time/maxTime=3e-6")), {NONE, SURFACE})


class Bits(SameBitsTest):
    def test_are_the_same_on_a_line(self):
        self.assert_same("burning_cracks", 120, ("[1,1,1]", "[7,1,1]", "[20,1,1]"), ranks=2)

    def test_are_the_same_in_a_plane(self):
        self.assert_same("lit_disc", 120, ("[1,1,1]", "[5,3,1]", "[2,4,1]"), ranks=2)


class WrongScenes(RefusedSceneTest):
    def test_cracks_need_a_model_that_has_them(self):
        self.assert_refused(with_model(CRACKS, ELASTIC),
                            "found 'comp_neo_hook', but useCrackModel needs a body of visco_scram, which has cracks")

    def test_bodies_that_keep_their_velocities_have_no_pressure(self):
        self.assert_refused(changed(CRACKS, ('type="mpmice"', 'type="rmpmice"')), "DDT1: is not available with rmpmice")

    def test_a_flame_needs_its_numbers(self):
        self.assert_refused(changed(DISC, ("<PreexpoConst>0.00259</PreexpoConst>", "")),
                            "missing tag <PreexpoConst> in <DDT1>")

    def test_a_detonation_ends_the_run(self):
        done = run(self.scene(CRACKS), "Models/Model/DDT1/ThresholdPressureJWL=1e5")
        self.assertEqual(done.code, 4, done.err)
        self.assertIn("the body detonates: its pressure is", done.err)


if __name__ == "__main__":
    unittest.main()
