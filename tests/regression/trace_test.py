#!/usr/bin/env python3
"""A trace is a file that Chrome and Perfetto read: named spans, nested on each thread, of tasks, messages and
outputs."""
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from uda import Folder

SCENE = ("ups/mpm/vortex.ups", "Time/max_Timesteps=5", "Grid/Level/Box/patches=[4,2,1]")


class Trace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = Folder()
        cls.addClassCleanup(folder.cleanup)
        path = folder.path / "trace.json"
        code, err, cls.report = folder.finish([SCENE[0], "--output", folder.path, "-nthreads", "2", "--trace", path],
                                              SCENE[1:])
        assert code == 0, err
        cls.spans = [event for event in json.loads(path.read_text())["traceEvents"] if event["ph"] == "X"]

    def of_category(self, category):
        return [span for span in self.spans if span["cat"] == category]

    def test_each_span_has_a_name_a_category_a_rank_and_a_thread(self):
        for span in self.spans:
            self.assertTrue(span["name"])
            self.assertIn(span["cat"], ("task", "message", "output", "wait"))
            self.assertEqual(span["pid"], 0)
            self.assertGreaterEqual(span["tid"], 0)
            self.assertGreaterEqual(span["dur"], 0)

    def test_each_task_of_the_step_runs_on_each_patch_in_each_step(self):
        steps = self.report["steps"]
        for name in self.report["tasks"]["kept"]:
            if name != "relocate":
                seen = [span["args"]["patch"] for span in self.of_category("task") if span["name"] == name]
                for patch in range(8):
                    self.assertGreaterEqual(seen.count(patch), steps, name)

    def test_ghosts_and_outputs_are_there(self):
        self.assertEqual({span["name"] for span in self.of_category("message")}, {"fill ghosts", "link ghosts"})
        self.assertIn("save", {span["name"] for span in self.of_category("output")})

    def test_spans_of_a_thread_are_nested(self):
        for thread in {span["tid"] for span in self.spans}:
            open_until = []
            spans = [(round(1000 * span["ts"]), round(1000 * span["dur"]))
                     for span in self.spans if span["tid"] == thread]
            for start, length in sorted(spans, key=lambda span: (span[0], -span[1])):
                while open_until and open_until[-1] <= start:
                    open_until.pop()
                if open_until:
                    self.assertLessEqual(start + length, open_until[-1])
                open_until.append(start + length)

    def test_the_report_says_where_the_time_of_the_threads_went(self):
        use = self.report["wall"]["use"]
        for what in ("task", "message", "output"):
            self.assertGreater(use[what], 0)
        self.assertGreaterEqual(use["wait"], 0)
        self.assertGreaterEqual(self.report["wall"]["imbalance"], 1)
        self.assertEqual(self.report["layout"]["threads"], 2)

    def test_without_it_there_is_no_file_and_the_same_result(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        _, _, report = folder.run(*SCENE)
        self.assertEqual(report["fingerprint"], self.report["fingerprint"])
        self.assertEqual({path.name for path in folder.path.iterdir()}, {"report.json", "vortex.uda", "vortex.uda.000"})


if __name__ == "__main__":
    unittest.main()
