#!/usr/bin/env python3
"""Implicit steps of solids: comparison with explicit ones, any patches, and the messages of a solve that fails."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of, last_state
from sus import ROOT, SUS, bits_of, run
from uda import Folder

BEAM = "ups/solid/implicit_cantilever.ups"
COARSE = ("MPM/interpolator=gimp", "Grid/Level/Box/upper=[1.2,0.8,0.05]", "Grid/Level/Box/resolution=[12,8,1]")


def last_of(scene, names, sets):
    """Returns the last line of each global, without its time."""
    with tempfile.TemporaryDirectory() as folder:
        command = [SUS, scene, "--quiet", "--output", folder]
        for override in sets:
            command += ["--set", override]
        subprocess.run(command, cwd=ROOT, check=True)
        archive = next(pathlib.Path(folder).glob("*.uda.*"))
        return [[float(word) for word in (archive / f"{name}.dat").read_text().splitlines()[-1].split()[1:]]
                for name in names]


def energies_of(scene, sets):
    """Returns time and strain energy of each step."""
    with tempfile.TemporaryDirectory() as folder:
        command = [SUS, scene, "--quiet", "--output", folder]
        for override in sets:
            command += ["--set", override]
        subprocess.run(command, cwd=ROOT, check=True)
        lines = next(pathlib.Path(folder).glob("*.uda.*/StrainEnergy.dat")).read_text().splitlines()
    return [tuple(map(float, line.split())) for line in lines if line[0] != "#"]


def explicit(text):
    """The same scene with explicit steps and a damping that brings it to rest."""
    text = re.sub(r"<dynamic>.*</Solver>", "<artificial_damping_coeff>6</artificial_damping_coeff>", text,
                  flags=re.DOTALL)
    text = text.replace('type="impm"', 'type="mpm"').replace(">implicit<", ">explicit<")
    text = re.sub(r".*(Newton|Krylov)Iterations.*\n", "", text)
    return text.replace("<delt_init>1</delt_init>", "<timestep_multiplier>0.5</timestep_multiplier>")


def free(text):
    """The same beam without supports and with inertia."""
    text = re.sub(r'.*label="Velocity" var="Dirichlet".*\n', "", text)
    return text.replace("<dynamic>false", "<dynamic>true").replace('"StrainEnergy"', '"TotalMomentum"')


HEATED = """<PhysicalBC><MPM><heat_flux>
    <geom_object><box><min>[1,0.4,0]</min><max>[1,0.6,0.05]</max></box></geom_object>
    <load_curve><time_point><time>0</time><load>1e6</load></time_point></load_curve></heat_flux></MPM></PhysicalBC>"""


MASTER = """<Uintah_specification><SimulationComponent type="impm"/>
<Time><maxTime>.2</maxTime><delt_max>.1</delt_max><delt_init>.1</delt_init></Time>
<MPM><time_integrator>implicit</time_integrator><interpolator>gimp</interpolator><dynamic>true</dynamic></MPM>
<MaterialProperties><MPM><material><density>1000</density><constitutive_model type="comp_neo_hook">
<bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus></constitutive_model><geom_object>
<box><min>[.2,.2,0]</min><max>[.5,.5,.05]</max></box><res>[2,2,1]</res><velocity>[0,0,0]</velocity></geom_object>
</material><contact><type>specified</type><materials>[0]</materials><master_material>0</master_material>
<direction>[1,1,0]</direction><filename>motion.txt</filename></contact></MPM></MaterialProperties>
<Grid><BoundaryConditions><Face side="z-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>
<Face side="z+"><BCType id="all" label="Symmetric" var="symmetry"/></Face></BoundaryConditions>
<Level><Box label="all"><lower>[0,0,0]</lower><upper>[1.2,.8,.05]</upper><resolution>[24,16,1]</resolution></Box>
</Level></Grid><DataArchiver><filebase>master.uda</filebase><save label="TotalMomentum"/><save label="KineticEnergy"/>
<save label="CenterOfMassPosition"/></DataArchiver></Uintah_specification>"""


class Implicit(SceneTest):
    def test_heat_that_flows_in_while_bodies_rest_or_move(self):
        text = (ROOT / BEAM).read_text()
        text = text.replace("<MaterialProperties>", HEATED + "<MaterialProperties>", 1)
        text = text.replace("<DataArchiver>", '<DataArchiver><save label="ThermalEnergy"/>', 1)
        text = text.replace("<constitutive_model", "<thermal_conductivity>20</thermal_conductivity>"
                            "<specific_heat>400</specific_heat><constitutive_model", 1)
        for moves in ("false", "true"):
            with self.subTest(moves), tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder, "heated.ups")
                scene.write_text(text)
                sets = ("MPM/use_load_curves=true", "MPM/DoImplicitHeatConduction=true", f"MPM/DoMechanics={moves}",
                        "Time/delt_init=0.1", "Time/delt_max=0.1", "Time/max_Timesteps=4")
                words = [SUS, str(scene), "--quiet", "--output", folder]
                for override in sets:
                    words += ["--set", override]
                done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                solves = list(pathlib.Path(folder).glob("*.uda.*/NewtonIterations.dat"))
                self.assertEqual(len(solves), 1 if moves == "true" else 0, "only bodies that move need Newton's method")
                lines = next(pathlib.Path(folder).glob("*.uda.*/ThermalEnergy.dat")).read_text().splitlines()
                (start, before), (end, after) = [map(float, lines[at].split()) for at in (1, -1)]
                self.assertGreater(end, start)
                self.assertAlmostEqual((after - before) / (1e6 * 0.2 * 0.05 * (end - start)), 1, 9)

    def test_a_load_that_is_there_from_the_start_acts_from_the_start(self):
        pressed = """<PhysicalBC><MPM><pressure>
            <geom_object><box><min>[1,0.4,0]</min><max>[1,0.6,0.05]</max></box></geom_object>
            <load_curve><id>1</id><time_point><time>0</time><load>-30</load></time_point>
                        <time_point><time>10</time><load>-30</load></time_point></load_curve>
            </pressure></MPM></PhysicalBC><MPM><use_load_curves>true</use_load_curves>"""
        scene = self.scene(free((ROOT / BEAM).read_text()).replace("<MPM>", pressed, 1))
        dt, force = .1, (-30 * .2 * .05, -.1 * 10)
        rows = globals_of(scene, "TotalMomentum", "CenterOfMassPosition",
                          sets=(f"Time/delt_init={dt}", f"Time/delt_max={dt}",
                                                                                "Time/maxTime=.3"))
        for k, (momentum, moment) in enumerate(zip(rows["TotalMomentum"], rows["CenterOfMassPosition"])):
            for axis in (0, 1):  # of 10 kg, in the middle at (.5, .5); rounding and what Newton's method leaves
                self.assertAlmostEqual(momentum[1 + axis], force[axis] * k * dt, delta=1e-9)
                self.assertAlmostEqual(moment[1 + axis], 5 + force[axis] * (k * dt)**2 / 2, delta=1e-9)
    def test_a_load_acts_however_small_it_is_beside_the_stiffness(self):
        steps = ("Time/maxTime=1", "DataArchiver/save[1]/@label=p.x")
        falls = []
        for gravity in (1e-6, 1e-12):
            end, = last_of(BEAM, ["CenterOfMassPosition"], (f"PhysicalConstants/gravity=[0,-{gravity},0]", *steps))
            start, = last_of(BEAM, ["CenterOfMassPosition"], ("PhysicalConstants/gravity=[0,0,0]", *steps))
            falls.append((start[1] - end[1]) / gravity)
        self.assertGreater(falls[1], 0)
        self.assertAlmostEqual(falls[1] / falls[0], 1, delta=.05)  # of 1e-12 the position keeps two digits

    def test_ends_where_explicit_steps_end(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "explicit.ups")
            scene.write_text(explicit((ROOT / BEAM).read_text()))
            names = ("CenterOfMassPosition", "StrainEnergy")
            # Half the period of the beam is 1.1 s, and its damping nearly critical: exp(-3 t) is left of the motion.
            at_rest = last_of(scene, names, (*COARSE, "Time/maxTime=3"))
            implicit = last_of(BEAM, names, COARSE)
        mass, middle = 200 * .05, .5
        sunk = [mass * middle - values[0][1] for values in (at_rest, implicit)]
        self.assertAlmostEqual(sunk[1] / sunk[0], 1, delta=.005)
        self.assertAlmostEqual(implicit[1][0] / at_rest[1][0], 1, delta=.01)  # goes as the square of the above

    def test_a_cylinder_under_pressure_rests_where_explicit_steps_swing_around(self):
        scene, coarse = "ups/solid/thick_cylinder.ups", ("Grid/Level/Box/resolution=[30,1,1]",)
        swinging = energies_of(scene, coarse)
        loaded = [energy for time, energy in swinging if time > .031]  # the load grows until .03 s
        at_rest = energies_of(scene, (*coarse, "MPM/time_integrator=implicit", "MPM/dynamic=false",
                                      "Time/delt_init=0.01",
                                      "Time/delt_max=0.01", "Time/timestep_multiplier=1"))
        self.assertAlmostEqual(at_rest[-1][1] / (sum(loaded) / len(loaded)), 1, delta=.005)
        self.assertLess(len(at_rest), len(swinging) / 1000)

    def test_a_die_presses_a_billet_with_the_force_of_plastic_flow(self):
        billet = (ROOT / "ups/solid/billet.ups").read_text()
        metal = re.sub(r"<yield_stress>(.*)</yield_stress>\s*<hardening_modulus>(.*)</hardening_modulus>",
                       r'<flow_model type="isotropic_hardening"><sigma_Y>\1</sigma_Y><K>\2</K></flow_model>', billet)
        metal = metal.replace("comp_neo_hook_plastic", "elastic_plastic")
        metal = metal.replace("<density>2700</density>",
                              "<density>2700</density><specific_heat>900</specific_heat><melt_temp>900</melt_temp>")
        height = .01 - 20 * 2.5e-5
        for text in (billet, metal):
            with tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder, "billet.ups")
                scene.write_text(text)
                force, = last_of(scene, ["RigidReactionForce"],
                                 ("MPM/time_integrator=implicit", "MPM/dynamic=false", "MPM/artificial_viscosity=false",
                                  "Time/timestep_multiplier=1", "Time/delt_init=2.5e-6", "Time/delt_max=2.5e-6",
                                  "Time/maxTime=2.5e-5"))
            hill = -2 / 3**.5 * 200e6 * .01 * .01 / height * .001  # plastic flow keeps the volume
            self.assertEqual((force[0], force[2]), (0, 0))  # the die is smooth
            # The nodes of the die reach up to a cell into the billet, and keep its ten cells from widening there.
            self.assertTrue(1 < force[1] / hill < 1.2, force[1] / hill)

    def test_a_rigid_body_is_followed_along_all_axes_unless_the_scene_says_which(self):
        billet = (ROOT / "ups/solid/billet.ups").read_text()
        steps = ("MPM/time_integrator=implicit", "MPM/dynamic=false", "MPM/artificial_viscosity=false",
                 "Time/timestep_multiplier=1", "Time/delt_init=1e-6", "Time/max_Timesteps=1")
        line = "<direction>[0,1,0]</direction>"
        forces = [last_of(self.scene(billet.replace(line, other)), ["RigidReactionForce"], steps)[0]
                  for other in (line, "<direction>[1,1,1]</direction>", "")]
        self.assertEqual(forces[0][0], 0)
        self.assertNotEqual(forces[1][0], 0)
        self.assertEqual(forces[2], forces[1])

    def test_particles_go_no_further_than_most_of_a_cell_in_a_step(self):
        scene = self.scene(free((ROOT / BEAM).read_text()))
        rows = globals_of(scene, "TotalMomentum", sets=("MaterialProperties/MPM/material/geom_object/velocity=[1,0,0]",
                                                        "PhysicalConstants/gravity=[0,0,0]", "Time/maxTime=0.15"))
        times = [row[0] for row in rows["TotalMomentum"]]
        for before, after in zip(times, times[1:]):
            self.assertAlmostEqual(after - before, .8 * .05, delta=1e-9)  # of a cell, at 1 m/s

    def test_a_master_has_the_velocity_of_its_file_and_limits_steps_by_it(self):
        """Until 30 November 2026, its velocity stayed 0, and its first steps could cross several cells."""
        scene = self.scene(MASTER)
        scene.with_name("motion.txt").write_text("0 1 0 0\n10 1 0 0\n")
        found = globals_of(scene, "TotalMomentum", "KineticEnergy", "CenterOfMassPosition")
        mass = 1000 * .3 * .3 * .05
        for momentum, energy in zip(found["TotalMomentum"][1:], found["KineticEnergy"][1:]):
            self.assertAlmostEqual(momentum[1], mass, delta=1e-12)
            self.assertAlmostEqual(energy[1], mass / 2, delta=1e-12)
        rows = found["CenterOfMassPosition"]
        for before, after in zip(rows, rows[1:]):
            self.assertLessEqual(after[0] - before[0], .8 * .05 + 1e-12)
            self.assertAlmostEqual((after[1] - before[1]) / mass, after[0] - before[0], delta=1e-9)

    def test_a_grid_that_goes_along_gives_one_equilibrium_in_any_number_of_steps(self):
        along = ("MPM/do_grid_reset=false", "DataArchiver/save[1]/@label=p.displacement")
        reset, one, many = (last_state(BEAM, "p.x", "p.displacement", sets=sets) for sets in (
            ("Time/max_Timesteps=1",), (*along, "Time/max_Timesteps=1"), (*along, "Time/max_Timesteps=4")))
        for axis in "xy":
            name = f"p.displacement.{axis} [m]"
            for moved, once, again in zip(reset[name], one[name], many[name]):
                self.assertAlmostEqual(once, moved, delta=1e-15)  # nothing has moved yet; rounding of places of 1 m
                self.assertAlmostEqual(again, once, delta=1e-9)  # Newton's tolerance of .1 m, and rounding
        self.assertEqual(one["x [m]"], many["x [m]"])  # the place in the grid
        self.assertGreater(max(map(abs, many["p.displacement.y [m]"])), .01)  # a fifth of a cell

    def test_patches_change_no_bit(self):
        prints = {run(BEAM, "Time/max_Timesteps=2", f"Grid/Level/Box/patches={patches}").report["fingerprint"]
                  for patches in ("[1,1,1]", "[2,1,1]", "[5,3,1]")}
        self.assertEqual(len(prints), 1)

    def assert_no_bit_changes(self, text):
        prints = {bits_of(run(self.scene(text), f"Grid/Level/Box/patches={patches}").report)
                  for patches in ("[1,1,1]", "[2,1,1]", "[5,3,1]")}
        self.assertEqual(len(prints), 1)

    def test_patches_change_no_bit_of_heat_and_of_free_masters(self):
        """Until 30 November 2026, sums at nodes were in the order of the patches."""
        disc = MASTER.replace(
            "<box><min>[.2,.2,0]</min><max>[.5,.5,.05]</max></box>",
            "<cylinder><bottom>[.4,.4,0]</bottom><top>[.4,.4,.05]</top><radius>.3</radius></cylinder>")
        self.assertNotEqual(disc, MASTER)
        free = re.sub("<filename>.*?</filename>", "", disc).replace("<velocity>[0,0,0]", "<velocity>[.3*y,.7*x,0]")
        other = re.search("<material>.*?</material>", free, re.S).group().replace(".4,.4", ".9,.4").replace(
            ".3</radius>", ".2</radius>").replace("[.3*y,.7*x,0]", "[0,0,0]")
        self.assert_no_bit_changes(free.replace("<contact>", other + "<contact>", 1).replace("[0]</m", "[0,1]</m"))
        heated = re.sub("<contact>.*?</contact>", "", disc, flags=re.S).replace(
            "<density>1000</density>", "<density>1000</density><specific_heat>1</specific_heat><thermal_conductivity>1"
            "</thermal_conductivity>").replace("</res>", "</res><temperature>300+100*x*y</temperature>").replace(
            "<dynamic>true", "<DoImplicitHeatConduction>true</DoImplicitHeatConduction><dynamic>true").replace(
            '<save label="KineticEnergy"/>', '<save label="p.temperature"/>').replace(">.1<", ">.001<").replace(
            ">.2<", ">.003<")
        self.assert_no_bit_changes(heated)

    def test_a_restart_changes_no_bit_of_what_moves(self):
        scene, steps = self.scene(free((ROOT / BEAM).read_text())), "Time/max_Timesteps=4"
        folder = Folder()
        self.addCleanup(folder.cleanup)
        code, errors, whole = folder.run(scene, "DataArchiver/checkpoint/@timestepInterval=1", steps)
        self.assertEqual((code, errors), (0, ""))
        code, errors, report = folder.restart(steps, step=3)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(report["fingerprint"], whole["fingerprint"])

    def test_what_is_left_of_the_residual_can_be_saved(self):
        left, = last_of(BEAM, ["NewtonResidual"], ("DataArchiver/save[3]/@label=NewtonResidual",
                                                   "Time/max_Timesteps=1"))
        self.assertTrue(0 < left[0] < 1e-9, left)

    def test_a_failed_solve_tells_history_place_and_what_to_try(self):
        result = run(BEAM, "MPM/iters_before_timestep_restart=1", "Time/delt_min=0.9")
        self.assertEqual(result.code, 4)
        self.assertRegex(result.err, r"Newton's method did not converge: more iterations than allowed, "
                                     r"after 1 iteration; residuals \S+, \S+; the largest "
                                     r"residual is at the node at \(")
        self.assertIn("try a smaller <delt_init>", result.err)

    def test_a_failed_linear_solve_tells_its_own_history_too(self):
        result = run(BEAM, "MPM/Solver/solver=gmres", "MPM/Solver/preconditioner=jacobi", "MPM/Solver/maxiterations=3",
                     "Time/delt_min=0.9")
        self.assertEqual(result.code, 4)
        self.assertRegex(result.err, r"Newton's method did not converge: a linear solve failed, more iterations than "
                                     r"allowed \(DIVERGED_ITS\), after .*; last linear solve: 3 iterations; "
                                     r"residuals \S+, ")
        self.assertIn("more <maxiterations>", result.err)

    def test_a_tag_in_solver_leaves_the_defaults_of_the_others(self):
        sets = ("MPM/interpolator=gimp", "Time/max_Timesteps=1", "Grid/Level/Box/patches=[1,1,1]")
        without = self.scene(re.sub(r"<Solver>.*</Solver>", "", (ROOT / BEAM).read_text(), flags=re.DOTALL))
        one = self.scene(re.sub(r"<Solver>.*</Solver>", "<Solver><maxiterations>999</maxiterations></Solver>",
                                (ROOT / BEAM).read_text(), flags=re.DOTALL))
        self.assertEqual(run(one, *sets).report["fingerprint"], run(without, *sets).report["fingerprint"])

    def test_cells_around_an_axis_are_refused(self):
        implicit = "<time_integrator>implicit</time_integrator>"
        path = self.scene((ROOT / BEAM).read_text().replace(implicit, implicit + "<axisymmetric>true</axisymmetric>"))
        result = run(path, "Grid/Level/Box/resolution=[25,15,2]")
        self.assertEqual(result.code, 3)
        self.assertIn("MPM/axisymmetric: x is the radius and y the axis: give z one cell between symmetry planes",
                      result.err)

    def test_a_step_that_fails_is_halved(self):
        result = run(BEAM, "MPM/iters_before_timestep_restart=2", "Time/max_Timesteps=1",
                     "PhysicalConstants/gravity=[0,-50,0]",
                     "MPM/dynamic=true")
        self.assertEqual(result.code, 0, result.err)
        self.assertGreater(result.report["retries"], 0)


def oscillating(lower):
    """A bar of 16 cells, of which those beyond `lower` [m] are there, that starts to stretch away from x = 0."""
    planes = "".join(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                     for side in ("x-", "y-", "z-", "z+"))
    return f"""<?xml version="1.0"?><Uintah_specification><SimulationComponent type="impm"/>
