#!/usr/bin/env python3
"""Reads an XDMF file with VTK's own reader, the one of ParaView, and compares with the HDF5 files.

    python3 tests/output/xdmf_test.py sod.uda/sod.xdmf
    SUS=build/dev/sus python3 tests/output/xdmf_test.py        # runs ups/mpm/sod.ups first

Needs h5py, numpy and a VTK with the XDMF reader, or all is skipped: `pip install vtk h5py`, or Debian's
python3-paraview with python3-h5py. Debian's python3-vtk9 comes without that reader, and cannot be installed beside
python3-paraview.
"""
import glob
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path.insert(0, os.path.join(ROOT, "tools", "python"))
from tushar.interpreter import ensure

MISSING = None
try:
    ensure("h5py", "numpy", "vtkmodules.vtkIOXdmf2")
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
    from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
except SystemExit:
    MISSING = "no Python here has h5py and a VTK that reads XDMF: pip install vtk h5py, or Debian's python3-paraview"

XDMF = None


def all_datasets(group):
    """Returns the values of all datasets below `group`, by path."""
    found = {}
    group.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


@unittest.skipIf(MISSING, MISSING)
class Xdmf(unittest.TestCase):
    def setUp(self):
        files = sorted(glob.glob(os.path.join(glob.escape(os.path.dirname(XDMF)), "t*.h5")))
        self.outputs = [h5py.File(file, "r") for file in files]
        self.outputs.sort(key=lambda output: output.attrs["time"])
        self.reader = vtkXdmfReader()
        self.reader.SetFileName(XDMF)
        self.reader.UpdateInformation()

    def tearDown(self):
        for output in self.outputs:
            output.close()

    def blocks(self, output):
        """Returns the datasets of an output at a time, by block name."""
        self.reader.UpdateTimeStep(output.attrs["time"])
        top = self.reader.GetOutputDataObject(0)
        if not top.IsA("vtkMultiBlockDataSet"):
            names = list(output.get("particles", {})) + ["cells" if "cells" in output else "nodes"]
            return {names[0]: top}
        name = vtkCompositeDataSet.NAME()
        return {top.GetMetaData(i).Get(name): top.GetBlock(i) for i in range(top.GetNumberOfBlocks())}

    def assert_same(self, name, read, kept):
        np.testing.assert_array_equal(vtk_to_numpy(read).ravel(), np.ravel(kept), err_msg=name)

    def test_lists_every_time(self):
        times = Pipeline.TIME_STEPS()
        information = self.reader.GetOutputInformation(0)
        read = [information.Get(times, k) for k in range(information.Length(times))]
        self.assertEqual(read, [output.attrs["time"] for output in self.outputs])

    def test_shows_every_particle_array(self):
        for output in self.outputs:
            for material, group in output.get("particles", {}).items():
                block = self.blocks(output)[material]
                count = len(group["p.x"])
                self.assertEqual(block.GetNumberOfPoints(), count, material)
                if count == 0:
                    continue
                self.assertEqual(block.GetNumberOfCells(), count, material)
                self.assert_same("p.x", block.GetPoints().GetData(), group["p.x"])
                for label in set(group) - {"p.x"}:
                    self.assert_same(label, block.GetPointData().GetArray(label), group[label])

    def test_shows_every_field(self):
        for output in self.outputs:
            for centring in ("cells", "nodes"):
                for name, values in all_datasets(output[centring]).items() if centring in output else ():
                    block = self.blocks(output)[centring]
                    data = block.GetCellData() if centring == "cells" else block.GetPointData()
                    self.assert_same(name, data.GetArray(name), values)

    def test_places_the_cells_where_the_grid_is(self):
        for output in self.outputs:
            if "cells" not in output:
                continue
            grid, block = output["grid"].attrs, self.blocks(output)["cells"]
            np.testing.assert_allclose(block.GetOrigin(), grid["lower"], rtol=1e-15)
            np.testing.assert_allclose(block.GetSpacing(), grid["spacing"], rtol=1e-15)
            np.testing.assert_array_equal(block.GetDimensions(), grid["cells"] + 1)


def run_scene(sus, folder):
    """Runs Sod's problem and returns its XDMF file."""
    scene = os.path.join(ROOT, "ups", "mpm", "sod.ups")
    subprocess.run([sus, scene, "--output", folder, "--quiet"], check=True)
    return os.path.join(folder, "sod.uda", "sod.xdmf")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        if len(sys.argv) > 1 and sys.argv[1].endswith(".xdmf"):
            XDMF = sys.argv.pop(1)
        elif "SUS" in os.environ:
            XDMF = run_scene(os.environ["SUS"], folder)
        else:
            sys.exit("usage: python3 tests/output/xdmf_test.py PATH_TO_XDMF, or with the path of sus in SUS")
        program = unittest.main(exit=False)
    sys.exit(not program.result.wasSuccessful())
