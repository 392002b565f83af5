#!/usr/bin/env python3
"""Tests of tools/uda, tools/plot and their library: python3 tests/tools/uda_test.py"""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

TOOLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools")
sys.path[:0] = [os.path.join(TOOLS, "python"), os.path.dirname(os.path.abspath(__file__))]
from tushar.interpreter import ensure

ensure("h5py", "matplotlib")

import h5py
import numpy as np

import fake_uda
from tushar import Archive, ArchiveError
from tushar.figure import Figure


def run(tool, *arguments):
    """Returns exit code, standard output and standard error of a tool."""
    done = subprocess.run([sys.executable, os.path.join(TOOLS, tool), *arguments], capture_output=True, text=True,
                          encoding="utf-8")
    return done.returncode, done.stdout, done.stderr


class WithArchives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.sod = fake_uda.make_sod(cls.folder.name)
        cls.part = fake_uda.make_sod(cls.folder.name, "part", leave_out=("p.pressure", "p.internalEnergy"))
        cls.heat = fake_uda.make_heat(cls.folder.name)
        cls.plate = fake_uda.make_heat(cls.folder.name, (6, 4, 1), 2, "plate")
        cls.disks = fake_uda.make_disks(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)


class Library(WithArchives):
    def test_reads_the_link_and_the_folder_alike(self):
        for path in (self.sod, self.sod + "/", self.sod + ".000"):
            self.assertEqual(Archive(path).times, [0.0, 0.1, 0.2])
        self.assertEqual(Archive(self.sod).steps, [0, 100, 200])
        self.assertEqual(Archive(self.sod).title, "Sod's shock tube")

    def test_returns_particles_of_the_last_output_unless_told(self):
        uda = Archive(self.sod)
        x = uda[-1]["p.x"][:, 0]
        np.testing.assert_array_equal(uda[-1]["p.density"], fake_uda.sod(x, 0.2)[0])
        np.testing.assert_array_equal(uda[1]["p.density"], fake_uda.sod(x, 0.1)[0])

    def test_joins_the_materials_in_the_order_of_the_scene(self):
        uda = Archive(self.disks)
        left, right = uda[-1]["p.density", "left"], uda[-1]["p.density", "right"]
        self.assertEqual(list(uda[-1].materials.values()), [len(left), len(right), 0])
        np.testing.assert_array_equal(uda[-1]["p.density"], np.concatenate([left, right]))
        self.assertEqual(len(uda[-1]["p.density", "none"]), 0)

    def test_shapes_fields_by_z_y_x(self):
        uda = Archive(self.plate)
        self.assertEqual(uda[-1]["c.temperature"].shape, (1, 4, 6))
        self.assertEqual(uda[-1]["g.mass"].shape, (1, 5, 7))

    def test_places_cells_and_nodes(self):
        grid = Archive(self.plate).grid
        self.assertEqual(grid.axes, [0, 1])
        np.testing.assert_allclose(grid.coordinates("cell")[1], [0.125, 0.375, 0.625, 0.875])
        np.testing.assert_allclose(grid.coordinates("node")[1], [0, 0.25, 0.5, 0.75, 1])
        np.testing.assert_allclose(grid.coordinates("node")[2], [0.5])

    def test_reads_globals_without_a_line_that_is_not_complete(self):
        series = Archive(self.sod).globals["KineticEnergy"]
        times, energy = series.times, series.values
        np.testing.assert_array_equal(times, [0, 0.1, 0.2])
        np.testing.assert_array_equal(energy, [0, 0.05, 0.1])

    def test_reads_the_exact_solution(self):
        self.assertEqual(set(Archive(self.sod)[-1].reference), {"x", "density", "velocity", "pressure", "energy"})
        self.assertEqual(Archive(self.heat)[-1].reference, {})

    def test_finds_the_nearest_time(self):
        self.assertEqual(Archive(self.sod).index_at(0.11), 1)

    def test_knows_outputs_that_the_index_does_not_list_yet(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = Archive(fake_uda.make_sod(folder))
            index = os.path.join(folder, "sod.uda", "index.xml")
            before = archive.steps, archive.times, archive.files
            with open(index, encoding="utf-8") as file:
                lines = [line for line in file if f">{archive.steps[-1]}<" not in line]
            with open(index, "w", encoding="utf-8") as file:
                file.writelines(lines)
            archive.reload()
            self.assertEqual((archive.steps, archive.times, archive.files), before)
            open(os.path.join(folder, "sod.uda", "t99999.h5"), "wb").close()  # none of sus
            archive.reload()
            self.assertEqual(archive.steps, before[0])

    def test_refuses_an_archive_of_a_newer_format(self):
        with tempfile.TemporaryDirectory() as folder:
            index = os.path.join(fake_uda.make_sod(folder), "index.xml")
            with open(index, encoding="utf-8") as file:
                text = file.read()
            with open(index, "w", encoding="utf-8") as file:
                file.write(text.replace("<tushar_archive version", '<tushar_archive format="7" version'))
            with self.assertRaisesRegex(ArchiveError, "has format 7, but this reader supports only formats up to 2; "
                                                      "it was written by sus 0.1.0"):
                Archive(os.path.dirname(index))

    def test_lists_its_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = Archive(fake_uda.make_sod(folder))
            self.assertEqual(archive.runs, [])
            with open(os.path.join(archive.folder, "run.json"), "w", encoding="utf-8") as file:
                file.write('{"format": 1, "runs": [{"ranks": 2, "end": null}]}')
            self.assertEqual([run["ranks"] for run in archive.runs], [2])

    def test_names_what_is_there_when_a_name_is_wrong(self):
        uda = Archive(self.sod)
        with self.assertRaisesRegex(ArchiveError,
                                    r"no particle variable 'p.densty' \(did you mean 'p.density'\?\); there is"):
            uda[-1]["p.densty"]
        with self.assertRaisesRegex(ArchiveError, r"no material 'Gas' \(did you mean 'gas'\?\)"):
            uda[-1]["p.density", "Gas"]
        with self.assertRaisesRegex(ArchiveError, r"no output 7: .* has 3, 0 to 2"):
            uda[7]["p.density"]

    def test_says_where_an_archive_may_be(self):
        os.unlink(self.disks)
        with self.assertRaisesRegex(ArchiveError, r"is no folder; there is '.*disks.uda.000'"):
            Archive(self.disks)
        os.symlink("disks.uda.000", self.disks)
        with self.assertRaisesRegex(ArchiveError, "has no index.xml, so it is not an archive; there is '.*.uda'"):
            Archive(self.folder.name)
        for path, sentence in ((self.path("plat"), "'.*/plat' is no folder; there is '.*/plate.uda'"),
                               (self.path("unlike.uda"), "'.*/unlike.uda' is no folder$"),
                               (self.sod + "/t00000.h5", "is a file of an archive, which is the folder '.*/sod.uda'"),
                               (__file__, "is a file, but an archive is a folder")):
            with self.assertRaisesRegex(ArchiveError, sentence):
                Archive(path)

    def test_says_what_is_wrong_with_an_index(self):
        folder = fake_uda.make_folder(self.folder.name, "strange")
        damaged = "<a><timesteps><timestep>one</timestep></timesteps></a>"
        for index, sentence in (("<Uintah_DataArchive/>", "is an archive of Uintah"),
                                ("<a", "cannot read '.*index.xml': "), (damaged, "index.xml', which is damaged")):
            with open(os.path.join(folder, "index.xml"), "w", encoding="utf-8") as file:
                file.write(index)
            with self.assertRaisesRegex(ArchiveError, sentence):
                Archive(folder)
        shutil.rmtree(folder)
        os.unlink(folder[:-len(".000")])

    def test_reads_an_archive_without_outputs(self):
        folder = fake_uda.make_folder(self.folder.name, "young")
        fake_uda.write_index(folder, [], [], [], "Young")
        self.assertEqual(Archive(folder).times, [])
        with self.assertRaisesRegex(ArchiveError, "has no outputs yet"):
            Archive(folder).index_at(0)
        with self.assertRaisesRegex(ArchiveError, "has no outputs yet"):
            Archive(folder)[-1]
        self.assertEqual(run("uda", folder)[0], 0)
        self.assertIn("has no outputs yet", run("plot", folder)[2])


class Command(WithArchives):
    def test_lists_what_is_there(self):
        code, out, _ = run("uda", self.sod)
        self.assertEqual(code, 0)
        for part in ("Sod's shock tube", "3 outputs", "400 particles of gas", "p.velocity", "[m/s]", "vector",
                     "KineticEnergy", "[J]", "100 cells in 1-D"):
            self.assertIn(part, out)

    def test_says_which_files_are_missing(self):
        for name, others in (("t00000.h5", "100 cells in 1-D, 3 outputs:"), ("t00200.h5", "3 outputs:")):
            with tempfile.TemporaryDirectory() as folder:
                sod = fake_uda.make_sod(folder)
                files = sorted(file for file in os.listdir(sod) if file.endswith(".h5"))
                os.remove(os.path.join(sod, files[0] if name == "t00000.h5" else files[-1]))
                code, out, err = run("uda", sod)
                self.assertEqual((code, err), (0, ""))
                self.assertEqual(out.count("its file is missing"), 1)
                self.assertIn("\n" + others, out)

    def test_says_which_files_are_damaged(self):
        with tempfile.TemporaryDirectory() as folder:
            sod = fake_uda.make_sod(folder)
            os.truncate(os.path.join(sod, "t00200.h5"), 1000)
            code, out, err = run("uda", sod)
            self.assertEqual((code, err), (0, ""))
            self.assertIn("200   0.2   its file is damaged or incomplete\n", out)
            self.assertIn("p.density", out)
            self.assertIn("t00200.h5', which is damaged or incomplete", run("uda", sod, "p.density")[2])
            os.remove(os.path.join(sod, "t00200.h5"))
            self.assertRegex(run("uda", sod, "p.density")[2], "the file of output 2, '.*t00200.h5', is missing\n")

    def test_says_that_a_start_holds_nothing_of_a_step(self):
        with tempfile.TemporaryDirectory() as folder:
            plate = fake_uda.make_heat(folder)
            with h5py.File(os.path.join(plate, "t00000.h5"), "r+") as file:
                del file["nodes/g.mass"]
            self.assertIn("output 0 contains no 'g.mass'; it is computed in a step, and this output is the initial "
                          "state",
                          run("uda", plate, "g.mass", "--index", "0")[2])

    def test_prints_positions_and_values(self):
        code, out, err = run("uda", self.sod, "p.density", "p.pressure", "--time", "0.1")
        rows = out.splitlines()
        self.assertEqual((code, len(rows)), (0, 401))
        self.assertEqual(rows[0].split(), ["x", "[m]", "p.density", "[kg/m^3]", "p.pressure", "[Pa]"])
        self.assertEqual(rows[1].split(), ["0.00125", "1", "1"])
        self.assertIn("t = 0.1 s", err)

    def test_prints_a_global_over_time(self):
        self.assertEqual(run("uda", self.sod, "KineticEnergy")[1].split()[-2:], ["0.2", "0.1"])

    def test_prints_a_component(self):
        rows = run("uda", self.disks, "p.velocity.y", "p.density", "--csv", "-")[1].splitlines()
        self.assertEqual(rows[0], "x [m],y [m],p.velocity.y [m/s],p.density [kg/m^3]")
        self.assertEqual(float(rows[1].split(",")[2]), Archive(self.disks)[-1]["p.velocity"][0, 1])

    def test_takes_options_anywhere(self):
        self.assertIn("p.density [kg/m^3]", run("uda", self.disks, "--material", "left", "p.density", "--stats")[1])

    def test_options_that_choose_nothing_are_told(self):
        for words, code, sentence in (((self.sod, "--csv", "x.csv"), 2, "give a variable"),
                                      ((self.sod, "--index", "0"), 2, "give a variable"),
                                      ((self.sod, "p.density", "--time", "nan"), 2, "found 'nan', expected a number"),
                                      ((self.sod, "KineticEnergy", "--index", "1"), 1, "printed over all times"),
                                      ((), 2, "the following arguments are required: archive\n")):
            found, out, err = run("uda", *words)
            self.assertEqual((found, out), (code, ""), err)
            self.assertIn(sentence, err)

    def test_writes_csv_with_every_digit(self):
        code, _, _ = run("uda", self.sod, "p.velocity", "--csv", self.path("out.csv"))
        table = np.loadtxt(self.path("out.csv"), delimiter=",", skiprows=1)
        self.assertEqual(code, 0)
        np.testing.assert_array_equal(table[:, 1:], Archive(self.sod)[-1]["p.velocity"])
        with open(self.path("out.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline(), "x [m],p.velocity.x [m/s],p.velocity.y [m/s],p.velocity.z [m/s]\n")

    def test_prints_statistics(self):
        out = run("uda", self.disks, "p.density", "--stats", "--material", "left")[1]
        row = next(line for line in out.splitlines() if line.startswith("p.density"))
        density = Archive(self.disks)[-1]["p.density", "left"]
        numbers = [float(word) for word in row.split()[2:]]
        np.testing.assert_allclose(numbers, [len(density), density.min(), density.max(), density.mean(), density.std()],
                                   rtol=1e-6)  # seven digits are printed

    def test_prints_nothing_of_a_material_without_particles(self):
        code, out, _ = run("uda", self.disks, "p.density", "--material", "none", "--stats")
        self.assertEqual(code, 0)
        self.assertIn("p.density [kg/m^3]", out)

    def test_prints_fields_with_their_positions(self):
        rows = run("uda", self.plate, "c.temperature", "--csv", "-")[1].splitlines()
        self.assertEqual(len(rows), 25)
        self.assertTrue(rows[2].startswith("0.25,0.125,"))

    def test_fails_with_a_sentence(self):
        for arguments, sentence in (((self.sod, "p.presure"), "did you mean 'p.pressure'?"),
                                    ((self.path("none.uda"),), "is no folder"),
                                    ((self.sod, "p.density", "KineticEnergy"), "do not fit in one table"),
                                    ((self.sod, "p.velocity.w"), "no component of p.velocity 'w'; there is: x, y, z"),
                                    ((self.sod, "p.density.x"), "did you mean 'p.density'?"),
                                    ((self.sod, "p.density", "--csv", "/dev/null/x"),
                                     "cannot write '/dev/null/x': Not a directory")):
            code, _, err = run("uda", *arguments)
            self.assertEqual(code, 1)
            self.assertIn(sentence, err)
            self.assertNotIn("Traceback", err)


class Plot(WithArchives):
    def plot(self, *arguments, out="out.png"):
        code, _, err = run("plot", *arguments, "--out", self.path(out))
        self.assertEqual(code, 0, err)
        with open(self.path(out), "rb") as file:
            return file.read(), err

    def test_writes_png_and_svg(self):
        self.assertTrue(self.plot(self.sod)[0].startswith(b"\x89PNG"))
        self.assertIn(b"<svg", self.plot(self.sod, out="out.svg")[0])

    def test_shows_the_four_profiles_with_units_time_and_legend(self):
        svg = self.plot(self.sod, "--time", "0.1", out="four.svg")[0].decode()
        for text in ("density [kg/m³]", "velocity [m/s]", "pressure [Pa]", "specific internal energy [J/kg]", "x [m]",
                     "t = 0.1 s", "particles", "exact"):
            self.assertIn(text, svg)

    def test_needs_an_archive_and_nothing_else(self):
        code, _, err = run("plot")
        self.assertEqual(code, 2)
        self.assertIn("the following arguments are required: archive\n", err)

    def test_says_what_is_missing(self):
        svg, err = self.plot(self.part, out="part.svg")
        self.assertIn('no pressure: the scene does not save it; add <save label="p.pressure"/>', err)
        self.assertNotIn(b"pressure", svg)

    def test_keeps_a_node_field_within_the_grid(self):
        uda = Archive(self.plate)
        grid = uda.grid
        panel = Figure(uda, variables=["g.mass"]).figure.axes[0]
        self.assertEqual((panel.get_xlim(), panel.get_ylim()),
                         ((0, grid.spacing[0] * grid.cells[0]), (0, grid.spacing[1] * grid.cells[1])))

    def test_says_which_time_it_took(self):
        self.assertIn("the output nearest to t = 0.19 s is the one at 0.2 s", self.plot(self.sod, "--time", "0.19")[1])

    def test_draws_fields_images_and_points(self):
        self.assertIn(b"temperature [K]", self.plot(self.heat, out="heat.svg")[0])
        self.assertIn(b"temperature [K]", self.plot(self.plate, out="plate.svg")[0])
        self.assertIn("density [kg/m³]", self.plot(self.disks, out="disks.svg")[0].decode())
        self.assertIn(b"|velocity| [m/s]", self.plot(self.disks, "p.velocity", out="speed.svg")[0])

    def test_fails_with_a_sentence(self):
        for arguments, sentence in (((self.sod, "p.presure"), "did you mean 'p.pressure'?"),
                                    ((self.sod, "--out", self.path("out.xyz")), "is not a picture: its name must"),
                                    ((self.sod, "--out", self.path("no/out.png")), "there is no folder '")):
            code, _, err = run("plot", *arguments)
            self.assertEqual(code, 1)
            self.assertIn(sentence, err)
            self.assertNotIn("Traceback", err)


if __name__ == "__main__":
    unittest.main()
