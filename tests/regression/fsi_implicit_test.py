#!/usr/bin/env python3
"""Implicit steps of a gas around bodies: exactness, errors, conservation, bitwise equal results on any layout."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import CONTACT, DISC, LIGHT, RESTING, VISCOUS, ConservationTest, changed, rigid, saving
from solids import SceneTest, archive_of, columns, globals_of
from sus import run
from uda import Folder


def implicit(text):
    """Returns a scene whose time steps are not limited by sound."""
    knob = "<knob_for_speedSound>0</knob_for_speedSound>"
    solver = "<ImplicitSolver><Solver><preconditioner>jacobi</preconditioner></Solver></ImplicitSolver>"
    if fsi.SUM in text:
        return changed(text, (fsi.SUM, solver + fsi.SUM.replace("<Scheme", knob + "<Scheme")))
    order = '<advection type="SecondOrder"/>'
    return changed(text, (order, f"{order}<TimeStepControl>{knob}</TimeStepControl>{solver}"))


class Conservation(ConservationTest):
    def test_of_a_rigid_body(self):
        text = changed(saving(rigid(CONTACT), *self.KEPT), ("<temperature>10<", "<temperature>30<"),
                       ("<density>1000<", "<density>100<"), ("<reference_pressure>1<", "<reference_pressure>0<"))
        self.assert_kept(implicit(text), "Time/maxTime=1")

    def test_of_a_rigid_disc(self):
        text = changed(saving(rigid(DISC), *self.KEPT), ("<temperature>5<", "<temperature>15<"), LIGHT)
        self.assert_kept(implicit(text), *fsi.resolution("carried_disc", 25), "Time/maxTime=0.2")


class ImplicitSteps(SceneTest):
    SCENE = implicit(changed(VISCOUS, (RESTING, "</geom_object></material></MPM>")))
    FIELDS = ("c.pressure", "c.velocity", "c.density", "c.freeVolume")

    def fields(self, text, *sets):
        scene = self.scene(text)
        return columns(archive_of(scene, scene.parent, *sets), *self.FIELDS)

    def assert_uniform(self, text, velocity, *sets, pressure=1):
        found = self.fields(implicit(text), *sets)
        held = zip(found["c.freeVolume [1]"], found["c.density [kg/m^3]"])
        gas = [k for k, (free, mass) in enumerate(held) if free >= 1e-9 and mass > 0]
        self.assertGreater(len(gas), 20)
        velocities = ((f"c.velocity.{axis} [m/s]", value) for axis, value in zip("xy", velocity))
        for column, value in (("c.pressure [Pa]", pressure), *velocities):
            self.assertLess(max(abs(found[column][k] - value) for k in gas), 1e-11, column)

    def test_leave_gas_at_rest_and_what_moves_alike(self):
        self.assert_uniform(fsi.scene("rest").read_text(), (0, 0), *fsi.resolution("rest", 25))
        self.assert_uniform(CONTACT, (1,), "Grid/Level/Box/resolution=[50,1,1]", "Time/maxTime=1")
        self.assert_uniform(DISC, (1, .618), *fsi.resolution("carried_disc", 25))

    def test_take_no_guess_from_cells_that_a_body_filled(self):
        start, end = '<cylinder label="disc">', "</cylinder>"
        disc = DISC[DISC.index(start):DISC.index(end) + len(end)]
        block = changed(DISC, (disc, '<box label="block"><min>[0.4,0.4,-1]</min><max>[0.6,0.6,1]</max></box>'),
                        ("<specific_heat>2.5<", "<specific_heat>7.5<"),
                        ("<reference_pressure>1<", "<reference_pressure>3<"))
        self.assert_uniform(block, (1, .618), *fsi.resolution("carried_disc", 25), "Time/maxTime=0.05", pressure=3)

    def test_let_a_slow_piston_press_without_heat(self):
        errors = fsi.slow_piston(55)
        self.assertLess(errors["ahead"], 1.5 * 6.1e-4)
        self.assertLess(errors["behind"], 1.5 * 2.9e-4)
        self.assertLess(errors["steps"], 400)

    def test_drive_a_piston(self):
        momentum = globals_of(self.scene(implicit(fsi.scene("gun").read_text())), "TotalMomentum", "GasMomentum",
                              sets=("Grid/Level/Box/resolution=[75,1,1]",))
        speed = momentum["TotalMomentum"][-1][1] - momentum["GasMomentum"][-1][1]
        self.assertLess(abs(speed - .78825284), 1.5 * 3.1e-3)

    def test_push_a_light_body_alike_in_one_and_two_dimensions(self):
        """Faces side by side push the same nodes, which counts in how a wall yields to pressure."""
        text = implicit(changed(fsi.scene("gun").read_text(), ("<density>5<", "<density>0.5<")))
        speeds = []
        for cells in ("[75,1,1]", "[75,2,1]"):
            last = {name: lines[-1][1] for name, lines in globals_of(
                self.scene(text), "TotalMomentum", "GasMomentum",
                sets=(f"Grid/Level/Box/resolution={cells}", "Time/max_Timesteps=10")).items()}
            speeds.append(last["TotalMomentum"] - last["GasMomentum"])
        self.assertAlmostEqual(speeds[1] / speeds[0], 1, delta=1e-7)

    def test_have_the_same_bits_on_patches_with_threads_and_after_a_restart(self):
        scene = self.scene(self.SCENE)
        sets = fsi.resolution("carried_disc", 25)
        prints = []
        for layout, threads in (("[1,1,1]", 1), ("[5,3,1]", 2)):
            done = run(scene, *sets, "Time/max_Timesteps=12", f"Grid/Level/Box/patches={layout}",
                       options=("--quiet", "-nthreads", str(threads)))
            self.assertIsNotNone(done.report, done.err)
            prints.append(done.report["fingerprint"])
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(scene, *sets, "DataArchiver/checkpoint/@timestepInterval=6", "Time/max_Timesteps=7")
        code, errors, report = folder.restart("Time/max_Timesteps=12", step=6)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual({*prints, report["fingerprint"]}, {prints[0]})

    def test_agree_on_ranks(self):
        scene = self.scene(self.SCENE)
        found = []
        for ranks in (1, 3):
            folder = Folder(ranks=ranks)
            self.addCleanup(folder.cleanup)
            code, errors, _ = folder.run(scene, *fsi.resolution("carried_disc", 25), "Time/max_Timesteps=12",
                                         layout="[5,3,1]")
            self.assertEqual((code, errors), (0, ""))
            found.append(columns(folder.uda, *self.FIELDS))
        for name in ("c.pressure [Pa]", "c.velocity.x [m/s]", "c.velocity.y [m/s]"):
            self.assertLess(max(abs(a - b) for a, b in zip(found[0][name], found[1][name])), 1e-8, name)


class StepsOfStiffBodies(SceneTest):
    STIFF = changed(CONTACT, ("<bulk_modulus>10000.0<", "<bulk_modulus>1e8<"))
    SHORT = ("Grid/Level/Box/resolution=[50,1,1]", "Time/max_Timesteps=20")

    def done(self, text, *sets):
        done = run(self.scene(text), *self.SHORT, *sets, options=())
        self.assertIsNotNone(done.report, done.err)
        return done

    def asking(self, text, solver=""):
        order = '<advection type="SecondOrder"/>'
        return changed(text, (order, f"{order}<ImplicitSolver>{solver}</ImplicitSolver>"))

    def test_are_explicit_with_a_note_since_waves_in_bodies_limit_them(self):
        explicit, asked = self.done(self.STIFF), self.done(self.asking(self.STIFF))
        self.assertIn("steps are explicit, since waves in bodies, at 316 m/s, limit them", asked.err)
        self.assertEqual(asked.report["fingerprint"], explicit.report["fingerprint"])

    def test_are_implicit_for_soft_bodies_and_where_a_scene_has_a_solver(self):
        for text, solver in ((CONTACT, ""), (self.STIFF, "<Solver><preconditioner>jacobi</preconditioner></Solver>")):
            asked = self.done(self.asking(text, solver))
            self.assertNotIn("steps are explicit", asked.err)
            self.assertNotEqual(asked.report["fingerprint"], self.done(text).report["fingerprint"])

    def test_do_not_depend_on_the_stiffness_of_bodies_that_keep_their_velocities(self):
        ends = [self.done(text, "SimulationComponent/@type=rmpmice").report["time"] for text in (self.STIFF, CONTACT)]
        self.assertEqual(ends[0], ends[1])


if __name__ == "__main__":
    unittest.main()
