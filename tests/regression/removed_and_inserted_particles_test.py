#!/usr/bin/env python3
"""Inverted particles are removed, and others are inserted later: counts, and bitwise equal results on any grid."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import last_state
from sus import bits_of, run
from uda import Folder

COLLISION = "ups/solid/two_discs.ups"
# Steps far beyond the stable one.
UNSTABLE = ("Time/timestep_multiplier=6", "Time/max_Timesteps=60")

BODY = """<geom_object><box label="{label}"><min>{low}</min><max>{high}</max></box><res>[2,2,1]</res>
  <velocity>[0,0,0]</velocity><temperature>300</temperature><color>{color}</color></geom_object>"""
PELLETS = """<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>Pellets that enter one after the other</title></Meta>
  <SimulationComponent type="mpm"/>
  <Time><maxTime>1</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>0.0625</delt_max>
    <timestep_multiplier>0.5</timestep_multiplier><end_at_max_time_exactly>true</end_at_max_time_exactly></Time>
  <DataArchiver><filebase>pellets.uda</filebase><outputInterval>1</outputInterval>
    <outputLastTimestep>true</outputLastTimestep><save label="p.x"/><save label="p.color"/></DataArchiver>
  <MPM><time_integrator>explicit</time_integrator><withColor>true</withColor>
    <DoExplicitHeatConduction>false</DoExplicitHeatConduction>
    <InsertParticles>true</InsertParticles><InsertParticlesFile>pellets.dat</InsertParticlesFile></MPM>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties><MPM>
    <material name="pellets"><density>1</density><thermal_conductivity>0</thermal_conductivity>
      <specific_heat>1</specific_heat>
      <constitutive_model type="comp_neo_hook"><bulk_modulus>1</bulk_modulus><shear_modulus>1</shear_modulus>
      </constitutive_model>{bodies}</material>
    <contact><type>null</type></contact>
  </MPM></MaterialProperties>
  <Grid><BoundaryConditions>{faces}</BoundaryConditions>
    <Level><Box label="1"><lower>[0,0,0]</lower><upper>[16,8,1]</upper><resolution>[16,8,1]</resolution>
      <patches>[1,1,1]</patches></Box></Level></Grid>
