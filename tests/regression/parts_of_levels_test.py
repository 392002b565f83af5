#!/usr/bin/env python3
"""Modules that show parts of a grid of several levels: slices, lines and planes have the cells of each level that are
there, with the values of the full outputs, the same bytes on any patches and ranks, and after a restart."""
import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[up] / part) for up, part in
                ((1, "support"), (2, "tools/python"))]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import numpy as np

import tushar
from sus import ROOT
from uda import FolderTest
from vtk_readers import MISSING, h5py, vtk_to_numpy, vtkHDFReader

BLAST = ROOT / "ups/euler/blast_levels.ups"
SMALL = ("Grid/Level/Box/resolution=[16,16,1]", "AMR/Regridder/min_patch_size=[[4,4,1]]", "AMR/Regridder/max_levels=3",
         "AMR/Regridder/min_timestep_interval=4", "DataArchiver/outputInterval=0",
         "DataArchiver/outputTimestepInterval=8", "DataArchiver/checkpoint/@timestepInterval=10")
STEPS = "Time/max_Timesteps=120"
LOOKED_AT = ("<samplingFrequency>1e10</samplingFrequency><timeStart>0</timeStart><timeStop>1</timeStop><Variables>"
             '<analyze label="c.density"/><analyze label="c.velocity"/></Variables>')
LINES = ('<line name="row"><startingPt>[0,.16,0]</startingPt><endingPt>[1.2,.16,0]</endingPt></line>'
         '<line name="few"><startingPt>[.16,0,0]</startingPt><endingPt>[.16,1.2,0]</endingPt><stepSize>.15</stepSize>'
         "</line>")
PLANE = '<plane name="corner"><startingPt>[0,0,0]</startingPt><endingPt>[.5,.4,0]</endingPt></plane>'
MODULES = (f'<Module name="lineExtract">{LOOKED_AT}<lines>{LINES}</lines></Module>'
           f'<Module name="planeExtract">{LOOKED_AT}<planes>{PLANE}</planes></Module>'
           '<Module name="slice"><plane>x = .16</plane><plane>y=0</plane><label>c.density</label>'
           "<label>c.velocity</label><outputTimestepInterval>8</outputTimestepInterval></Module>")


def numbers(file):
    return np.array([[float(word) for word in line.split()] for line in file.read_text().splitlines()
                     if not line.startswith("#")])


def leaves(state, level):
    """Returns the boxes of a level as rows of lower and upper corners."""
    return [(row[1:4], row[4:]) for row in state.grid.boxes if row[0] == level]


def value_at(state, name, place):
    """Returns the value of the cell that contains a position, from the values on the finest cells."""
    grid = state.grid
    finest = grid.level(grid.levels - 1).spacing
    cell = np.floor((place - grid.lower) / finest + 1e-9).astype(int)
    return state[name][:][tuple(cell[::-1])]


