#!/usr/bin/env python3
"""Tests of the features of tools/plot: slices, ranges, differences, films, three dimensions, following a run."""
import importlib.util
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = str(pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve())
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT / "tests/tools")]
from tushar.interpreter import ensure

ensure("h5py", "matplotlib", "PIL")
WITHOUT_PYVISTA = None if importlib.util.find_spec("pyvista") else "this Python has no pyvista"

import h5py
import numpy as np
from PIL import Image

import fake_uda
from in_folder import InFolder
from tushar import Archive, ArchiveError, film, space
from tushar.figure import Figure
from tushar.view import Output, Quantity, View


class WithArchives(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, archive in fake_uda.make_all(cls.folder).items():
            setattr(cls, name, archive)

    def plot(self, *words, path=None):
        """Returns exit code, standard output and standard error of tools/plot, run in a folder of its own."""
        environment = {**os.environ, **({"PATH": path} if path else {})}
        done = subprocess.run([sys.executable, ROOT / "tools/plot", *words], capture_output=True, text=True,
                              cwd=self.folder, env=environment)
        return done.returncode, done.stdout, done.stderr

    @staticmethod
    def texts(figure):
        """Returns titles and labels of all panels."""
        panels = figure.figure.axes
        return [text for panel in panels
                for text in (panel.get_xlabel(), panel.get_ylabel(), panel.get_title(loc="left"))]


class Slices(WithArchives):
    def test_of_a_box_is_a_plane_of_the_nearest_cells(self):
        output = Output(Archive(self.box)[-1], View({2: 0.45}))
        quantity = Quantity.of(output.snapshot.archive, "c.temperature")
        np.testing.assert_array_equal(output.field(quantity, None), output.snapshot["c.temperature"][1])
        figure = Figure(Archive(self.box), variables=["c.temperature"], view=View({0: 0.5}))
        self.assertIn("x = 0.5 m", figure.figure._suptitle.get_text())
        self.assertEqual(self.texts(figure)[:2], ["y [m]", "z [m]"])

    def test_of_a_plate_is_a_profile(self):
        figure = Figure(Archive(self.plate), variables=["c.temperature"], view=View({1: 0.6}))
        line = figure.figure.axes[0].lines[0]
        np.testing.assert_array_equal(line.get_ydata(), Archive(self.plate)[-1]["c.temperature"][0, 2])

    def test_holds_the_particles_within_half_a_cell(self):
        output = Output(Archive(self.disks)[-1], View({1: 0.3}))
        x, values = output.particles(Quantity.of(output.snapshot.archive, "p.density"), "left")
        self.assertTrue(len(x) == len(values) > 0)
        self.assertLessEqual(np.abs(x[:, 1] - 0.3).max(), 0.0125)

    def test_that_is_nowhere_is_told(self):
        outside = "x = 1.5 m is outside the grid, which extends from 0 to 1 m"
        for slices, sentence in (({2: 0.5}, "no slice at z: the grid has only x, y"), ({0: 1.5}, outside),
                                 ({0: 0.5, 1: 0.5}, "nothing remains to draw")):
            with self.assertRaisesRegex(ArchiveError, sentence):
                Figure(Archive(self.plate), variables=["c.temperature"], view=View(slices))


    def test_that_meets_no_particles_is_told(self):
        with self.assertRaisesRegex(ArchiveError, "no particles lie within half a cell of x = 0.02 m"):
            Figure(Archive(self.disks), variables=["p.density"], view=View({0: 0.02}))
        with self.assertRaisesRegex(ArchiveError, "disks.uda' contains no values of p.density in the slice"):
            list(film.figures(Archive(self.disks), ["p.density"], None, View({0: 0.02})))


class Values(WithArchives):
    def colours(self, archive, variables, **choices):
        """Returns scale and colour map of the first panel."""
        figure = Figure(Archive(archive), variables=variables, view=View(**choices))
        panel = figure.figure.axes[0]
        drawn = (panel.images or panel.collections)[0]
        return drawn.get_clim(), drawn.get_cmap().name, type(drawn.norm).__name__

    def test_range_log_and_colour_map(self):
        self.assertEqual(self.colours(self.plate, ["c.temperature"], range=(300, 350), log=True, cmap="magma"),
                         ((300, 350), "magma", "LogNorm"))
        values = Archive(self.plate)[-1]["c.temperature"]
        self.assertEqual(self.colours(self.plate, ["c.temperature"], range=(None, 350))[0], (values.min(), 350))

    def test_a_constant_is_not_drawn_as_its_rounding_errors(self):
        low, high = self.colours(self.plate, ["g.mass"])[0]
        self.assertAlmostEqual(high - low, 0.1)

    def test_of_one_material(self):
        figure = Figure(Archive(self.disks), variables=["p.density"], view=View(material="left"))
        self.assertEqual(len(figure.figure.axes[0].collections[0].get_offsets()),
                         Archive(self.disks)[-1].materials["left"])
        with self.assertRaisesRegex(ArchiveError, r"no material 'lft' \(did you mean 'left'"):
            Figure(Archive(self.disks), view=View(material="lft"))
        with self.assertRaisesRegex(ArchiveError, "contains no 'p.density' of material 'none'"):
            Figure(Archive(self.disks), variables=["p.density"], view=View(material="none"))

    def test_a_component_of_a_vector(self):
        figure = Figure(Archive(self.disks), variables=["p.velocity.y"])
        velocity = Archive(self.disks)[-1]["p.velocity"]
        np.testing.assert_array_equal(figure.figure.axes[0].collections[0].get_array(), velocity[:, 1])
        self.assertIn("velocity y [m/s]", self.texts(figure))
        with self.assertRaisesRegex(ArchiveError, "no component of p.velocity 'w'; there is: x, y, z"):
            Figure(Archive(self.disks), variables=["p.velocity.w"])

    def test_of_nothing_above_0_there_is_no_logarithm(self):
        with self.assertRaisesRegex(ArchiveError, "'p.velocity.y' has no values above 0"):
            with tempfile.TemporaryDirectory() as folder:
                disks = fake_uda.make_disks(folder)
                with h5py.File(Archive(disks).files[0], "r+") as file:
                    for name in ("left", "right"):
                        file[f"particles/{name}/p.velocity"][...] = -1
                Figure(Archive(disks), variables=["p.velocity.y"], view=View(log=True))


class Differences(WithArchives):
    def test_of_fields_are_to_the_output_at_the_nearest_time(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Archive(fake_uda.make_heat(folder, (6, 4, 1), 2, "plate"))
            with h5py.File(other.files[1], "r+") as file:
                file["cells/c.temperature"][...] -= 2
                file["cells/c.temperature"][0, 0, 0] += 3
            figure = Figure(Archive(self.plate), variables=["c.temperature"], view=View(other=other))
            drawn = figure.figure.axes[0].images[0]
            self.assertEqual((drawn.get_clim(), drawn.get_cmap().name), ((-2, 2), "RdBu_r"))
            np.testing.assert_allclose(drawn.get_array()[0, :2], [-1, 2])
            self.assertIn("difference of temperature [K]", self.texts(figure))

    def test_of_particles_go_by_id(self):
        with tempfile.TemporaryDirectory() as folder:
            other = Archive(fake_uda.make_moving(folder))
            output = Output(Archive(self.moving)[1], View(other=other))
            with h5py.File(other.files[1], "r+") as file:
                for name in ("p.particleID", "p.x"):
                    file[f"particles/b/{name}"][...] = file[f"particles/b/{name}"][()][::-1]
                file["particles/b/p.x"][0, 0] = 40.5
            x, values = output.particles(Quantity.of(output.snapshot.archive, "p.x.x"), "b")
            self.assertEqual((x[:, 0].tolist(), values.tolist()), ([31, 41], [0, 0.5]))

    def test_of_particles_need_the_same_cells(self):
        with tempfile.TemporaryDirectory() as folder:
            other = fake_uda.make_moving(folder)
            for file in Archive(other).files:
                with h5py.File(file, "r+") as output:
                    output["grid"].attrs.update(cells=[100, 1, 1], spacing=[0.5, 1, 1])
            code, _, err = self.plot(self.moving, "p.mass", "--diff", other)
        self.assertEqual(code, 1)
        self.assertIn("the grids differ, 50 cells here and 100 cells in", err)
        self.assertIn("so the particles do not correspond: choose a run with the same cells", err)

    def test_of_particles_need_the_same_levels(self):
        with tempfile.TemporaryDirectory() as folder:
            one, other = (Archive(fake_uda.make_refined(folder, name=name)) for name in ("one", "other"))
            with h5py.File(other.files[1], "r+") as file:
                file["grid"].attrs.update(cells=[8, 4, 1], spacing=[0.125, 0.25, 0.5])
                file["grid/boxes"][...] = np.array([(0, 0, 0, 0, 8, 4, 1)] * 4)
                del file["grid/levels"]
                file["grid/levels"] = [[0.125, 0.25, 0.5], [0.0625, 0.125, 0.5]]
            with self.assertRaisesRegex(ArchiveError, "the grids differ, 3 levels here and 2 levels in"):
                Figure(one, variables=["p.x.x"], view=View(other=other))

    def test_that_cannot_be_drawn_are_told(self):
        grids = "the grids differ, 6 x 4 cells here and 100 cells in"
        for options, sentence in (((self.plate, "--diff", self.sod), grids),
                                  ((self.disks, "--diff", self.sod), "sod.uda' has no particles of 'left'"),
                                  ((self.plate, "--diff", self.plate, "--log"), "--log and --diff cannot be combined")):
            code, _, err = self.plot(*options)
            self.assertEqual(code, 1, err)
            self.assertIn(sentence, err)
            self.assertNotIn("Traceback", err)
        with self.assertRaisesRegex(ArchiveError, "the grids differ, 6 x 4 cells here and 6 x 4 x 3 cells in"):
            Figure(Archive(self.plate), variables=["c.temperature"], view=View(other=Archive(self.box)))


class Films(WithArchives):
    def test_all_pictures_have_the_same_range(self):
        figures = list(film.figures(Archive(self.plate), ["c.temperature"], None, View()))
        limits = {figure.figure.axes[0].images[0].get_clim() for figure in figures}
        values = np.concatenate([snapshot["c.temperature"].ravel() for snapshot in Archive(self.plate)])
        self.assertEqual(limits, {(values.min(), values.max())})
        profiles = film.figures(Archive(self.sod), [], None, View())
        self.assertEqual(len({panel.get_ylim() for figure in profiles for panel in figure.figure.axes[1:2]}), 1)

    def test_every_output_is_a_picture(self):
        code, out, err = self.plot(self.sod, "--index", "all", "--out", "each.png")
        self.assertEqual((code, out.split()), (0, ["each.00.png", "each.01.png", "each.02.png"]), err)
        sizes = set()
        for name in out.split():
            with Image.open(self.folder / name) as picture:
                sizes.add(picture.size)
        self.assertEqual(len(sizes), 1)

    def test_a_gif_has_a_frame_for_each_output(self):
        code, out, err = self.plot(self.sod, "p.density", "--movie", "film.gif")
        self.assertEqual((code, out), (0, "film.gif\n"), err)
        with Image.open(self.folder / "film.gif") as moving:
            self.assertEqual((moving.n_frames, moving.info["duration"]), (3, 500))

    def test_without_ffmpeg_an_mp4_becomes_a_gif(self):
        with mock.patch("tushar.film.ffmpeg", return_value=None):
            path, notes = film.write(Archive(self.plate), str(self.folder / "plate.mp4"), ["c.temperature"])
        self.assertEqual(path, str(self.folder / "plate.gif"))
        self.assertEqual(notes, ["ffmpeg, which writes .mp4, is not installed: the film is a .gif"])

    def test_ffmpeg_gets_the_pictures(self):
        program = self.folder / "programs/ffmpeg"
        program.parent.mkdir(exist_ok=True)
        program.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" > "$last"\nwc -c >> "$last"\n')
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        code, out, err = self.plot(self.plate, "c.temperature", "--movie", "plate.mp4",
                                   path=f"{program.parent}:/usr/bin:/bin")
        self.assertEqual((code, out), (0, "plate.mp4\n"), err)
        words, count = (self.folder / "plate.mp4").read_text().splitlines()
        width, height = map(int, words.split(" -s ")[1].split()[0].split("x"))
        self.assertEqual((int(count), width % 2, height % 2), (2 * width * height * 3, 0, 0))

    def test_what_ffmpeg_dies_of_is_told(self):
        program = self.folder / "dying/ffmpeg"
        program.parent.mkdir()
        program.write_text("#!/bin/sh\necho no such codec >&2\nexit 1\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        with mock.patch("tushar.film.ffmpeg", return_value=str(program)):
            with self.assertRaisesRegex(ArchiveError, "ffmpeg could not write '.*a.mp4': no such codec"):
                film.write(Archive(self.sod), str(self.folder / "a.mp4"))

    def test_a_name_that_is_no_film_is_told(self):
        self.assertIn("its name must end in .mp4 or .gif", self.plot(self.sod, "--movie", "film.avi")[2])


class ThreeDimensions(WithArchives):
    def test_without_pyvista_there_are_three_slices(self):
        with mock.patch("tushar.space._pyvista", return_value=None):
            figure = Figure(Archive(self.box), variables=["c.temperature"])
        texts = self.texts(figure)
        for words in ("x = 0.5 m", "y = 0.5 m", "z = 0.5 m", "temperature [K]"):
            self.assertIn(words, texts)
        beside = figure.figure.axes[2].images[0]
        np.testing.assert_array_equal(beside.get_array(), Archive(self.box)[-1]["c.temperature"][:, :, 3].T)
        self.assertEqual(len({panel.images[0].get_clim() for panel in figure.figure.axes[:3]}), 1)
        self.assertIn("three planes", figure.notes[0])

    @unittest.skipIf(WITHOUT_PYVISTA, WITHOUT_PYVISTA)
    def test_by_pyvista_there_is_a_view_with_marked_axes(self):
        output = Output(Archive(self.box)[-1], View())
        seen = space.render(output, Quantity.of(output.snapshot.archive, "c.temperature"))
        if seen is None:
            self.skipTest("this VTK cannot draw without a display")
        self.assertEqual([mark.text for mark in seen.marks], ["0", "1", "x [m]", "0", "1", "y [m]", "0", "1", "z [m]"])
        self.assertGreater(len(np.unique(seen.pixels.reshape(-1, 3), axis=0)), 100)
        for across, up in (mark.place for mark in seen.marks):
            self.assertTrue(0 <= across < space.SIZE[0] and 0 <= up < space.SIZE[1])
        self.assertEqual(len(Figure(Archive(self.box), variables=["c.temperature"]).figure.axes), 2)


class Following(WithArchives):
    def test_draws_each_output_until_the_run_ends(self):
        with tempfile.TemporaryDirectory() as folder:
            sets = ["--set", "Grid/Level/Box/resolution=[1500,1,1]", "--set", "DataArchiver/outputInterval=.01"]
            run = subprocess.Popen([SUS, "ups/mpm/sod.ups", "--quiet", "--output", folder, *sets], cwd=ROOT)
            self.addCleanup(run.wait)
            archive = pathlib.Path(folder, "sod.uda")
            for _ in range(300):
                if (archive / "index.xml").exists():
                    break
                time.sleep(0.1)
            code, out, err = self.plot(str(archive), "--follow", "--out", "live.png")
            self.assertEqual((code, out), (0, "live.png\n"), err)
            self.assertEqual(run.wait(), 0)
            last = len(Archive(archive)) - 1
            self.assertIn(f"live.png: output {last}, t = 0.2 s", err)
            self.assertFalse(list(self.folder.glob("*.part.*")))

    def test_an_archive_that_is_ready_is_drawn_once(self):
        code, _, err = self.plot(self.plate, "--follow", "--out", "plate.png")
        self.assertEqual((code, err.count("output 1, t = 1 s")), (0, 1))

    def test_knows_whether_a_run_is_alive(self):
        import fcntl
        self.assertFalse(film.is_written(str(self.folder)))
        with tempfile.TemporaryDirectory() as folder:
            holder = os.open(folder, os.O_RDONLY)
            fcntl.flock(holder, fcntl.LOCK_EX)
            self.assertTrue(film.is_written(folder))
            os.close(holder)


class Options(WithArchives):
    def test_mistakes_are_sentences(self):
        axis = "found 'w=1', expected an axis and a coordinate, such as x=0.5"
        for options, code, sentence in ((("--slice", "w=1"), 2, axis),
                                        (("--range", "-1"), 2, "found '-1', expected two numbers, such as 0,1"),
                                        (("--range", "2,1"), 2, "expected the lower number first"),
                                        (("--index", "last"), 2, "found 'last', expected a number or 'all'"),
                                        (("--cmap", "virdis"), 1, "no colour map 'virdis' (did you mean 'viridis'?)"),
                                        (("--index", "9"), 1, "no output 9"),
                                        (("--time", "nan"), 2, "found 'nan', expected a number"),
                                        (("--slice", "x=inf"), 2, "found 'x=inf', expected an axis and a coordinate"),
                                        (("--slice", "x=0", "--slice", "x=1"), 2, "two slices at x; keep one"),
                                        (("--movie", "a.gif", "--out", "a.png"), 2, "--movie a film: keep one"),
                                        (("--movie", ""), 1, "'' is not a film"),
                                        (("c.temperature.x",), 1, "did you mean 'c.temperature'?"),
                                        (("--movie", "a.gif", "--index", "1"), 2, "not allowed with argument")):
            done = self.plot(self.plate, *options)
            self.assertEqual(done[0], code, done[2])
            self.assertIn(sentence, done[2])
            self.assertNotIn("Traceback", done[2])

    def test_a_global_quantity_is_for_another_tool(self):
        err = self.plot(self.sod, "KineticEnergy")[2]
        self.assertIn("'KineticEnergy' is a global value, which cannot be drawn on the grid", err)
        self.assertIn(f"tools/uda {self.sod} KineticEnergy prints it over time", err)

    def test_a_picture_without_ending_is_png_and_variables_may_come_last(self):
        self.assertEqual(self.plot(self.plate, "--out", "mass", "g.mass")[:2], (0, "mass.png\n"))
        self.assertTrue((self.folder / "mass.png").exists())

    def test_a_range_may_begin_below_0(self):
        self.assertEqual(self.plot(self.plate, "--range", "-1,400", "--out", "range.png")[0], 0)


if __name__ == "__main__":
    unittest.main()
