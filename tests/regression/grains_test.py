#!/usr/bin/env python3
"""Grains that do not touch are materials of their own: their motion, refused scenes, and equal results on any grid."""
import pathlib
import re
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import RefusedSceneTest, archive_of, columns, globals_of
from sus import ROOT, run
from uda import Folder

SCENE = "ups/solid/parting_grains.ups"
TEXT = (ROOT / SCENE).read_text()
# With the same particles in one material, grains stick until they are two cells apart.
BEFORE_WALLS = "Time/maxTime=0.5"


def occupied(archive, time=None):
    """The number of particles in each of the two materials."""
    counts = []
    for material in ("grains", "spare"):
        found = columns(archive, "p.x", material=material, time=time)
        counts.append(len(found["x [m]"]) if found else 0)
    return sorted(counts)


class Grains(unittest.TestCase):
    def test_part_and_meet_again(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(SCENE, folder)
            counts = {time: occupied(archive, time) for time in (0.0001, 0.5, 1.5, 2.6)}
        self.assertEqual(counts, {0.0001: [0, 128], 0.5: [64, 64], 1.5: [64, 64], 2.6: [64, 64]})
        collided = run(SCENE).report
        self.assertEqual((collided["particles"], collided["particles_removed"]), (128, 0))

    def test_do_not_act_on_each_other_once_apart(self):
        """A grain alone flies in the same way as one that has parted from another, from then on."""
        energies = globals_of(SCENE, "KineticEnergy", "TotalMomentum", sets=(BEFORE_WALLS,))
        for line in energies["TotalMomentum"]:
            self.assertLess(max(abs(value) for value in line[1:]), 1e-12)
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(SCENE, folder, BEFORE_WALLS)
            means = []
            for time in (0.2, 0.3, 0.4, 0.5):
                of = [columns(archive, "p.velocity", material=name, time=time) for name in ("grains", "spare")]
                means.append([sum(one["p.velocity_x [m/s]"]) / 64 for one in of])
        for grain in zip(*means):
            for speed in grain:
                self.assertAlmostEqual(speed, grain[0], delta=1e-12)
            self.assertGreater(abs(grain[0]), 0.5)

    def test_have_the_same_bits_on_any_patches_threads_and_ranks(self):
        prints = set()
        for layout, threads, ranks in (("1x1x1", 1, 1), ("4x3x1", 2, 1), ("7x2x1", 1, 2), ("2x2x1", 1, 4)):
            result = run(SCENE, options=("--quiet", "-layout", layout, "-nthreads", str(threads)), ranks=ranks)
            self.assertEqual(result.code, 0, result.err)
            prints.add((result.report["fingerprint"], result.report["steps"]))
        self.assertEqual(len(prints), 1)

    def test_have_the_same_bits_after_a_restart(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        expected = run(SCENE).report
        folder.run(SCENE, "DataArchiver/checkpoint/@timestepInterval=300", "Time/max_Timesteps=300")
        code, errors, report = folder.restart("Time/max_Timesteps=100000", step=300)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(report["fingerprint"], expected["fingerprint"])

    def test_end_the_run_if_there_are_too_few_materials(self):
        spare = re.compile(r'<material name="spare">.*?</material>', re.S)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "few.ups"
            scene.write_text(spare.sub("", TEXT))
            result = run(scene)
        self.assertEqual(result.code, 4)
        self.assertIn("there are more clusters of particles than materials with MatTypeIdx 0", result.err)


class StressFree(unittest.TestCase):
    def test_particles_keep_their_volume_beyond_the_critical_density(self):
        """With a critical density of 999, F of the grain that is pulled apart cannot grow by more than 0.1 %."""
        text = TEXT.replace("<critical_density>900</critical_density>",
                            "<critical_density>999</critical_density><stress_free>true</stress_free>")
        text = text.replace('<save label="p.x"/>', '<save label="p.x"/><save label="p.density"/>')
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "free.ups"
            densities = []
            for given in (text, text.replace("<stress_free>true", "<stress_free>false")):
                scene.write_text(given)
                archive = archive_of(str(scene), str(pathlib.Path(folder) / str(len(densities))),
                                     "Time/maxTime=0.05")
                densities.append(min(value for name in ("grains", "spare")
                                     for value in columns(archive, "p.density", material=name)["p.density [kg/m^3]"]))
        self.assertGreaterEqual(densities[0], 999)
        self.assertLess(densities[1], 995)


class RefusedGrains(RefusedSceneTest):
    def test_of_unclear_materials(self):
        for old, new, sentence in (
                ("<critical_density>900</critical_density>", "",
                 "missing tag <critical_density> in <material>: needed with <DoGranularMPM>"),
                ("<MatTypeIdx>0</MatTypeIdx>", "", "missing tag <MatTypeIdx> in <material>: needed with <DoGranularMPM>"),
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
        text = re.sub(r'<material name="spare">.*?</material>', "", TEXT, flags=re.S)
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "alone.ups"
            scene.write_text(text.replace("<DoGranularMPM>true", "<DoGranularMPM>false"))
            result = run(scene, "Time/max_Timesteps=2", options=())
        self.assertEqual(result.code, 0)
        self.assertIn("critical_density: does nothing without <DoGranularMPM>", result.out + result.err)


if __name__ == "__main__":
    unittest.main()
