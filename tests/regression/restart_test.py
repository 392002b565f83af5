#!/usr/bin/env python3
"""A run that is interrupted and restarted gives the results and archive of an uninterrupted one, on any patches."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import bits_of
from uda import FolderTest

EVERY = "DataArchiver/checkpoint/@timestepInterval={}"
ALL = "Time/max_Timesteps=100000"
TRACKED = "MPM/gas_dynamics/volume_model=tracked"
RESEED = "MPM/gas_dynamics/redistribute/mode=reseed"
PLANE = ("Grid/Level/Box/resolution=[40,6,1]", "Grid/Level/Box/upper=[1,.15,1]")
SPACE = ("Grid/Level/Box/resolution=[20,4,3]", "Grid/Level/Box/upper=[1,.2,.15]")


def light_files(uda):
    """Name and text of the files beside the outputs, and the content of the outputs; without scene, runs and
    checkpoints."""
    return {path.name: path.read_bytes() for path in uda.iterdir()
            if path.is_file() and path.name not in ("input.xml", "run.json")}


class Restart(FolderTest):
    def assert_same(self, scene, *sets, cut, until=ALL, before="[1,1,1]", after="[1,1,1]"):
        """Asserts that a run interrupted after some steps and restarted from an earlier checkpoint ends like a whole
        one."""
        uncut, pieces = self.folder(), self.folder()
        every = EVERY.format(max(1, cut // 3))
        expected = self.well(uncut.run(scene, until, *sets))
        self.well(pieces.run(scene, every, f"Time/max_Timesteps={cut}",
                             "DataArchiver/outputLastTimestep=false", *sets, layout=before))
        step = int(pieces.checkpoints[0].name[1:])
        self.assertLess(step, cut)
        report = self.well(pieces.restart(until, step=step, layout=after))
        for key in ("fingerprint", "steps", "time", "particles", "particles_dropped", "drift", "of_run", "errors"):
            self.assertEqual(report.get(key), expected.get(key), f"{scene} {sets} {key}")
        return uncut, pieces

    def test_sod(self):
        for after in ("[1,1,1]", "[3,1,1]", "[64,1,1]"):
            self.assert_same("ups/mpm/sod.ups", cut=100, before="[7,1,1]", after=after)
        self.assert_same("ups/mpm/sod.ups", TRACKED, cut=60, after="[7,1,1]")

    def test_redistribution(self):
        self.assert_same("ups/mpm/sod_redistribute.ups", cut=200, after="[5,1,1]")
        self.assert_same("ups/mpm/sod_redistribute.ups", RESEED, TRACKED, cut=200, before="[64,1,1]")

    def test_conserving(self):
        self.assert_same("ups/mpm/sod_conserving.ups", cut=90, before="[2,1,1]", after="[7,1,1]")

    def test_every_scene(self):
        """Interrupts between two remaps, if any: these occur every 4 steps, and the checkpoint is of step 6."""
        until = "Time/max_Timesteps=12"
        for scene in sorted(pathlib.Path("ups").glob("*/*.ups")):
            if scene.parent.name == "stability":
                continue  # some have one cell, and some die
            tube = ",1,1]</resolution>" in scene.read_text()
            before, after = ("[2,1,1]", "[7,1,1]") if tube else ("[2,3,1]", "[7,2,1]")
            if re.search(r"\[4,\d+,\d+\]</resolution>", scene.read_text()):
                after = "[4,2,1]"
            self.assert_same(scene, cut=9, until=until, before=before, after=after)

    def test_transfers_with_remap_on_a_periodic_grid(self):
        method = "MPM/conserving_gas_dynamics/"
        for transfer in ("apic", "affine_flip"):
            sets = (f"{method}transfer={transfer}", f"{method}remap/overfilled=1e-4",
                    "Grid/Level/Box/resolution=[16,16,1]")
            self.assert_same("ups/mpm/vortex.ups", *sets, cut=14, until="Time/max_Timesteps=25", before="[3,3,1]",
                             after="[2,1,1]")

    def test_particles_that_leave_the_grid_stay_counted(self):
        folder = self.folder()
        scene = folder.path / "open.ups"
        wall = '<Face side="x+"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
        scene.write_text(pathlib.Path("ups/mpm/sod.ups").read_text().replace(wall, ""))
        right = "MaterialProperties/MPM/material/geom_object[2]/"
        wind = (right + "velocity=[0.5,0,0]", right + "res=[8,1,1]")
        self.assert_same(scene, *wind, cut=100, after="[3,1,1]")
        self.assertGreater(self.well(folder.run(scene, *wind))["particles_dropped"], 0)

    def test_two_and_three_dimensions(self):
        self.assert_same("ups/mpm/sod.ups", *PLANE, cut=40, before="[3,2,1]", after="[40,6,1]")
        self.assert_same("ups/mpm/sod.ups", *SPACE, cut=20, after="[3,2,2]")
        self.assert_same("ups/heat/sine.ups", *PLANE, cut=30, after="[3,2,1]")

    def test_finite_volumes(self):
        self.assert_same("ups/euler/sod.ups", cut=40, after="[7,1,1]")

    def test_heat(self):
        self.assert_same("ups/heat/sine.ups", cut=50, after="[3,1,1]")

    def test_outputs_stay_at_their_times(self):
        sets = ("Time/clamp_time_to_output=true", "Time/max_delt_increase=0.1", "Time/delt_init=1e-5")
        self.assert_same("ups/mpm/sod.ups", *sets, cut=100, after="[2,1,1]")

    def test_the_archive_is_that_of_the_uncut_run(self):
        uncut, pieces = self.assert_same("ups/mpm/sod.ups", cut=130, after="[7,1,1]")
        self.assertEqual(light_files(pieces.uda), light_files(uncut.uda))
        self.assertEqual([path.name for path in pieces.path.glob("*.uda.*")], ["sod.uda.000"])
        self.assertEqual(len((pieces.uda / "KineticEnergy.dat").read_text().splitlines()), 1 + 219)

    def test_a_finished_run_is_extended(self):
        sets = ("Time/end_at_max_time_exactly=false", "DataArchiver/outputLastTimestep=false")
        longer, extended = self.folder(), self.folder()
        every = EVERY.format(1000)
        expected = self.well(longer.run("ups/mpm/sod.ups", "Time/maxTime=0.25", *sets))
        finished = self.well(extended.run("ups/mpm/sod.ups", every, *sets))
        again = self.well(extended.restart())
        self.assertEqual(bits_of(again), bits_of(finished))
        self.assertEqual(again["errors"], finished["errors"])
        report = self.well(extended.restart("Time/maxTime=0.25"))
        self.assertEqual(bits_of(report), bits_of(expected))
        self.assertEqual(light_files(extended.uda), light_files(longer.uda))
        self.assertEqual(self.well(extended.restart())["steps"], expected["steps"])

    def test_a_scene_that_saves_nothing_restarts_too(self):
        text = pathlib.Path("ups/heat/sine.ups").read_text()
        start, end = text.index("<save"), text.rindex("<save")
        folder = self.folder()
        scene = folder.path / "bare.ups"
        scene.write_text(text[:start] + text[text.index("/>", end) + 2:])
        full = self.well(folder.run(scene))
        self.assertEqual(list(folder.path.glob("*.uda*")), [])
        self.well(folder.run(scene, EVERY.format(10), "Time/max_Timesteps=25"))
        self.assertEqual(self.well(folder.restart(ALL, step=20))["fingerprint"], full["fingerprint"])
        self.assertEqual(sorted(path.name for path in folder.uda.iterdir()),
                         ["checkpoints", "index.xml", "input.xml", "run.json"])

    def test_what_steps_continue_must_be_in_the_checkpoint(self):
        """A restart may save more, but not what the steps before it should have carried along: they were left out."""
        folder = self.folder()
        self.well(folder.run("ups/solid/two_discs.ups", EVERY.format(5), "Time/max_Timesteps=10"))
        for name in ("p.displacement", "p.work", "ThermalEnergy", "g.temperature"):
            code, errors, _ = folder.restart("Time/max_Timesteps=12", f"DataArchiver/save[1]/@label={name}")
            self.assertEqual(code, 3, errors)
            self.assertRegex(errors, "the checkpoint has no .*, which the scene needs")
        code, errors, _ = folder.restart("Time/max_Timesteps=12", "DataAnalysis/Module/@name=energyBudget")
        self.assertEqual(code, 3, errors)
        self.well(folder.restart("Time/max_Timesteps=12", "DataArchiver/save[1]/@label=g.stressFS"))


if __name__ == "__main__":
    unittest.main()
