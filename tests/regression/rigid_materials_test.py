#!/usr/bin/env python3
"""Materials that Uintah's tags is_rigid and is_force_transmitting_material make rigid."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of
from sus import ROOT, run

BARS = (ROOT / "ups/solid/two_material_contact.ups").read_text()
HAMMER = BARS.replace('<material name="flyer">', '<material name="flyer"><is_force_transmitting_material>true'
                      '</is_force_transmitting_material>')
HAMMER = HAMMER.replace("friction_conserving</type>", "rigid</type><direction>[1,1,1]</direction>")
HAMMER = HAMMER.replace("<mu>0</mu>", "")
PUSH = """<PhysicalBC><MPM><pressure>
  <geom_object><box><min>[0.199,0,0]</min><max>[0.201,0.1,0.1]</max></box></geom_object>
  <load_curve><id>1</id><material>0</material><time_point><time>0</time><load>3000</load></time_point>
    <time_point><time>1</time><load>3000</load></time_point></load_curve>
</pressure></MPM></PhysicalBC><Grid>"""
PUSHED = HAMMER.replace("<Grid>", PUSH).replace("<time_integrator>",
                                                "<use_load_curves>true</use_load_curves><time_integrator>")


class Scenes(SceneTest):
    def lines(self, text, name, **more):
        return globals_of(self.scene(text), name, **more)[name]


class ForceTransmitting(Scenes):
    def test_what_the_target_gains_the_hammer_loses(self):
        momenta = [line[1] for line in self.lines(HAMMER, "TotalMomentum")]
        self.assertLess(max(abs(p / momenta[0] - 1) for p in momenta), 1e-12)
        energies = [line[1] for line in self.lines(HAMMER, "KineticEnergy")]
        self.assertLess(energies[-1], .9 * energies[0], "the target has been hit")

    def test_a_load_accelerates_it_as_a_whole(self):
        away = PUSHED.replace("[1.2,0,0]</min><max>[3.2", "[2.2,0,0]</min><max>[3.2")
        for time, momentum, *_ in self.lines(away, "TotalMomentum", until=.02):
            self.assertAlmostEqual(momentum, 10 + 3000 * .01 * time, delta=1e-12)
        energy = self.lines(away, "KineticEnergy", until=.02)[-1]
        self.assertAlmostEqual(energy[1], (10 + 30 * energy[0]) ** 2 / 20, delta=1e-12)  # all of it moves alike

    def test_gravity_does_not_move_it(self):
        falling = HAMMER.replace("<gravity>[0,0,0]", "<gravity>[-10,0,0]").replace("[1.2,0,0]</min><max>[3.2",
                                                                                   "[2.2,0,0]</min><max>[3.2")
        last = self.lines(falling, "TotalMomentum", until=.02)[-1]
        self.assertAlmostEqual(last[1], 10 - 10 * 10 * last[0], delta=1e-3)  # of the target alone, of 10 kg, too

    def test_contacts_that_it_does_not_feel_are_refused(self):
        """Until 29 November 2026, the other body was pushed, and momentum and energy arose."""
        for kind in ("friction</type><mu>.1</mu>", "single_velocity</type>"):
            done = run(self.scene(HAMMER.replace("rigid</type><direction>[1,1,1]</direction>", kind)),
                       "Time/max_Timesteps=1")
            self.assertEqual(done.code, 3, done.err)
            self.assertIn("feels only contacts of type rigid or specified of which it is the master", done.err)
        alone = HAMMER.replace("rigid</type><direction>[1,1,1]</direction>", "single_velocity</type>")
        alone = re.sub("<materials>.*?</materials>", "<materials>[0]</materials>", alone)
        done = run(self.scene(alone), "Time/max_Timesteps=1")
        self.assertEqual(done.code, 0, done.err)

    def test_patches_threads_and_ranks_change_no_bit(self):
        scene = self.scene(PUSHED)
        prints = {run(scene, f"Grid/Level/Box/patches={patches}", "Time/max_Timesteps=60",
                      options=("--quiet", "--nthreads", threads)).report["fingerprint"]
                  for patches, threads in (("[1,1,1]", "1"), ("[7,1,1]", "1"), ("[4,1,1]", "2"))}
        prints.add(run(scene, "Grid/Level/Box/patches=[5,1,1]", "Time/max_Timesteps=60", ranks=2).report["fingerprint"])
        self.assertEqual(len(prints), 1, prints)


class Rigid(Scenes):
    def test_its_stress_exerts_no_force(self):
        stretched = BARS.replace("<velocity>[1,0,0]", "<velocity>[0.5*x-0.5,0,0]").replace("[1.2,0,0]</min><max>[3.2",
                                                                                           "[2.2,0,0]</min><max>[3.2")
        rigid = stretched.replace('name="flyer">', 'name="flyer"><is_rigid>true</is_rigid>')
        master = stretched.replace("friction_conserving</type>", "rigid</type>").replace("<mu>0</mu>", "")
        for text, keeps in ((stretched, False), (rigid, True), (master, True)):
            energies = [line[1] for line in self.lines(text, "KineticEnergy", until=.01)]
            self.assertEqual(abs(energies[-1] / energies[0] - 1) < 1e-12, keeps)


if __name__ == "__main__":
    unittest.main()
