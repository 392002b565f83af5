#!/usr/bin/env python3
"""Grains that do not touch are materials of their own: their motion, refused scenes, and equal results on any grid."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import RefusedSceneTest, archive_of, columns, globals_of
from sus import ROOT, bits_of, run
from uda import Folder

SCENE = "ups/solid/passing_grains.ups"
TEXT = (ROOT / SCENE).read_text()
SPARE = re.compile(r' *<material name="spare\d">.*?</material>\n', re.S)
NAMES = ("grains", "spare0", "spare1")


def velocities(archive, time, names=NAMES):
    """For each material, the number of its particles and their mean velocity along x and y [m/s]."""
    found = []
    for name in names:
        of = columns(archive, "p.velocity", material=name, time=time)
        count = len(of.get("x [m]", ()))
        found.append((count, *(sum(of[f"p.velocity.{axis} [m/s]"]) / count for axis in "xy" if count)))
    return found


class Grains(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.archive = archive_of(SCENE, cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_pass_without_acting_on_each_other(self):
        """Two grains fly past each other for .4 s, at a distance of .6 cells; the third one rests."""
        for time in (0.1, 0.2, 0.3):
            lower, resting, upper = velocities(self.archive, time)
            for grain, speed in ((lower, 0.5), (resting, 0), (upper, -0.5)):
                self.assertEqual(grain[0], 64)
                self.assertAlmostEqual(grain[1], speed, delta=1e-13)
                self.assertAlmostEqual(grain[2], 0, delta=1e-13)

    def test_become_one_when_they_meet(self):
        for time in (0.5, 0.6, 0.7, 0.8):
            both, none, upper = velocities(self.archive, time)
            self.assertEqual((both[0], none, upper[0]), (128, (0,), 64))
            self.assertAlmostEqual(both[1], 0.25, delta=1e-13)
            self.assertAlmostEqual(upper[1], -0.5, delta=1e-13)

    def test_would_act_on_each_other_in_one_velocity_field(self):
        text = SPARE.sub("", TEXT).replace("<DoGranularMPM>true", "<DoGranularMPM>false")
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "together.ups"
            scene.write_text(text)
            energies = globals_of(str(scene), "KineticEnergy", until=0.3)["KineticEnergy"]
        apart = globals_of(SCENE, "KineticEnergy", until=0.3)["KineticEnergy"]
        self.assertAlmostEqual(apart[-1][1], apart[0][1], delta=1e-6, msg="they are one material in the first step")
        self.assertLess(energies[-1][1], 0.9 * energies[0][1])

    def test_have_the_same_bits_on_any_patches_threads_and_ranks(self):
        prints = set()
        for layout, threads, ranks in (("1x1x1", 1, 1), ("4x3x1", 2, 1), ("7x2x1", 1, 2), ("2x2x1", 1, 4)):
            result = run(SCENE, options=("--quiet", "-layout", layout, "-nthreads", str(threads)), ranks=ranks)
            self.assertEqual(result.code, 0, result.err)
            prints.add((bits_of(result.report), result.report["steps"]))
        self.assertEqual(len(prints), 1)

    def test_have_the_same_bits_after_a_restart(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        expected = run(SCENE).report
        folder.run(SCENE, "DataArchiver/checkpoint/@timestepInterval=150", "Time/max_Timesteps=150")
        code, errors, report = folder.restart("Time/max_Timesteps=100000", step=150)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(bits_of(report), bits_of(expected))

    def test_end_the_run_if_there_are_too_few_materials(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "few.ups"
            scene.write_text(SPARE.sub("", TEXT))
            result = run(scene)
        self.assertEqual(result.code, 4)
        self.assertIn("there are more clusters of particles than materials with MatTypeIdx 0", result.err)


class StressFree(unittest.TestCase):
    def growth(self, is_free):
        """The volume of all particles, relative to that at the start, after a grain has been stretched for .02 s."""
        spare = SPARE.search(TEXT).group(0)
        text = SPARE.sub("", TEXT).replace("<velocity>[0.5,0,0]", "<velocity>[5*(x-0.7),0,0]")
        text = text.replace("    </MPM>\n  </Mat", "".join(spare.replace("spare0", f"spare{k}") for k in range(192))
                            + "    </MPM>\n  </Mat")
        text = text.replace("<critical_density>900</critical_density>",
                            f"<critical_density>999</critical_density><stress_free>{is_free}</stress_free>")
        text = text.replace('<save label="p.x"/>', '<save label="TotalVolumeDeformed"/>')
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "free.ups"
            scene.write_text(text)
            volumes = globals_of(str(scene), "TotalVolumeDeformed", until=0.02)["TotalVolumeDeformed"]
        return volumes[-1][1] / (192 * 0.025 * 0.025 * 0.05)

    def test_particles_keep_their_volume_beyond_the_critical_density(self):
        self.assertLessEqual(self.growth("true"), 1000 / 999)
        self.assertGreater(self.growth("false"), 1.005)


class RefusedGrains(RefusedSceneTest):
    def test_of_unclear_materials(self):
        for old, new, sentence in (
                ("<critical_density>900</critical_density>", "",
                 "missing tag <critical_density> in <material>: needed with <DoGranularMPM>"),
                ("<MatTypeIdx>0</MatTypeIdx>", "",
                 "missing tag <MatTypeIdx> in <material>: needed with <DoGranularMPM>"),
                ("<critical_density>900", "<critical_density>1001",
                 "found 1001, expected at most the <density>, 1000: otherwise the particles of a body do not touch"),
                ("<bulk_modulus>100000", "<bulk_modulus>100001",
                 "has the MatTypeIdx of 'grains', but another density, constitutive model or other constant"),
                ("<DoGranularMPM>true</DoGranularMPM>", "",
                 "missing tag <geom_object> in <material> (a body of material at the start)"),
                ("<DoGranularMPM>true", "<axisymmetric>true</axisymmetric><DoGranularMPM>true",
                 "axisymmetric: is not available with <DoGranularMPM>")):
            with self.subTest(sentence):
                self.assert_refused(TEXT.replace(old, new, 1), sentence)

    def test_tags_of_grains_alone_are_noted(self):
        text = SPARE.sub("", TEXT)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "alone.ups"
            scene.write_text(text.replace("<DoGranularMPM>true", "<DoGranularMPM>false"))
            result = run(scene, "Time/max_Timesteps=2", options=())
        self.assertEqual(result.code, 0)
        self.assertIn("critical_density: does nothing without <DoGranularMPM>", result.out + result.err)


if __name__ == "__main__":
    unittest.main()