</Uintah_specification>
"""
FACES = "".join(f'<Face side="{side}"><BCType id="all" var="symmetry" label="Symmetric"/></Face>'
                for side in ("x-", "x+", "y-", "y+", "z-", "z+"))


def pellets(folder, lines="0.25 1 0.1 4 0 2 0 0\n0.5 2 3.1 4 0 4 0 0\n"):
    bodies = (BODY.format(label="first", low="[2,1,0]", high="[3,2,1]", color=1)
              + BODY.format(label="second", low="[8,1,0]", high="[9,2,1]", color=2))
    scene = pathlib.Path(folder) / "pellets.ups"
    scene.write_text(PELLETS.format(bodies=bodies, faces=FACES))
    (scene.parent / "pellets.dat").write_text(lines)
    return str(scene)


def thrown(folder, block="[15,7,1]"):
    """A block at rest, and a particle that too long a step throws through a symmetry plane."""
    bodies = (BODY.format(label="first", low="[2,1,0]", high="[3,2,1]", color=1)
              .replace("<res>[2,2,1]", "<res>[1,1,1]").replace("<velocity>[0,0,0]", "<velocity>[-100,0,0]")
              + BODY.format(label="second", low="[6,1,0]", high=block, color=2))
    text = re.sub("<InsertParticles>.*</InsertParticlesFile>", "", PELLETS.format(bodies=bodies, faces=FACES))
    scene = pathlib.Path(folder) / "thrown.ups"
    scene.write_text(text.replace("<timestep_multiplier>0.5", "<timestep_multiplier>6"))
    return str(scene)


class RemovedParticles(unittest.TestCase):
    STEPS = "Time/max_Timesteps=10"

    def test_are_counted_and_the_run_goes_on_with_the_same_bits_on_any_patches_and_ranks(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = thrown(folder)
            reports = [run(scene, self.STEPS, f"Grid/Level/Box/patches={layout}", ranks=ranks).report
                       for layout, ranks in (("[1,1,1]", 1), ("[4,2,1]", 1), ("[4,2,1]", 2))]
        self.assertEqual((reports[0]["steps"], reports[0]["particles_removed"]), (10, 1))
        for report in reports[1:]:
            for key in ("fingerprint", "particles", "particles_removed", "particles_dropped"):
                self.assertEqual(report[key], reports[0][key])

    def test_make_the_next_steps_compute_stresses_from_velocities_of_particles(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = thrown(folder)
            tasks = {limit: run(scene, f"Time/timestep_multiplier={limit}", self.STEPS).report["tasks"]["kept"]
                     for limit in (6, 0.5)}
        self.assertIn("mpm::interpolateMomentum", tasks[6], "a particle is removed: musl follows")
        self.assertNotIn("mpm::interpolateMomentum", tasks[0.5], "none is removed: usl")

    def test_are_counted_across_a_restart(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        scene = thrown(folder.path)
        expected = run(scene, self.STEPS).report
        folder.run(scene, "DataArchiver/checkpoint/@timestepInterval=5", "Time/max_Timesteps=5")
        code, errors, report = folder.restart(self.STEPS, step=5)
        self.assertEqual((code, errors), (0, ""))
        for key in ("fingerprint", "particles_removed", "particles_dropped"):
            self.assertEqual(report[key], expected[key])

    def test_are_not_too_many(self):
        results = [run(COLLISION, *UNSTABLE, f"Grid/Level/Box/patches={layout}") for layout in ("[1,1,1]", "[3,2,1]")]
        for result in results:
            self.assertEqual(result.code, 4)
            self.assertIn("of 832 particles were removed, more than 1 %", result.err)
            self.assertEqual(result.report["steps"], results[0].report["steps"])

    def test_are_no_obstacle_to_a_restart_with_smaller_steps(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        scene = thrown(folder.path, block="[8,3,1]")
        self.assertEqual(folder.run(scene, self.STEPS)[0], 4)
        code, errors, report = folder.restart("Time/timestep_multiplier=0.5", self.STEPS)
        self.assertEqual((code, errors, report["steps"], report["particles_removed"]), (0, "", 10, 1))

    def test_stop_the_run_if_the_scene_says_so(self):
        result = run(COLLISION, *UNSTABLE, "MPM/lost_particles=stop")
        self.assertEqual(result.code, 4)
        self.assertIn("the step deforms the particle at", result.err)


class PeriodicSides(unittest.TestCase):
    def test_let_particles_through_even_if_the_scene_also_calls_them_symmetry_planes(self):
        body = BODY.format(label="first", low="[13,1,0]", high="[14,2,1]", color=1).replace("[0,0,0]", "[3.7,0,0]")
        text = re.sub("<InsertParticles>.*</InsertParticlesFile>", "", PELLETS.format(bodies=body, faces=FACES))
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "crossing.ups"
            scene.write_text(text.replace("</Box></Level>", "</Box><periodic>[1,0,0]</periodic></Level>"))
            state = last_state(str(scene), "p.x")
            report = run(str(scene)).report
        self.assertEqual((report["particles"], report["particles_removed"], report["particles_dropped"]), (4, 0, 0))
        # From x = 13.25 at 3.7 m/s for 1 s, through x+ at 16, without coming to lie on a node.
        self.assertAlmostEqual(min(state["x [m]"]), 0.95, delta=1e-9)


class InsertedParticles(unittest.TestCase):
    def test_move_at_their_time_and_fly_on_with_their_velocity(self):
        with tempfile.TemporaryDirectory() as folder:
            state = last_state(pellets(folder), "p.x", "p.color")
        at = {color: [(x, y) for x, y, c in zip(state["x [m]"], state["y [m]"], state["p.color [1]"])
                      if c == color] for color in (1, 2)}
        # The first flies at 2 m/s from the end of the step at .25 s on, the second at 4 m/s from that at .5 s. None
        # comes to lie on a node, where its weight is zero but not its gradient.
        for color, (x, y) in ((1, (2.35 + 2 * (.75 - .0625), 5.25)), (2, (11.35 + 4 * (.5 - .0625), 5.25))):
            self.assertEqual(len(at[color]), 4)
            self.assertAlmostEqual(min(at[color])[0], x, delta=1e-9)
            self.assertAlmostEqual(min(at[color])[1], y, delta=1e-9)

    def test_enter_with_the_same_bits_on_any_patches_and_after_a_restart(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        scene = pellets(folder.path)
        prints = {bits_of(run(scene, f"Grid/Level/Box/patches={layout}").report)
                  for layout in ("[1,1,1]", "[4,2,1]")}
        folder.run(scene, "DataArchiver/checkpoint/@timestepInterval=6", "Time/max_Timesteps=6")
        code, errors, report = folder.restart("Time/max_Timesteps=100000", "Grid/Level/Box/patches=[2,3,1]", step=6)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(prints, {bits_of(report)})

    def test_may_not_come_along_an_axis_that_the_grid_leaves_out(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run(pellets(folder, "0.25 1 0 0 1 2 0 0\n"))
        self.assertEqual(result.code, 3)
        self.assertIn("particles move along z, along which the grid has one cell", result.err)


if __name__ == "__main__":
    unittest.main()
