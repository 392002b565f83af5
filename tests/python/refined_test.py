#!/usr/bin/env python3
"""Archives of refined grids: arrays, boxes, levels, other libraries, tools: python3 tests/python/refined_test.py"""
import subprocess
import sys
import unittest
from unittest import mock

import support

support.ensure("h5py", "numpy")
WITHOUT = {name: support.missing(name) for name in ("pandas", "xarray", "pyvista", "yt", "matplotlib")}

import h5py
import numpy as np

import fake_uda
import tushar
from in_folder import InFolder

MIDDLES = [.125, .375, .5625, .6875, .78125, .84375, .90625, .96875]  # of the cells of a line [m]


def tool(folder, name, *words):
    """Runs a tool in a folder; returns its exit code, output and errors."""
    done = subprocess.run([sys.executable, support.ROOT / "tools" / name, *map(str, words)], capture_output=True,
                          text=True, encoding="utf-8", cwd=folder)
    return done.returncode, done.stdout, done.stderr


def middles(grid):
    """Returns the centres (z, y, x, 3) of all cells of a grid with one level."""
    z, y, x = np.meshgrid(*grid.coordinates("cell")[::-1], indexing="ij")
    return np.stack([x, y, z], axis=-1)


class WithRefined(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.paths = {dimension: fake_uda.make_refined(cls.folder, dimension, f"refined{dimension}")
                     for dimension in (1, 2, 3)}
        cls.archives = {dimension: tushar.open(path) for dimension, path in cls.paths.items()}
        cls.plane, cls.box = cls.archives[2][-1], cls.archives[3][-1]

    def expected(self, snapshot, places):
        """Returns the density at the centres of the cells that contain the positions (n, 3)."""
        found = np.full(len(places), np.nan)
        for box in snapshot["c.density"].boxes:
            inside = ((places >= box.lower) & (places < box.upper)).all(axis=1)
            self.assertTrue(np.isnan(found[inside]).all(), "boxes do not lie over one another")
            cell = np.floor((places[inside] - box.lower) / box.spacing)
            found[inside] = fake_uda.linear(box.lower + (cell + 0.5) * box.spacing)[0]
        self.assertFalse(np.isnan(found).any(), "boxes tile the domain")
        return found


class Arrays(WithRefined):
    def test_the_grid_is_that_of_the_finest_level(self):
        grid = self.plane.grid
        self.assertEqual((grid.cells.tolist(), grid.spacing.tolist(), grid.levels), ([16, 8, 1], [1/16, 1/8, .5], 3))
        self.assertEqual(grid.counts, [4, 12, 16])
        self.assertEqual(grid.level(0).cells.tolist(), [4, 2, 1])
        self.assertEqual(grid.level(3).spacing.tolist(), [1/32, 1/16, .5])
        self.assertEqual(self.archives[1][0].grid.counts, [4])
        with self.assertRaisesRegex(tushar.ArchiveError, "no level -1: the coarsest is 0, the finest 2"):
            grid.level(-1)

    def test_an_array_has_a_value_for_each_of_the_finest_cells(self):
        for dimension, archive in self.archives.items():
            field = archive[-1]["c.density"]
            places = middles(archive[-1].grid)
            self.assertEqual(field.shape, places.shape[:3], dimension)
            np.testing.assert_array_equal(field.values.ravel(), self.expected(archive[-1], places.reshape(-1, 3)))
            np.testing.assert_array_equal(np.asarray(field), field.values)
        self.assertEqual((field * 2).shape, field.shape)
        self.assertEqual(field.max(), field.values.max())

    def test_slices_are_those_of_the_whole(self):
        for name in ("c.density", "c.velocity"):
            field = self.box[name]
            whole = field.values
            for key in (0, -1, (2, 3), (slice(1, 7, 2), slice(None), 5), (Ellipsis, 1), (0, 0, 0), slice(5, 2),
                        (slice(None), slice(3, 6), slice(7, 12)), (slice(None, None, -1), 1), [1, 3], whole > 3):
                np.testing.assert_array_equal(field[key], whole[key], err_msg=str(key))
        for wrong in (8, (0, 8), (0, 0, 0, 0)):
            with self.assertRaises(IndexError):
                self.box["c.density"][wrong]

    def test_slices_read_the_boxes_that_they_touch(self):
        field = self.box["c.density"]
        with mock.patch.object(field, "_read", wraps=field._read) as read:
            field[0, :, 0:4]
            self.assertEqual([call.args[0] for call in read.call_args_list], [0])

    def test_boxes_have_the_cells_as_they_are(self):
        boxes = self.plane["c.velocity"].boxes
        self.assertEqual([box.level for box in boxes], [0, 1, 1, 2])
        last = boxes[-1]
        self.assertEqual((last.first.tolist(), last.cells.tolist()), ([12, 4, 0], [4, 4, 1]))
        self.assertEqual((last.lower.tolist(), last.upper.tolist()), ([.75, .5, 0], [1, 1, .5]))
        self.assertEqual(last.values.shape, (1, 4, 4, 3))
        np.testing.assert_allclose(last.values.reshape(-1, 3), fake_uda.linear(last.centres())[1])
        self.assertEqual(repr(last), "<Box of 4 x 4 x 1 cells of level 2 from [0.75 0.5  0.  ] to [1.  1.  0.5] m>")

    def test_a_level_has_means_of_finer_cells_and_repeats_coarser_ones(self):
        for snapshot in (self.archives[1][-1], self.plane, self.box):
            for name, column in (("c.density", 0), ("c.velocity", 1)):
                field = snapshot[name]
                for level in (0, 1, 2):  # the mean of a linear field is its value in the middle
                    values, grid = field.level(level), field.levels[level]
                    places = middles(grid)
                    exact = fake_uda.linear(places.reshape(-1, 3))[column].reshape(values.shape)
                    fine = slice(None) if level == 0 else slice(grid.cells[0] // 2, None)
                    fine = fine if level < 2 else slice(12, None)
                    np.testing.assert_allclose(values[-1:, -1:, fine], exact[-1:, -1:, fine], rtol=1e-14)
                np.testing.assert_array_equal(field.level(2), field.values)
                finer = np.repeat(field.values, 2, axis=2)
                np.testing.assert_array_equal(field.level(3)[0, 0], finer[0, 0])
                self.assertAlmostEqual(field.level(0).mean(), field.values.mean(), places=14)

    def test_a_box_may_begin_within_a_coarse_cell(self):
        grid = tushar.Grid(np.zeros(3), np.array([.25, 1, 1]), np.array([8, 1, 1]), 1,
                           np.array([[2, 0, 0, 0, 1, 1, 1], [2, 1, 0, 0, 6, 1, 1], [1, 3, 0, 0, 4, 1, 1]]), 3)
        with h5py.File("loose.h5", "w", driver="core", backing_store=False) as file:
            file["values"] = np.arange(8.)
            field = tushar.Refined(file["values"], grid)
            self.assertEqual(field.values.ravel().tolist(), [0, 1, 2, 3, 4, 5, 6, 6])
            self.assertEqual(field.level(0).ravel().tolist(), [1.5, 5.25])
            self.assertEqual(field.level(1).ravel().tolist(), [.5, 2.5, 4.5, 6])


class Libraries(WithRefined):
    @unittest.skipIf(WITHOUT["pandas"], WITHOUT["pandas"])
    def test_pandas_has_a_row_for_each_cell(self):
        frame = self.plane.to_pandas("cells")
        self.assertEqual(list(frame.columns)[:4], ["x", "y", "level", "c.density"])
        self.assertEqual(frame["level"].value_counts().to_dict(), {2: 16, 1: 12, 0: 4})
        np.testing.assert_allclose(frame["c.density"], 1 + 2 * frame["x"] + 3 * frame["y"] + 5 * .25)
        self.assertEqual(frame.attrs["units"]["x"], "m")

    @unittest.skipIf(WITHOUT["xarray"], WITHOUT["xarray"])
    def test_xarray_has_all_outputs_on_the_finest_level_of_the_last(self):
        data = self.archives[2].to_xarray()
        self.assertEqual(dict(data["c.density"].sizes), {"time": 2, "z": 1, "y": 8, "x": 16})
        np.testing.assert_array_equal(data["c.density"][1], self.plane["c.density"].values)
        coarse = self.archives[2][0]["c.density"].values
        np.testing.assert_array_equal(data["c.density"][0], coarse.repeat(4, axis=1).repeat(4, axis=2))
        self.assertAlmostEqual(float(data["x"][0]), 1 / 32)

    @unittest.skipIf(WITHOUT["pyvista"], WITHOUT["pyvista"])
    def test_pyvista_has_a_block_for_each_box(self):
        blocks = self.box.to_pyvista()
        cells = blocks["cells"]
        self.assertEqual(cells.keys()[-1], "level 2 box 4")
        for block, box in zip(cells, self.box["c.density"].boxes):
            np.testing.assert_allclose(block.cell_centers().points, box.centres(), rtol=1e-6)
            np.testing.assert_array_equal(block.cell_data["c.density"], box.values.ravel())
            self.assertEqual(block.cell_data["c.velocity"].shape, (len(box.centres()), 3))
        self.assertEqual(blocks["gas"].n_points, 1)

    @unittest.skipIf(WITHOUT["yt"], WITHOUT["yt"])
    def test_yt_has_the_finest_cells(self):
        data = self.box.to_yt()
        self.assertEqual(data.domain_dimensions.tolist(), [16, 8, 8])


class Tools(WithRefined):
    def test_uda_lists_levels(self):
        code, out, err = tool(self.folder, "uda", self.paths[2])
        self.assertEqual(code, 0, err)
        self.assertIn("16 x 8 cells in 2-D if all cells were on the finest of 3 levels, 2 outputs:", out)
        self.assertIn("level 0: 4 cells of 0.25 x 0.5 m in 1 box\nlevel 1: 12 cells of 0.125 x 0.25 m in 2 boxes\n"
                      "level 2: 16 cells of 0.0625 x 0.125 m in 1 box\n", out)

    def test_uda_prints_cells_as_they_are_and_means_over_space(self):
        code, out, err = tool(self.folder, "uda", self.paths[1], "c.density", "--csv", "-")
        self.assertEqual(code, 0, err)
        rows = [line.split(",") for line in out.splitlines()]
        self.assertEqual(rows[0], ["x [m]", "level", "c.density [kg/m^3]"])
        self.assertEqual([float(row[0]) for row in rows[1:]], MIDDLES)
        out = tool(self.folder, "uda", self.paths[1], "c.density", "--stats")[1]
        density = self.archives[1][-1]["c.density"].values
        mean, deviation = map(float, out.splitlines()[-1].split()[-2:])
        self.assertAlmostEqual(mean, density.mean(), places=5)
        self.assertAlmostEqual(deviation, density.std(), places=5)

    def test_coarsen_makes_a_table_of_one_level(self):
        code, out, err = tool(self.folder, "coarsen", self.paths[2], "--by", 4, "--bits", 52, "--out", "table.h5")
        self.assertEqual(code, 0, out + err)
        with h5py.File(self.folder / "table.h5") as table:
            self.assertEqual(table["grid"].attrs["cells"].tolist(), [4, 2, 1])
            self.assertNotIn("boxes", table["grid"])
            np.testing.assert_allclose(table["cells/c.density"], self.plane["c.density"].level(0), rtol=1e-6)


@unittest.skipIf(WITHOUT["matplotlib"], WITHOUT["matplotlib"])
class Pictures(WithRefined):
    def figure(self, dimension, **view):
        from tushar.figure import Figure
        from tushar.view import View
        return Figure(self.archives[dimension], variables=["c.density"], view=View(**view))

    def test_a_profile_has_the_cells_where_they_are_and_marks_levels(self):
        panel = self.figure(1).figure.axes[0]
        line, *levels = panel.lines
        np.testing.assert_allclose(line.get_xdata(), MIDDLES)
        np.testing.assert_allclose(line.get_ydata(), self.archives[1][-1]["c.density"].cell_values)
        self.assertEqual([mark.get_label() for mark in levels], ["level 0", "level 1", "level 2"])
        self.assertEqual([len(mark.get_xdata()) for mark in levels], [2, 2, 4])
        self.assertEqual(len({mark.get_marker() for mark in levels}), 3)

    def test_a_slice_of_a_plane_is_such_a_profile(self):
        line = self.figure(2, slices={1: .3}).figure.axes[0].lines[0]
        np.testing.assert_allclose(line.get_xdata(), [.125, .375, .5625, .6875, .8125, .9375])
        y = np.where(line.get_xdata() < .5, .25, .375)
        np.testing.assert_allclose(line.get_ydata(), 1 + 2 * line.get_xdata() + 3 * y + 5 * .25)

    def test_a_plane_is_the_finest_cells_with_boxes_where_asked(self):
        plain, outlined = self.figure(2).figure.axes[0], self.figure(2, boxes=True).figure.axes[0]
        np.testing.assert_array_equal(plain.images[0].get_array(), self.plane["c.density"].values[0])
        self.assertEqual(len(plain.collections), 0)
        corners = [path.vertices for path in outlined.collections[0].get_paths()]
        self.assertEqual(len(corners), 4)
        np.testing.assert_allclose([corners[3].min(axis=0), corners[3].max(axis=0)], [[.75, .5], [1, 1]])

    def test_a_slice_in_space_has_the_boxes_that_it_cuts(self):
        for place, count in ((.1, 2), (.7, 4)):
            panel = self.figure(3, slices={2: place}, boxes=True).figure.axes[0]
            self.assertEqual(len(panel.collections[0].get_paths()), count)

    def test_three_planes_have_the_axes_of_their_panels(self):
        from tushar import space
        with mock.patch.object(space, "render", return_value=None):
            figure = self.figure(3, boxes=True)
        for panel in figure.figure.axes[:3]:
            (left, right), (low, high) = panel.get_xlim(), panel.get_ylim()
            points = np.concatenate([path.vertices for path in panel.collections[0].get_paths()])
            np.testing.assert_allclose([points.min(axis=0), points.max(axis=0)], [[left, low], [right, high]])

    def test_a_difference_is_that_of_the_finest_cells(self):
        from tushar.figure import Figure
        from tushar.view import View
        same = self.figure(2, other=self.archives[2]).figure.axes[0].images[0].get_array()
        self.assertEqual(float(abs(same).max()), 0)
        line = self.figure(1, other=self.archives[1]).figure.axes[0].lines[0]
        self.assertEqual((len(line.get_xdata()), float(abs(line.get_ydata()).max())), (16, 0))
        with self.assertRaisesRegex(tushar.ArchiveError, "the grids differ, 16 x 8 cells here and 16 cells in"):
            Figure(self.archives[2], variables=["c.density"], view=View(other=self.archives[1]))

    def test_the_tool_draws_all(self):
        for dimension, words in ((1, ("--boxes",)), (2, ("c.velocity.x", "--index", "all")), (3, ("--boxes",))):
            code, out, err = tool(self.folder, "plot", self.paths[dimension], *words, "--out", "picture.png")
            self.assertEqual(code, 0, err)
        heat = fake_uda.make_heat(self.folder, (6, 4, 1), 2, "plate")
        self.assertIn("note: the grid has one level, so there are no boxes to draw",
                      tool(self.folder, "plot", heat, "--boxes", "--out", "picture.png")[2])


if __name__ == "__main__":
    unittest.main()