class PartsOfLevels(FolderTest):
    maxDiff = None

    def scene(self, folder):
        text = BLAST.read_text()
        text = text[:text.index("<DataAnalysis>")] if "<DataAnalysis>" in text else text[:text.index("</Uintah_spec")]
        path = folder.path / "parts.ups"
        path.write_text(f"{text}<DataAnalysis>{MODULES}</DataAnalysis></Uintah_specification>")
        return path

    def ran(self, *sets, options=(), ranks=1):
        here = self.folder(ranks)
        report = self.well(here.finish([self.scene(here), "--output", here.path, *options], [*SMALL, *sets]))
        return here, report

    def files_of(self, folder):
        found = {}
        for part in ("row", "few", "corner", "slice"):
            found.update({str(file.relative_to(folder.uda)): file.read_bytes()
                          for file in (folder.uda / part).rglob("*") if file.is_file() and file.name != "input.xml"})
        return found

    def test_lines_have_the_cells_of_each_level_that_are_there(self):
        here, report = self.ran(STEPS)
        self.assertGreater(report["regrids"], 1)
        whole = tushar.open(here.uda)
        for step in (8, 120):
            state = whole[whole.steps.index(step)]
            seen = 0
            for level in range(state.grid.levels):
                width = state.grid.level(level).spacing
                y = int(.16 / width[1])
                cells = {(x, y) for low, up in leaves(state, level) if low[1] <= y < up[1]
                         for x in range(low[0], up[0])}
                files = {file.name: numbers(file) for file in (here.uda / f"row/L-{level}").glob("*")}
                rows = {name: row for name, table in files.items() for row in table if row[3] == step}
                self.assertEqual(set(rows), {f"i{x}_j{y}_k0" for x, y in cells}, f"{step} {level}")
                for x, y in cells:
                    row = rows[f"i{x}_j{y}_k0"]
                    place = np.array([(x + .5) * width[0], (y + .5) * width[1], .5])
                    np.testing.assert_allclose(row[:2], place[:2], rtol=1e-6)
                    np.testing.assert_allclose(row[5], value_at(state, "c.density", place), rtol=1e-6)
                    np.testing.assert_allclose(row[6:9], value_at(state, "c.velocity", place), rtol=1e-6, atol=1e-12)
                    seen += 1
            self.assertGreater(seen, 16)

    def test_steps_along_a_line_are_rounded_up_to_cells_of_each_level(self):
        here, _ = self.ran(STEPS)
        for level, stride in ((0, 2), (1, 4), (2, 8)):
            names = {int(file.name.split("_")[1][1:]) for file in (here.uda / f"few/L-{level}").glob("*")}
            self.assertTrue(names)
            self.assertEqual({at % stride for at in names}, {0}, level)

    def test_planes_have_a_file_for_each_level(self):
        here, _ = self.ran(STEPS)
        whole = tushar.open(here.uda)
        state, folder = whole[-1], here.uda / "corner/t00120"
        area = 0
        for level in range(state.grid.levels):
            width = state.grid.level(level).spacing
            if not (folder / f"L-{level}").exists():
                continue
            table = numbers(folder / f"L-{level}/0:c.density_0.dat")
            for x, y, _, value in table:
                expected = value_at(state, "c.density", np.array([x, y, .5]))
                np.testing.assert_allclose(value, expected, rtol=1e-15)  # 16 digits
            area += len(table) * width[0] * width[1]
        self.assertGreaterEqual(area, .5 * .4 - 1e-12)
        self.assertLess(area, .6 * .5)  # whole cells

    def test_slices_have_the_values_of_the_full_output(self):
        here, _ = self.ran(STEPS)
        whole = tushar.open(here.uda)
        for plane, axis, at in (("x=0.16", 0, .16), ("y=0", 1, 1e-9)):
            part = tushar.open(here.uda / "slice" / plane)
            self.assertEqual(part.steps, list(range(0, 121, 8)))
            for k, step in enumerate(part.steps):
                state = whole[whole.steps.index(step)]
                self.assertEqual(part[k].grid.dimension, 1)
                self.assertEqual(part[k].grid.levels, state.grid.levels)
                finest = state.grid.level(state.grid.levels - 1).spacing
                row = int(np.ceil(at / finest[axis])) - 1
                for label in ("c.density", "c.velocity"):
                    expected = np.take(state[label][:], [row], axis=2 - axis)
                    np.testing.assert_array_equal(part[k][label][:], expected, err_msg=f"{plane} {label} {step}")

    @unittest.skipIf(MISSING, MISSING)
    def test_vtk_reads_the_boxes_of_a_slice(self):
        folder = self.ran(STEPS)[0].uda / "slice/x=0.16"
        reader = vtkHDFReader()
        reader.SetFileName(str(folder / "slice.vtkhdf"))
        reader.UpdateInformation()
        with h5py.File(folder / "t00120.h5") as output:
            reader.UpdateTimeStep(output.attrs["time"])
            amr, boxes = reader.GetOutputDataObject(0), output["grid/boxes"][()]
            values, first, seen = output["cells/c.density"][()], 0, {}
            for level, *corners in boxes:
                image = amr.GetDataSetAsImageData(int(level), seen.get(level, 0))
                seen[level] = seen.get(level, 0) + 1
                read = vtk_to_numpy(image.GetCellData().GetArray("c.density"))
                self.assertEqual(len(read), corners[4] - corners[1])
                np.testing.assert_array_equal(read, values[first:first + len(read)])
                first += len(read)
            self.assertEqual(first, len(values))
            self.assertGreater(len(seen), 1)

    def test_any_layout_and_a_restart_leave_the_same_bytes(self):
        expected = self.files_of(self.ran(STEPS)[0])
        self.assertGreater(len(expected), 100)
        for options, ranks in ((("-layout", "3x2x1", "-nthreads", "2"), 1), (("-layout", "2x2x1"), 2)):
            self.assertEqual(self.files_of(self.ran(STEPS, options=options, ranks=ranks)[0]), expected, options)
        cut, _ = self.ran("Time/max_Timesteps=87")
        self.well(cut.restart(STEPS, step=80))
        self.assertEqual(self.files_of(cut), expected, "after a restart")


if __name__ == "__main__":
    unittest.main()
