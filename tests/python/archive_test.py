#!/usr/bin/env python3
"""Tests of tushar.open: lazy arrays, particles over time, messages, memory: python3 tests/python/archive_test.py"""
import os
import subprocess
import sys
import tempfile
import unittest

import support

support.ensure("h5py", "numpy")

import h5py
import numpy as np

import fake_uda
import tushar
from in_folder import InFolder

LARGE = """
import resource, sys
sys.path.insert(0, {library!r})
import tushar
archive = tushar.open({path!r})
last = archive[-1]
assert last["p.density"].shape == ({count},) and last["c.density"].size == 512**3
assert archive.materials == ["gas"] and last.grid.dimension == 3
assert last["p.density"][5:8].tolist() == [7.0] * 3 and last["c.density"][0, 0, :2].tolist() == [3.0] * 2
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


class WithArchives(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sod = fake_uda.make_sod(cls.folder)
        cls.plate = fake_uda.make_heat(cls.folder, (6, 4, 1), 2, "plate")
        cls.disks = fake_uda.make_disks(cls.folder)


class Outputs(WithArchives):
    def test_an_archive_is_a_sequence_of_outputs(self):
        archive = tushar.open(self.sod)
        self.assertEqual(len(archive), 3)
        self.assertEqual([snapshot.time for snapshot in archive], [0.0, 0.1, 0.2])
        self.assertEqual([snapshot.step for snapshot in archive[1:]], [100, 200])
        self.assertEqual((archive.at(0.11).index, archive[-1].index), (1, 2))
        self.assertIn("Sod's shock tube, 3 outputs", repr(archive))

    def test_says_what_is_in_it(self):
        archive = tushar.open(self.disks)
        self.assertEqual(archive.materials, ["left", "right", "none"])
        velocity = archive.variables["p.velocity"]
        self.assertEqual((velocity.unit, velocity.components, velocity.description), ("m/s", 3, "the p.velocity"))
        self.assertEqual(archive[-1].variables, ["p.x", "p.density", "p.velocity"])
        self.assertIn("p.x", archive[-1])
        self.assertNotIn("p.stress", archive[-1])

    def test_accepts_paths(self):
        import pathlib
        self.assertEqual(len(tushar.open(pathlib.Path(self.sod))), 3)

    def test_a_wrong_name_gets_the_nearest(self):
        archive = tushar.open(self.sod)
        density = r"no particle variable 'p.densty' \(did you mean 'p.density'"
        for wrong, sentence in ((lambda: archive[-1]["p.densty"], density),
                                (lambda: archive.globals["KinetcEnergy"], r"did you mean 'KineticEnergy'"),
                                (lambda: archive["p.x"], r"outputs are selected by number: archive\[-1\]\['p.x'\]"),
                                (lambda: archive[1.5], r"by whole numbers, found 1.5; archive.at\(1.5\)"),
                                (lambda: archive.at(float("nan")), "found the time nan, expected a finite number"),
                                (lambda: archive.at(float("inf")), "found the time inf, expected a finite number"),
                                (lambda: archive[7], "no output 7: .* has 3, 0 to 2"),
                                (lambda: archive.report, "there is no report .* sus --json report.json"),
                                (lambda: archive.particles(), 'add <save label="p.particleID"/>'),
                                (lambda: archive[-1].particles("gass"), r"no material 'gass' \(did you mean 'gas'")):
            with self.assertRaisesRegex(tushar.ArchiveError, sentence):
                wrong()

    def test_of_an_unreadable_log_has_no_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            sod = fake_uda.make_sod(folder)
            for text in ("3", "[null]", '{"runs": 3}', "{"):
                with open(os.path.join(sod, "run.json"), "w", encoding="utf-8") as file:
                    file.write(text)
                self.assertEqual(tushar.open(sod).runs, [])

    def test_says_where_a_global_is_no_number(self):
        for text, sentence in (("# time\n0 1\n0.1 bad\n", r"KineticEnergy.dat:3: found 'bad', expected a number"),
                               ("# time\n0 1\n\xff 2\n", r"KineticEnergy.dat:3: found '.+', expected a number"),
                               ("0 1 2\n", r"KineticEnergy.dat' has 3 numbers in its first line, expected 2")):
            with tempfile.TemporaryDirectory() as folder:
                sod = fake_uda.make_sod(folder)
                with open(os.path.join(sod, "KineticEnergy.dat"), "w", encoding="latin-1") as file:
                    file.write(text)
                with self.assertRaisesRegex(tushar.ArchiveError, sentence):
                    tushar.open(sod).globals["KineticEnergy"]

    def test_says_which_file_cannot_be_read(self):
        with tempfile.TemporaryDirectory() as folder:
            sod = fake_uda.make_sod(folder)
            with open(os.path.join(sod, "t00200.h5"), "w", encoding="utf-8") as file:
                file.write("nothing")
            with self.assertRaisesRegex(tushar.ArchiveError, "cannot read '.*t00200.h5'"):
                tushar.open(sod)[-1]["p.density"]


class Arrays(WithArchives):
    def test_they_have_a_unit_and_take_part_in_arithmetic(self):
        last = tushar.open(self.sod)[-1]
        density, energy = last["p.density"], last["p.internalEnergy"]
        self.assertEqual((density.unit, density.shape, density.ndim, len(density)), ("kg/m^3", (400,), 1, 400))
        self.assertIn("not read yet", repr(density))
        np.testing.assert_array_equal(density * energy, density.values * energy.values)
        np.testing.assert_array_equal(np.sqrt(density), np.sqrt(density.values))
        np.testing.assert_array_equal(np.asarray(density, dtype="f4"), density.values.astype("f4"))
        self.assertEqual((density.max(), np.min(density)), (density.values.max(), density.values.min()))

    def test_any_index_gives_what_numpy_gives(self):
        last = tushar.open(self.disks)[-1]
        x = last["p.x"]
        values = x.values
        count = len(x)
        half = last.materials["left"]
        for key in (0, -1, half, count - 1, slice(None), slice(half - 3, half + 3), slice(3, None, 7), slice(5, 2),
                    slice(None, None, -1), slice(-4, None), (slice(None), 1), (half + 1, 2),
                    (slice(1, count, 5), slice(0, 2)),
                    Ellipsis, (Ellipsis, 0), [3, 1, half], values[:, 0] > 0.5, np.int64(4)):
            np.testing.assert_array_equal(x[key], values[key], err_msg=str(key))
        for wrong in (count, -count - 1):
            with self.assertRaises(IndexError):
                x[wrong]

    def test_they_outlive_the_output_that_they_come_from(self):
        density = tushar.open(self.sod)[-1]["p.density"]
        self.assertEqual(len(density.values), 400)

    def test_a_closed_output_opens_again(self):
        with tushar.open(self.sod)[-1] as last:
            self.assertEqual(len(last["p.density"].values), 400)
        self.assertEqual(len(last["p.density"].values), 400)


class ParticlesOverTime(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.path = fake_uda.make_moving(cls.folder)

    def test_they_go_by_id_and_are_no_number_where_they_are_not(self):
        tracks = tushar.open(self.path).particles(ids=[30, 20, 40])
        np.testing.assert_array_equal(tracks["p.x"][:, :, 0], [[30, 20, np.nan], [31, np.nan, 41]])
        np.testing.assert_array_equal(tracks["p.mass"], [[np.nan, 20, np.nan], [np.nan] * 3])
        np.testing.assert_array_equal(tracks.times, [0, 1])

    def test_all_of_the_last_output_are_taken_if_none_are_named(self):
        archive = tushar.open(self.path)
        self.assertEqual(archive.particles().ids.tolist(), [10, 30, 40])
        self.assertEqual(archive.particles(material="b").ids.tolist(), [30, 40])

    def test_many_particles_come_in_the_order_of_the_ids_asked_for(self):
        from tushar.tracks import rows_of
        with h5py.File("many", "w", driver="core", backing_store=False) as file:
            file["x"] = np.arange(1000.0)
            rows = np.random.default_rng(1).permutation(1000)[:300]
            np.testing.assert_array_equal(rows_of(file["x"], rows), rows)

    def test_an_id_that_was_never_there_is_told(self):
        with self.assertRaisesRegex(tushar.ArchiveError, "no output has a particle with id 11, 12"):
            tushar.open(self.path).particles(ids=[10, 11, 12])["p.x"]

    def test_an_id_of_several_materials_needs_one(self):
        with tempfile.TemporaryDirectory() as folder:
            path = fake_uda.make_moving(folder)
            with h5py.File(os.path.join(path, "t00001.h5"), "r+") as file:
                file["particles/b/p.particleID"][1] = 10
            archive = tushar.open(path)
            sentence = "several materials, a and b, have the id 10; choose one: .*material='b'"
            for tracks in (archive.particles(ids=[30, 10]), archive.particles()):
                with self.assertRaisesRegex(tushar.ArchiveError, sentence):
                    tracks["p.x"]
            np.testing.assert_array_equal(archive.particles([10], "b")["p.x"][:, 0, 0], [np.nan, 41])
            np.testing.assert_array_equal(archive.particles([10], "a")["p.x"][:, 0, 0], [10, 11])

    def test_only_whole_numbers_from_0_on_are_ids(self):
        archive = tushar.open(self.path)
        for ids in ([-1], [10.5], ["10"], [True]):
            with self.assertRaisesRegex(tushar.ArchiveError, "expected ids of particles"):
                archive.particles(ids=ids)
        self.assertEqual(archive.particles(ids=[])["p.x"].shape, (2, 0, 3))


class Memory(unittest.TestCase):
    def test_opening_33_gigabytes_takes_less_than_100_megabytes(self):
        count = 10**9
        with tempfile.TemporaryDirectory() as where:
            folder = fake_uda.make_folder(where, "large")
            variables = [("p.x", "particle", 3, "m", "gas"), ("p.density", "particle", 1, "kg/m^3", "gas"),
                         ("c.density", "cell", 1, "kg/m^3", "")]
            fake_uda.write_index(folder, variables, [], [(0, 0.0)], "Large")
            with fake_uda.open_output(folder, 0, 0.0, (512, 512, 512), (1, 1, 1), 3) as file:
                group = file.create_group("particles/gas")
                group.create_dataset("p.x", (count, 3), "f8", chunks=(10**5, 3))
                group.create_dataset("p.density", (count,), "f8", chunks=(10**5,), fillvalue=7)
                file.create_dataset("cells/c.density", (512,) * 3, "f8", chunks=(1, 512, 512), fillvalue=3)
            script = LARGE.format(library=str(support.LIBRARY), path=folder, count=count)
            done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLess(int(done.stdout) * 1024, 100e6)


if __name__ == "__main__":
    unittest.main()