<Time><maxTime>100</maxTime><delt_init>.002</delt_init><delt_max>.002</delt_max><max_Timesteps>6</max_Timesteps></Time>
<Grid><BoundaryConditions>{planes}</BoundaryConditions><Level><Box><lower>[{lower},0,0]</lower><upper>[1,.3,.1]</upper>
<resolution>[{round((1 - lower) * 10)},3,1]</resolution></Box></Level></Grid>
<DataArchiver><filebase>a.uda</filebase><outputTimestepInterval>6</outputTimestepInterval><save label="p.x"/>
<save label="p.velocity"/></DataArchiver>
<MPM><time_integrator>implicit</time_integrator><interpolator>linear</interpolator><dynamic>true</dynamic>
<Solver><solver>direct</solver><preconditioner>lu</preconditioner></Solver>
<convergence_criteria_disp>1e-20</convergence_criteria_disp>
<convergence_criteria_energy>1e-20</convergence_criteria_energy></MPM>
<PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants><MaterialProperties><MPM><material name="bar">
<density>1000</density><constitutive_model type="comp_neo_hook"><bulk_modulus>166667</bulk_modulus>
<shear_modulus>76923</shear_modulus></constitutive_model><geom_object><box><min>[{max(lower, -.4)},0,0]</min>
<max>[.4,.15,.1]</max></box><res>[2,2,1]</res><velocity>[2*x,-.5*y,0]</velocity></geom_object></material></MPM>
</MaterialProperties></Uintah_specification>"""


class Halves(SceneTest):
    def velocities(self, lower):
        """Velocities of the particles at x > 0, in the order of their places."""
        state = last_state(self.scene(oscillating(lower)), "p.velocity")
        columns = [name for name in state if name.startswith("p.velocity")]
        rows = zip(*(map(float, state[name]) for name in ("x [m]", "y [m]", *columns)))
        return [row[2:] for row in sorted((round(x, 6), round(y, 6), *v) for x, y, *v in rows) if row[0] > 0]

    def test_of_a_body_that_moves_are_half_of_the_whole(self):
        """Nodes on a symmetry plane do not move along its normal: the particles beyond move the opposite way. Until 29
        November 2026, they had the mean velocity of the particles in front, and swung about 0."""
        whole, half = self.velocities(-1), self.velocities(0)
        self.assertEqual(len(half), 24)
        for expected, found in zip(whole, half, strict=True):
            for one, other in zip(expected, found):
                self.assertAlmostEqual(one, other, delta=1e-11)


if __name__ == "__main__":
    unittest.main()
