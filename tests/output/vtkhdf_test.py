#!/usr/bin/env python3
"""Reads the VTKHDF files of an archive with VTK's own reader, the one of ParaView, and compares with the HDF5 files.

    SUS=build/dev/sus python3 tests/output/vtkhdf_test.py

Needs h5py, numpy and VTK 9.3 or newer (`pip install vtk h5py`), or all is skipped.
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS
from vtk_readers import MISSING, Pipeline, h5py, np, vtk_to_numpy, vtkHDFReader

NODES = '<save label="g.mass"/><save label="g.velocity"/></DataArchiver>'
PAIR = ROOT / "ups/solid/two_discs.ups"
SOD = ROOT / "ups/mpm/sod.ups"
SHORT = ["--set", "Time/max_Timesteps=20", "--set", "DataArchiver/outputInterval=0", "--set",
         "DataArchiver/outputTimestepInterval=5"]


def sus(*arguments):
    return subprocess.run([SUS, "--quiet", *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)


def datasets(group):
    """Returns the values of all datasets below `group`, by their path with _ in place of /."""
    found = {}
    group.visititems(lambda name, item: found.update({name.replace("/", "_"): item[()]})
                     if isinstance(item, h5py.Dataset) else None)
    return found


class Series:
    """A VTKHDF file as VTK reads it."""

    def __init__(self, path):
        self.reader = vtkHDFReader()
        self.reader.SetFileName(str(path))
        self.reader.UpdateInformation()
        times, information = Pipeline.TIME_STEPS(), self.reader.GetOutputInformation(0)
        self.times = [information.Get(times, k) for k in range(information.Length(times))]

    def at(self, time):
        self.reader.UpdateTimeStep(time)
        return self.reader.GetOutputDataObject(0)


@unittest.skipIf(MISSING, MISSING)
class VtkHdf(unittest.TestCase):
    def archive_of(self, scene, *options):
        """Runs a scene and returns its archive's folder and its outputs, opened, by time."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        ended = sus(scene, "--output", folder.name, *options)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        archive = next(pathlib.Path(folder.name).glob("*.uda.000"))
        outputs = [h5py.File(file, "r") for file in sorted(archive.glob("t*.h5"))]
        for output in outputs:
            self.addCleanup(output.close)
        return archive, outputs

    def with_nodes(self, scene):
        """Returns a copy of the scene that also saves node variables."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        copy = pathlib.Path(folder.name) / scene.name
        copy.write_text(scene.read_text().replace("</DataArchiver>", NODES))
        return copy

    def assert_same(self, name, read, kept):
        self.assertIsNotNone(read, name)
        np.testing.assert_array_equal(vtk_to_numpy(read).ravel(), np.ravel(kept), err_msg=name)

    def compare_particles(self, archive, outputs):
        stem = next(archive.glob("*.xdmf")).stem
        for material in outputs[0]["particles"]:
            series = Series(archive / f"{stem}.{material}.vtkhdf")
            self.assertEqual(series.times, [output.attrs["time"] for output in outputs])
            for output in outputs:
                data, group = series.at(output.attrs["time"]), output["particles"][material]
                count = len(group["p.x"])
                self.assertEqual((data.GetNumberOfPoints(), data.GetNumberOfCells()), (count, count))
                self.assert_same("p.x", data.GetPoints().GetData(), group["p.x"])
                self.assert_same("points", data.GetCells().GetConnectivityArray(), np.arange(count))
                self.assert_same("offsets", data.GetCells().GetOffsetsArray(), np.arange(count + 1))
                self.assertEqual({data.GetCellType(k) for k in range(0, count, 7)}, {1}, "VTK_VERTEX")
                for label in set(group) - {"p.x"}:
                    self.assert_same(label, data.GetPointData().GetArray(label), group[label])

    def compare_fields(self, archive, outputs):
        series = Series(archive / (next(archive.glob("*.xdmf")).stem + ".vtkhdf"))
        outputs = [output for output in outputs if "cells" in output or "nodes" in output]
        self.assertEqual(series.times, [output.attrs["time"] for output in outputs])
        seen = 0
        for output in outputs:
            data, grid = series.at(output.attrs["time"]), output["grid"].attrs
            for name, values in datasets(output["cells"]).items() if "cells" in output else ():
                self.assert_same(name, data.GetCellData().GetArray(name), values)
                seen += 1
            points = data.GetDimensions()[::-1]
            for name, values in datasets(output["nodes"]).items() if "nodes" in output else ():
                repeat = [n // m for n, m in zip(points, values.shape)] + [1] * (values.ndim - 3)
                self.assert_same(name, data.GetPointData().GetArray(name), np.tile(values, repeat))
                seen += 1
            np.testing.assert_allclose(data.GetSpacing(), grid["spacing"], rtol=1e-15)
            np.testing.assert_allclose(data.GetOrigin(), grid["lower"], rtol=1e-15, atol=1e-15)
            np.testing.assert_array_equal(data.GetDimensions(), grid["cells"] + 1)
        self.assertGreater(seen, 0)

    def test_cells_nodes_and_particles_in_one_dimension(self):
        archive, outputs = self.archive_of(self.with_nodes(SOD), *SHORT)
        self.compare_particles(archive, outputs)
        self.compare_fields(archive, outputs)

    def test_several_materials_and_nodes_alone_in_two_dimensions(self):
        archive, outputs = self.archive_of(self.with_nodes(PAIR), *SHORT)
        self.compare_particles(archive, outputs)
        self.compare_fields(archive, outputs)

    def test_more_outputs_than_one_dataset_shows(self):
        archive, outputs = self.archive_of(self.with_nodes(SOD), "--set", "Time/max_Timesteps=600", "--set",
                                           "DataArchiver/outputInterval=0", "--set",
                                           "DataArchiver/outputTimestepInterval=1", "--set", "Time/maxTime=1e9")
        self.assertGreater(len(outputs), 2 * 256)
        with h5py.File(archive / "sod.gas.vtkhdf", "r") as file:
            self.assertEqual({part.file_name for part in file["VTKHDF/Points"].virtual_sources()}, {"."})
        self.compare_particles(archive, outputs)
        self.compare_fields(archive, outputs)

    def test_compressed_floats(self):
        archive, outputs = self.archive_of(SOD, *SHORT, "--set", "DataArchiver/compression=gzip", "--set",
                                           "DataArchiver/outputDoubleAsFloat=true")
        self.compare_particles(archive, outputs)
        self.compare_fields(archive, outputs)

    def test_a_restart_shows_what_the_whole_run_shows(self):
        more = ["--set", "DataArchiver/checkpoint/@timestepInterval=5"]
        whole, _ = self.archive_of(SOD, *SHORT, *more)
        cut, _ = self.archive_of(SOD, *SHORT, *more, "--set", "Time/max_Timesteps=12")
        ended = sus("-restart", cut, "-t", "10", "--set", "Time/max_Timesteps=20")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        for file in whole.glob("*.vtkhdf"):
            self.assertEqual(file.read_bytes(), (cut / file.name).read_bytes(), file.name)

    def test_copies_no_value(self):
        archive, outputs = self.archive_of(SOD, *SHORT)
        with h5py.File(archive / "sod.gas.vtkhdf", "r") as file:
            held = []
            file["VTKHDF"].visititems(lambda name, item: held.append(name) if isinstance(item, h5py.Dataset) and
                                      not item.is_virtual and item.id.get_storage_size() > 8 * len(outputs) else None)
        self.assertEqual(held, ["Connectivity"])


if __name__ == "__main__":
    unittest.main()
