#!/usr/bin/env python3
"""What a scene saves and measures, and when, does not change its results."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, run

FEW, MANY = 300, 900  # outputs: HDF5 takes most of its memory by the 256th
GROWTH = 3e6  # bytes of memory more for MANY
CLAMPED = "Time/clamp_time_to_output=true"


class Outputs(unittest.TestCase):
    def run_without(self, scene, tags, *sets):
        """Returns the report of a scene without the tags that match `tags`."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text(re.sub(tags, "", (ROOT / scene).read_text(), flags=re.S))
            result = run(path, *sets, outputs=True)
            self.assertEqual(result.code, 0, result.err)
            return result.report

    def test_a_state_is_the_same_whatever_is_measured_and_saved(self):
        for scene in ("ups/mpm/sod_conserving.ups", "ups/mpm/sod.ups", "ups/euler/sod.ups", "ups/heat/sine.ups"):
            short = "Time/max_Timesteps=20"
            whole = run(scene, short).report
            bare = self.run_without(scene, "<DataAnalysis>.*</DataAnalysis>|<save [^>]*>", short)
            self.assertEqual(bare["fingerprint"], whole["fingerprint"], scene)
            self.assertNotEqual(whole["fingerprint"], run(scene, "Time/max_Timesteps=19").report["fingerprint"])

    def test_steps_end_at_outputs_though_nothing_is_saved(self):
        report = self.run_without("ups/heat/sine.ups", "<save [^>]*>", CLAMPED)
        self.assertEqual((report["ended"], report["time"]), ("maxTime", 0.1))

    def test_outputs_before_time_zero(self):
        report = run("ups/euler/sod.ups", CLAMPED, "Time/initTime=-0.15", "Time/maxTime=0.05", outputs=True).report
        self.assertEqual((report["ended"], report["time"]), ("maxTime", 0.05))

    def test_outputs_that_are_much_nearer_than_time_steps(self):
        result = run("ups/heat/sine.ups", "DataArchiver/outputInterval=1e-12", "Time/max_Timesteps=3", outputs=True)
        self.assertEqual(len([name for name in result.files if name.endswith(".h5")]), 4)

    def test_many_outputs_need_no_more_memory_than_few(self):
        """The lists of outputs, XDMF and VTKHDF, are kept on disk."""
        for scene in ("ups/mpm/sod.ups", "ups/euler/sod_levels.ups"):
            reports = []
            for outputs in (FEW, MANY):
                sets = ("Time/maxTime=1e9", f"Time/max_Timesteps={outputs}", "DataArchiver/outputInterval=0",
                        "DataArchiver/outputTimestepInterval=1")
                result = run(scene, *sets, outputs=True)
                self.assertEqual(len([name for name in result.files if name.endswith(".h5")]), outputs + 1, result.err)
                reports.append(result.report)
            few, many = reports
            self.assertLess(many["memory"]["peak"] - few["memory"]["peak"], GROWTH, scene)

    def test_what_no_later_step_needs_has_a_fingerprint_of_its_own(self):
        """Scalars that tracers carry change nothing else."""
        scene = "ups/ice/tracers.ups"
        values = re.findall("<initialValue>(.*?)</initialValue>", (ROOT / scene).read_text())
        reports = []
        for changed in ("", "1"):
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder, "scene.ups")
                path.write_text((ROOT / scene).read_text().replace("<initialValue>", f"<initialValue>{changed}"))
                reports.append(run(path, "Time/max_Timesteps=3").report)
        self.assertTrue(values)
        self.assertEqual(*(report["fingerprint"] for report in reports))
        self.assertNotEqual(*(report["fingerprint_of_others"] for report in reports))
        self.assertNotIn("fingerprint_of_others", run("ups/mpm/vortex.ups", "Time/max_Timesteps=3").report)

    def test_the_fingerprint_of_a_scene_without_state_covers_what_is_saved(self):
        """No step of Poisson's equation depends on an earlier one."""
        scene = "ups/poisson/sine.ups"
        found = {run(scene).report["fingerprint"] for _ in range(2)}
        self.assertEqual(len(found), 1)
        self.assertNotIn("0" * 16, found)
        self.assertNotIn(run(scene, "Time/max_Timesteps=5").report["fingerprint"], found)


if __name__ == "__main__":
    unittest.main()
