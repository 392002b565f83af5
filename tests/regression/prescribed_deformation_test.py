#!/usr/bin/env python3
"""Bodies with a prescribed deformation: stress, bitwise equal results on any patches, and files with errors."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import last_state
from sus import ROOT, run
from uda import Folder

SCENE = "ups/solid/crushed_sandstone.ups"
PATH = (ROOT / SCENE).with_suffix(".inp")
AT_END = ("DataArchiver/outputInterval=1", "DataArchiver/outputLastTimestep=true")


def state_at(time, *names, sets=()):
    return last_state(SCENE, *names, sets=(f"Time/maxTime={time}", "Time/end_at_max_time_exactly=true", *AT_END, *sets))


def trace_of_stress(strain):
    """Returns the trace of the stress from the crush curve: strain = p3 (exp(p1 (I1 - p0)) - 1) + I1 / (3 B0)."""
    low, high = -2e9, -3e8
    for _ in range(60):
        middle = (low + high) / 2
        found = .12 * math.expm1(2e-9 * (middle + 300e6)) + middle / 18e9
        low, high = (middle, high) if found < strain else (low, middle)
    return low


class PrescribedDeformation(unittest.TestCase):
    def test_pressure_follows_the_crush_curve(self):
        state = state_at(.01, "p.stress", "p.deformationMeasure")
        for axis in "xyz":
            self.assertAlmostEqual(state[f"p.deformationMeasure.{axis}{axis} [1]"][0], .98, delta=1e-5)
            for stress in state[f"p.stress.{axis}{axis} [Pa]"]:  # a step is 1 % of the time: first order
                self.assertAlmostEqual(3 * stress / trace_of_stress(3 * math.log(.98)), 1, delta=1e-3)

    def test_the_body_turns_with_its_stress_and_keeps_its_velocity(self):
        state = state_at(.03, "p.deformationMeasure", "p.stress", "p.velocity", sets=("Time/delt_max=5e-6",))
        f, stress = ([[state[f"{name}.{i}{j} [{unit}]"][0] for j in "xyz"] for i in "xyz"]
                     for name, unit in (("p.deformationMeasure", "1"), ("p.stress", "Pa")))
        # The third axis of the cube, which was compressed most, turned by 60 degrees about (1, 1, 0): Rodrigues.
        axis = (math.sin(math.radians(60)) / 2**.5, -math.sin(math.radians(60)) / 2**.5, .5)
        for i in range(3):
            self.assertAlmostEqual(f[i][2] / .95, axis[i], delta=1e-3)
        along = [sum(stress[i][j] * axis[j] for j in range(3)) for i in range(3)]
        size = sum(a * b for a, b in zip(along, axis))
        for i in range(3):
            self.assertAlmostEqual(along[i] / size, axis[i], delta=1e-3, msg="an axis of the stress")
        self.assertEqual({v for i in "xyz" for v in state[f"p.velocity.{i} [m/s]"]}, {0})

    def test_the_same_bits_on_any_patches_and_after_a_restart(self):
        steps = "Time/max_Timesteps=120"
        prints = {run(SCENE, f"Grid/Level/Box/patches={layout}", steps).report["fingerprint"]
                  for layout in ("[1,1,1]", "[2,2,2]", "[4,1,3]")}
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(SCENE, "DataArchiver/checkpoint/@timestepInterval=25", steps)
        code, errors, report = folder.restart(steps, step=int(folder.checkpoints[0].name[1:]))
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(len(prints | {report["fingerprint"]}), 1)

    def test_stresses_after_or_before_the_motion_follow_it_too(self):
        for update in ("musl", "usf"):
            state = state_at(.01, "p.deformationMeasure", sets=(f"MPM/stress_update={update}",))
            self.assertAlmostEqual(state["p.deformationMeasure.xx [1]"][0], .98, delta=1e-5)

    def test_a_slip_in_the_file_is_named_with_its_line(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "path.inp")
            path.write_text(PATH.read_text().replace("0.02  ", "0.002 "))
            done = run(SCENE, f"MPM/PrescribedDeformationFile={path}")
            self.assertEqual(done.code, 3)
            self.assertIn("path.inp:3:1: its time is not after that of the previous point", done.err)
            done = run(SCENE, "MPM/PrescribedDeformationFile=nowhere.inp")
            self.assertIn("nowhere.inp': there is no such file", done.err)

    def test_a_file_that_has_moved_with_its_scene_is_found_beside_it(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, PATH.name).write_text(PATH.read_text())
            text, named = (ROOT / SCENE).read_text(), f">{PATH.name}<"
            self.assertIn(named, text)
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(text.replace(named, f">inputs/of/old/{PATH.name}<"))
            done = run(scene, "Time/max_Timesteps=2", options=())
            self.assertEqual(done.code, 0, done.err)
            self.assertIn(f"there is no 'inputs/of/old/{PATH.name}', so the file of the same name next to the scene "
                          f"is used",
                          done.err)
            scene.write_text(text.replace(named, ">inputs/of/old/nowhere.inp<"))
            self.assertIn("nowhere.inp': there is no such file", run(scene).err)

    def test_a_flat_grid_is_refused(self):
        done = run(SCENE, "Grid/Level/Box/resolution=[4,4,1]", "Grid/Level/periodic=[0,0,1]")
        self.assertEqual(done.code, 3)
        self.assertIn("needs a grid in three dimensions", done.err)


if __name__ == "__main__":
    unittest.main()
