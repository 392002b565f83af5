#!/usr/bin/env python3
"""Reads what an archive of a refined grid has for viewers, XDMF and VTKHDF, with VTK's own readers, the ones of
ParaView, and compares with the HDF5 files.

    UNIT_TESTS=build/dev/tests/unit_tests python3 tests/output/refined_test.py

Needs h5py, numpy and a VTK that reads both (`pip install vtk h5py`), or all is skipped.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT
from vtk_readers import MISSING, Pipeline, h5py, np, vtk_to_numpy, vtkHDFReader

if not MISSING:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

UNIT_TESTS = os.environ.get("UNIT_TESTS", str(ROOT / "build/dev/tests/unit_tests"))


@unittest.skipIf(MISSING, MISSING)
class Refined(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        subprocess.run([UNIT_TESTS, "--gtest_filter=Archive.CanBeLeftForOtherReaders"], check=True, cwd=ROOT,
                       env={**os.environ, "TUSHAR_TEST_ARCHIVE": folder.name}, stdout=subprocess.DEVNULL)
        cls.archive = pathlib.Path(folder.name) / "refined.uda"
        cls.outputs = [h5py.File(file, "r") for file in sorted(cls.archive.glob("t*.h5"))]
        for output in cls.outputs:
            cls.addClassCleanup(output.close)

    def reader(self, kind, name):
        reader = kind()
        reader.SetFileName(str(self.archive / name))
        reader.UpdateInformation()
        times, information = Pipeline.TIME_STEPS(), reader.GetOutputInformation(0)
        self.assertEqual([information.Get(times, k) for k in range(information.Length(times))],
                         [output.attrs["time"] for output in self.outputs])
        return reader

    def assert_is_box(self, image, output, number, names):
        """Checks that an image has the position and the values of an output's box; `names` maps its data to paths."""
        boxes, grid = output["grid/boxes"][()], output["grid"].attrs
        level, lower, upper = boxes[number][0], boxes[number][1:4], boxes[number][4:]
        spacing = output["grid/levels"][level]
        ends = np.stack([grid["lower"] + lower * spacing, grid["lower"] + upper * spacing], axis=1)
        np.testing.assert_allclose(image.GetBounds(), ends.ravel(), rtol=1e-14, atol=1e-15)
        self.assertEqual(image.GetNumberOfCells(), np.prod(upper - lower))
        first = int(np.prod(boxes[:number, 4:] - boxes[:number, 1:4], axis=1).sum())
        for name, path in names.items():
            read = vtk_to_numpy(image.GetCellData().GetArray(name))
            np.testing.assert_array_equal(read, output[path][first:first + len(read)], err_msg=name)

    def paths(self, output):
        """Returns the paths of all fields, such as `gas/c.density`."""
        found = []
        output["cells"].visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
        return found

    def test_xdmf_shows_a_grid_for_each_box_beside_the_particles(self):
        reader = self.reader(vtkXdmfReader, "refined.xdmf")
        for output in self.outputs:
            reader.UpdateTimeStep(output.attrs["time"])
            top, name = reader.GetOutputDataObject(0), vtkCompositeDataSet.NAME()
            blocks = {top.GetMetaData(k).Get(name): top.GetBlock(k) for k in range(top.GetNumberOfBlocks())}
            self.assertEqual(blocks["gas"].GetNumberOfPoints(), 5)
            cells, boxes = blocks["cells"], output["grid/boxes"]
            self.assertEqual(cells.GetNumberOfBlocks(), len(boxes))
            for number in range(len(boxes)):
                self.assertEqual(cells.GetMetaData(number).Get(name),
                                 f"level {boxes[number, 0]} box {number} at step {output.attrs['step']}")
                names = {path: "cells/" + path for path in self.paths(output)}
                self.assert_is_box(cells.GetBlock(number), output, number, names)

    def test_vtkhdf_shows_the_boxes_of_each_level(self):
        reader = self.reader(vtkHDFReader, "refined.vtkhdf")
        for output in self.outputs:
            reader.UpdateTimeStep(output.attrs["time"])
            amr, levels = reader.GetOutputDataObject(0), list(output["grid/boxes"][:, 0])
            names = {path.replace("/", "_"): "cells/" + path for path in self.paths(output)}
            for level in set(levels):
                numbers = [number for number, own in enumerate(levels) if own == level]
                self.assertEqual(amr.GetNumberOfBlocks(level), len(numbers))
                for k, number in enumerate(numbers):
                    image = amr.GetDataSetAsImageData(level, k)
                    self.assert_is_box(image, output, number, names)
                    self.assertFalse(image.HasAnyBlankCells())
            self.assertEqual(amr.GetNumberOfCells(), len(output["cells/c.temperature"]))

    def test_a_field_that_an_output_lacks_is_not_a_number(self):
        reader = self.reader(vtkHDFReader, "refined.vtkhdf")
        reader.UpdateTimeStep(self.outputs[0].attrs["time"])
        image = reader.GetOutputDataObject(0).GetDataSetAsImageData(0, 0)
        self.assertTrue(np.isnan(vtk_to_numpy(image.GetCellData().GetArray("c.velocity"))).all())


if __name__ == "__main__":
    unittest.main()
