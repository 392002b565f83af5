#!/usr/bin/env python3
"""Gas and bodies on one grid: exactness, errors, conservation, bitwise equal results on any layout, wrong scenes."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from gas_and_bodies import DISC, LIGHT, PLUG, RESTING, VISCOUS, changed
from solids import RefusedSceneTest, SceneTest, archive_of, columns, globals_of
from sus import run
from uda import Folder

CONTACT, BALL = (fsi.scene(name).read_text() for name in ("contact", "ball"))
TOTALS = ("TotalMass", "TotalMomentum", "KineticEnergy", "GasMass", "GasMomentum", "GasEnergy", "GasKineticEnergy")


def rigid(text):
    return re.sub(r'(<material name="(?:body|disc)">)',
                  r"\1<is_force_transmitting_material>true</is_force_transmitting_material>", text)


def saving(text, *names):
    saves = "".join(f'<save label="{name}"/>' for name in names)
    return text.replace('<save label="GasEnergy"/>', saves)


def also(text, *names):
    """Returns a scene that also saves the given variables, if it does not yet."""
    return saving(text, "GasEnergy", *(name for name in names if f'label="{name}"' not in text))


class Exactness(unittest.TestCase):
    def assert_exact(self, errors):
        for name, error in errors.items():
            self.assertLess(error, 1e-11, name)

    def test_a_disc_at_rest_stays_at_rest(self):
        self.assert_exact(fsi.rest(50))

    def test_a_body_and_gases_that_move_alike_go_on_as_they_are(self):
        self.assert_exact(fsi.contact(50))
        self.assert_exact(fsi.contact(100))

    def test_a_disc_and_gases_that_move_alike_go_on_as_they_are(self):
        self.assert_exact(fsi.carried_disc(25))


class References(unittest.TestCase):
    """Half as much again as the table of ups/fsi/README.md. Where an error changes its sign from width to width, so
    that the table has it small by chance, the limit is half as much again as the next coarser width has."""

    def assert_within(self, errors, **most):
        for name, limit in most.items():
            self.assertLess(abs(errors[name]), limit, errors)

    def test_a_piston_that_gas_drives(self):
        self.assert_within(fsi.gun(150), v=1.5 * 2.2e-6, x=1.5 * 3.5e-6, energy=1e-14)

    def test_a_plug_between_two_pressures(self):
        self.assert_within(fsi.plug(100), v=1.5 * 1.2e-5, x=1.5 * 2.5e-5, energy=1e-14)

    def test_a_plate_in_a_shock_tube(self):
        self.assert_within(fsi.sod_plate(206), v=1.5 * 3.3e-4, x=1.5 * 7.5e-5, energy=1e-14)

    def test_errors_fall_with_the_width_of_cells(self):
        coarse, fine = fsi.gun(75), fsi.gun(300)
        for name in ("v", "x"):
            self.assertLess(abs(fine[name]), .1 * abs(coarse[name]))  # of second order: a sixteenth

    def test_a_shock_on_an_elastic_wall(self):
        self.assert_within(fsi.elastic_wall(100), gas=1.5 * 3.5e-3, stress=1.5 * 5.2e-3, v=1.5 * 4.8e-3)
        self.assert_within(fsi.elastic_wall(200), stress=1.5 * 2e-4, v=1.5 * 7e-4)

    def test_a_piston_of_given_speed(self):
        self.assert_within(fsi.moving_piston(150), ahead=1.5 * 1.9e-4, behind=1.5 * 1.2e-3)

    def test_a_plate_that_drags_gas_along(self):
        for cells in (10, 20):
            self.assert_within(fsi.couette(cells), u=1e-6, force=1e-6)

    def test_a_warm_body_at_rest(self):
        for bottom in (.78, .72, .8):  # within a cell, in a small one, and at a face
            self.assert_within(fsi.warm_body(10, bottom), heat=1e-5)

    def test_a_plug_that_swings_in_a_box(self):
        self.assert_within(fsi.closed_box(50), mass=1e-14, energy=1.5 * 8e-6)

    def test_flow_past_a_wedge(self):
        self.assert_within(fsi.wedge(100), p=1.5 * 1.5e-2)


JWL = """<EOS type="JWL"><A>300</A><B>2</B><R1>5</R1><R2>1.5</R2><om>0.4</om><rho0>1</rho0></EOS>"""
# A disc in viscous gas that conducts heat.
class ConservationTest(SceneTest):
    """A test of the quantities that gas and bodies conserve in a closed box."""
    KEPT = (*TOTALS, "GasHeatToBodies")

    def assert_kept(self, text, *sets, elastic=False):
        found = globals_of(self.scene(text), *self.KEPT, sets=sets)
        rows = list(zip(*found.values()))
        start = None
        for mass, momentum, kinetic, gas, _, energy, ofGas, heat in rows:
            kept = [gas[1], mass[1], *momentum[1:], energy[1] + kinetic[1] - ofGas[1] + heat[1]]
            start = start or kept
            fastest = (2 * start[1] * start[-1]) ** .5  # momentum that this mass has with all of the energy
            for number, (value, before) in enumerate(zip(kept, start)):
                if elastic and number == len(kept) - 1:
                    continue  # strain is not summed
                unit = fastest if 2 <= number < 5 else abs(before)
                self.assertLess(abs(value - before), 1e-12 * unit, f"number {number} at t = {mass[0]}")
        of_body = [row[2][1] - row[6][1] for row in (rows[0], rows[-1])]
        self.assertGreater(abs(of_body[1] - of_body[0]), 1e-3 * max(of_body), "the body did not notice")


class Conservation(ConservationTest):
    def test_of_a_rigid_body_between_waves_on_a_line(self):
        text = changed(saving(rigid(CONTACT), *self.KEPT), ("<temperature>10<", "<temperature>30<"), LIGHT,
                       ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept(text, "Time/maxTime=1")

    def test_of_a_rigid_disc_between_waves_in_a_plane(self):
        text = changed(saving(rigid(DISC), *self.KEPT), ("<temperature>5<", "<temperature>15<"), LIGHT,
                       ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept(text, "Grid/Level/Box/resolution=[25,25,1]", "Grid/Level/Box/upper=[1,1,0.04]",
                         "Time/maxTime=0.3")

    def test_of_a_rigid_body_in_products_of_an_explosive(self):
        text = changed(saving(rigid(CONTACT), *self.KEPT), ("<temperature>10<", "<temperature>30<"), LIGHT,
                       ("<reference_pressure>1<", "<reference_pressure>0<"), ('<EOS type="ideal_gas"/>', JWL))
        self.assert_kept(text, "Time/maxTime=1")

    def test_of_a_disc_that_viscous_gas_drags(self):
        warm = "<temperature>2</temperature></geom_object></material></MPM>"
        text = changed(saving(rigid(VISCOUS), *self.KEPT), (RESTING, warm))
        self.assert_kept(text, *fsi.resolution("carried_disc", 25), "Time/maxTime=0.2")

    def test_of_an_elastic_body_but_for_its_strain(self):
        text = changed(saving(CONTACT, *self.KEPT), ("<temperature>10<", "<temperature>30<"), LIGHT)
        self.assert_kept(text, "Time/maxTime=0.3", elastic=True)

    def test_of_the_mass_of_gas_where_a_body_touches_the_sides_of_the_grid(self):
        mass = globals_of(self.scene(BALL), "GasMass", sets=("Grid/Level/Box/resolution=[20,10,10]",
                                                             "Time/max_Timesteps=60"))["GasMass"]
        self.assertLess(max(abs(line[1] / mass[0][1] - 1) for line in mass), 1e-13)


GIVEN = ("GasImpulseOnBodies", "GasWorkOnBodies", "GasHeatToBodies", "GasLeak", "MergedCells")
# A box with warm gas and a cold plug that swings, as the pressures are unlike.
WARM = changed(also(PLUG, *GIVEN), ("<heat>[0]", "<heat>[500]"),
               ("</constitutive_model>", "</constitutive_model><specific_heat>1</specific_heat>"
                                         "<thermal_conductivity>0</thermal_conductivity>"),
               ("<res>[4,1,1]</res>", "<res>[4,1,1]</res><temperature>0.3</temperature>"))


def thin_plug(width):
    """Returns the scene of the plug with a plug `cells` cells of .01 m thick, of the same mass."""
    return changed(also(PLUG, *GIVEN), ("[0.95,0,0]", "[1,0,0]"), ("[1.05,1,1]", f"[{1 + .01 * width},1,1]"),
                   ("<density>5<", f"<density>{50 / width}<"))


class Given(SceneTest):
    """What the gas has transferred to and through bodies since the start."""

    def given(self, text, *sets):
        return globals_of(self.scene(text), *TOTALS, *GIVEN, sets=sets)

    def test_is_what_bodies_got(self):
        found = self.given(WARM, "Time/maxTime=0.3")
        start, end = ({name: lines[k][1] for name, lines in found.items()} for k in (0, -1))
        gained = {name: end[name] - start[name] for name in end}
        momentum = gained["TotalMomentum"] - gained["GasMomentum"]
        kinetic = gained["KineticEnergy"] - gained["GasKineticEnergy"]
        self.assertGreater(gained["GasHeatToBodies"], .01)
        self.assertGreater(gained["GasWorkOnBodies"], .001)
        self.assertAlmostEqual(gained["GasImpulseOnBodies"] / momentum, 1, delta=1e-12)
        self.assertAlmostEqual(gained["GasWorkOnBodies"] / kinetic, 1, delta=1e-12)
        lost = gained["GasWorkOnBodies"] + gained["GasHeatToBodies"]
        self.assertLess(abs(gained["GasEnergy"] + lost), 1e-14 * start["GasEnergy"])

    def test_leaks_through_a_plate_are_what_gets_behind_it(self):
        scene = self.scene(thin_plug(.75))
        archive = archive_of(scene, scene.parent)
        place = globals_of(scene, "CenterOfMassPosition")["CenterOfMassPosition"][-1][1] / .5
        found = columns(archive, "c.density")
        behind = sum(.01 * rho for x, rho in zip(found["x [m]"], found["c.density [kg/m^3]"]) if x > place)
        leak = globals_of(scene, "GasLeak")["GasLeak"][-1][1]
        self.assertAlmostEqual(behind - 1.4 * .9925, leak, delta=.1 * leak)

    def test_nothing_leaks_through_thick_bodies(self):
        self.assertEqual(self.given(thin_plug(2), "Time/maxTime=0.1")["GasLeak"][-1][1], 0)
        carried = saving(DISC, "GasLeak", "GasMass")
        found = globals_of(self.scene(carried), "GasLeak", "GasMass", sets=fsi.resolution("carried_disc", 25))
        self.assertLess(found["GasLeak"][-1][1], 1e-13 * found["GasMass"][0][1])

    def test_a_small_cell_beside_the_plug_is_merged(self):
        merged = self.given(thin_plug(10), "Time/max_Timesteps=1")["MergedCells"]
        self.assertEqual(merged[-1][1], 1, "the plug moves, and leaves room in the cell behind it")

    def test_has_the_same_bits_on_patches_on_ranks_and_after_a_restart(self):
        def result(folder, outcome):
            code, errors, report = outcome
            self.assertEqual((code, errors), (0, ""))
            return [report["fingerprint"], *((folder.uda / f"{name}.dat").read_text() for name in GIVEN)]

        scene, found = self.scene(WARM), []
        often = ("DataArchiver/outputInterval=0", "DataArchiver/checkpoint/@timestepInterval=20")
        for layout, ranks, steps in (("[1,1,1]", 1, 41), ("[7,1,1]", 1, 41), ("[50,1,1]", 3, 41), ("[1,1,1]", 1, 21)):
            folder = Folder(ranks=ranks)
            self.addCleanup(folder.cleanup)
            found.append(result(folder, folder.run(scene, *often, f"Time/max_Timesteps={steps}", layout=layout)))
        found[-1] = result(folder, folder.restart("Time/max_Timesteps=41", step=20))
        for other in found[1:]:
            self.assertEqual(other, found[0])


class RigidBodies(SceneTest):
    def test_move_as_they_started_whatever_the_gas_does(self):
        scene = self.scene(fsi.scene("moving_piston").read_text())
        speeds = columns(archive_of(scene, scene.parent), "p.velocity")["p.velocity.x [m/s]"]
        self.assertLess(max(abs(speed - 1) for speed in speeds), 1e-12)

    def test_do_not_fall(self):
        text = changed(fsi.scene("moving_piston").read_text(), ("<gravity>[0,0,0]", "<gravity>[0.3,0,0]"))
        scene = self.scene(text)
        speeds = columns(archive_of(scene, scene.parent), "p.velocity")["p.velocity.x [m/s]"]
        self.assertLess(max(abs(speed - 1) for speed in speeds), 1e-12)

    def test_stay_where_they_are_in_a_flow(self):
        save = '<save label="c.pressure"/>'
        scene = self.scene(changed(fsi.scene("wedge").read_text(), (save, save + '<save label="p.velocity"/>')))
        found = columns(archive_of(scene, scene.parent, "Time/maxTime=0.2", *fsi.resolution("wedge", 40)), "p.velocity")
        self.assertEqual({speed for axis in "xy" for speed in found[f"p.velocity.{axis} [m/s]"]}, {0})

    def test_have_no_strain_energy(self):
        # The body is pushed into the side x+ from t = .475 on.
        saved = ("TotalEnergy", "GasEnergy", "KineticEnergy", "GasKineticEnergy")
        text = changed(also(PLUG, *saved), ('type="mpmice"', 'type="rmpmice"'),
                       ("<res>[4,1,1]</res>", "<res>[4,1,1]</res><velocity>[2,0,0]</velocity>"),
                       ("<is_force_transmitting_material>true</is_force_transmitting_material>", ""))
        totals = globals_of(self.scene(text), *saved, sets=("Time/maxTime=0.48",))
        for rows in zip(*(totals[name] for name in saved)):
            total, gas, kinetic, kinetic_of_gas = (row[1] for row in rows)
            self.assertAlmostEqual(total - gas - (kinetic - kinetic_of_gas), 0, delta=1e-14 * gas)


class WrongScenes(RefusedSceneTest):
    def test_gas_needs_the_section_of_its_method(self):
        self.assert_refused(re.sub(r"  <CFD>.*</CFD>\n", "", PLUG, flags=re.DOTALL), "the section <CFD> is missing")

    def test_gas_and_bodies_are_needed(self):
        for tag in ("ICE", "MPM"):
            text = re.sub(rf"    <{tag}>\n      <material.*</{tag}>\n", "", PLUG, flags=re.DOTALL)
            self.assert_refused(text, f"missing tag <{tag}> in <MaterialProperties>")

    def test_bodies_that_exchange_heat_need_a_specific_heat(self):
        self.assert_refused(PLUG.replace("<heat>[0]", "<heat>[1e15]"),
                            "missing tag <specific_heat>: the body exchanges heat")

    def test_slip_by_the_mean_free_path(self):
        start, end = "<exchange_properties>", "<Model type='slip'><useSlipCoeffs>{}</useSlipCoeffs></Model>"
        self.assert_refused(PLUG.replace(start, start + end.format("true")),
                            "slip by the mean free path is not available: viscous gas sticks to walls")
        done = run(self.scene(PLUG.replace(start, start + end.format("false"))), options=("--check",))
        self.assertEqual(done.code, 0, done.err)

    def test_a_number_for_each_pair_of_materials(self):
        self.assert_refused(PLUG.replace("<momentum>[1e15]", "<momentum>[1e15,1e15]"),
                            "found 2 numbers, expected 1: one for each pair of 2 materials")
        self.assert_refused(PLUG.replace("<momentum>[1e15]", "<momentum>[]"), "found 0 numbers, expected 1")
        self.assert_refused(PLUG.replace("<heat>[0]", "<heat>[0,0]"), "found 2 numbers, expected 1")

    def test_cells_may_be_half_full(self):
        self.assert_refused(PLUG.replace("<cfl>0.4", "<cfl>0.6"), "found 0.6, expected at most 0.5 with bodies")

    def test_a_gas_is_not_axisymmetric(self):
        self.assert_refused(PLUG.replace("<MPM>\n", "<MPM>\n    <axisymmetric>true</axisymmetric>\n", 1),
                            "is not available with a gas")

    def test_a_region_without_a_cell(self):
        self.assert_refused(PLUG.replace("</geom_object>\n      </material>\n    </ICE>", "</geom_object>"
                                         "<geom_object><box><min>[8,0,0]</min><max>[9,1,1]</max></box>"
                                         "<density>1</density><temperature>1</temperature></geom_object>"
                                         "</material></ICE>"), "its shape contains no cell centre")


if __name__ == "__main__":
    unittest.main()
