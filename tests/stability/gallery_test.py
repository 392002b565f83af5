#!/usr/bin/env python3
"""The short gallery: the default method keeps what it promises in every case; the paper's fails as it must, in a
sentence."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

sys.path.insert(0, str(ROOT / "tools/python"))
from tushar.studies import scene_variants
from tushar.studies.gallery import CASES, METHODS
from tushar.program import run_scene
from tushar.studies.stability import Gallery, is_stable, judge, scene_of, write_scene

FATAL = ("toro_2", "toro_4", "toro_5", "leblanc", "ratio_1e6")  # for the paper's method
SENTENCE = re.compile(r"p\.(?:density|internalEnergy) became -\S+ \S+ \(was \S+\), but must be "
                      r"(?:greater than|at least) 0: particle \d+ in cell \(\d+\) at x = \S+ m; around it: .*; .* "
                      r"(?:is|are) out of bounds \(task \S+, patch 0, material gas, step (\d+), "
                      r"time \S+ s, time step \S+ s\)")


def case_of(name):
    return next(case for case in CASES if case.name == name)


class ShortGallery(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.gallery = Gallery(folder.name, SUS)

    def test_the_default_method_keeps_its_promises_in_every_case(self):
        method = METHODS["default"]
        for case in CASES:
            if case.long or not method.runs(case):
                continue
            with self.subTest(case=case.name):
                run = self.gallery.run(case, method)
                self.assertEqual(judge(run, case, True), ["pass"], run)

    def test_a_tube_that_moves_has_nearly_the_error_of_the_one_at_rest(self):
        resting, moving = (self.gallery.run(case_of(name), METHODS["default"]) for name in ("sod", "sod_moving"))
        self.assertLess(moving["error"], 1.25 * resting["error"])

    def test_finite_volumes_are_measured_where_they_have_no_particles(self):
        run = self.gallery.run(case_of("contact"), METHODS["volumes"])
        self.assertEqual(judge(run, case_of("contact"), False), ["pass"], run)
        self.assertLess(run["error"], 1e-13)

    def test_the_papers_method_fails_where_it_must_and_says_so(self):
        for name in FATAL:
            with self.subTest(case=name):
                run = self.gallery.run(case_of(name), METHODS["paper"])
                found = SENTENCE.match(run["failure"])
                self.assertTrue(found, run["failure"])
                self.assertEqual(int(found[1]), run["steps"] + 1)

    def test_a_run_that_dies_puts_no_nan_into_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "dies.ups")
            root = scene_of(case_of("leblanc"), METHODS["paper"])
            scene_variants.save(root, "TotalMass", "TotalEnergy", "LeastDensity")
            scene_variants.write(root, scene)
            done = subprocess.run([SUS, scene, "--quiet", "--output", folder], capture_output=True, text=True)
            self.assertEqual(done.returncode, 4, done.stderr)
            files = list(pathlib.Path(folder).glob("*.uda.000/*.dat"))
            self.assertEqual(len(files), 3)
            for file in files:
                self.assertNotRegex(file.read_text().lower(), "nan|inf", file.name)

    def test_what_was_not_measured_is_not_passed(self):
        run = self.gallery.run(case_of("sod"), METHODS["default"])
        self.assertEqual(judge(run, case_of("sod"), True), ["pass"])
        for name in ("entropy", "error", *case_of("sod").keeps):
            without = {key: value for key, value in run.items() if key != name}
            self.assertRaises(KeyError, judge, without, case_of("sod"), True)

    def test_a_written_scene_is_the_one_that_is_run(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, method in (("relaxation_1000", "affine_flip"), ("on_faces", "paper_tracked")):
                with self.subTest(case=name):
                    case, scene = case_of(name), pathlib.Path(folder, f"{name}.ups")
                    write_scene(case, METHODS[method], scene)
                    report = run_scene(SUS, scene, [], folder)
                    self.assertEqual(report["fingerprint"], self.gallery.run(case, METHODS[method])["fingerprint"])

    def test_too_large_a_time_step_is_found(self):
        case, method = case_of("sod"), METHODS["paper"]
        first = self.gallery.run(case, method)
        self.assertTrue(is_stable(self.gallery.run(case, method, 0.9), first))
        self.assertFalse(is_stable(self.gallery.run(case, method, 16.0), first))


if __name__ == "__main__":
    unittest.main()
