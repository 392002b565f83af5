#!/usr/bin/env python3
"""Archives in pandas, xarray, pyvista and yt, where they are installed: python3 tests/python/frames_test.py"""
import os
import tempfile
import unittest

import support

support.ensure("h5py", "numpy")
WITHOUT = {name: support.missing(name) for name in ("pandas", "xarray", "pyvista", "yt")}

import numpy as np

import fake_uda
import tushar
from in_folder import InFolder


class WithArchives(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, archive in fake_uda.make_all(cls.folder).items():
            setattr(cls, name, tushar.open(archive))


@unittest.skipIf(WITHOUT["pandas"], WITHOUT["pandas"])
class Pandas(WithArchives):
    def test_particles_are_rows(self):
        frame = self.sod[-1].to_pandas()
        np.testing.assert_array_equal(frame["p.density"], self.sod[-1]["p.density"].values)
        np.testing.assert_array_equal(frame["p.velocity.x"], self.sod[-1]["p.velocity"][:, 0])
        self.assertEqual(frame.attrs["units"]["p.velocity.x"], "m/s")

    def test_rows_go_by_id_and_name_their_material(self):
        frame = self.moving[0].to_pandas()
        self.assertEqual((list(frame.index), list(frame["material"])), ([10, 20, 30], ["a", "a", "b"]))
        self.assertEqual(frame["p.mass"].isna().tolist(), [False, False, True])
        self.assertEqual(list(self.moving[0].to_pandas(material="b").index), [30])

    def test_cells_and_nodes_have_their_places(self):
        frame = self.plate[-1].to_pandas()
        self.assertEqual((list(frame.columns), len(frame)), (["x", "y", "c.temperature"], 24))
        self.assertAlmostEqual(frame["y"][6], 0.375)
        self.assertEqual(frame["c.temperature"][7], self.plate[-1]["c.temperature"][0, 1, 1])
        self.assertEqual(len(self.plate[-1].to_pandas("nodes")), 35)
        with self.assertRaisesRegex(tushar.ArchiveError, r"no kind of value 'cell' \(did you mean 'cells'"):
            self.plate[-1].to_pandas("cell")

    def test_globals_go_by_time(self):
        frame = self.sod.globals.to_pandas()
        self.assertEqual(frame["KineticEnergy"].to_dict(), {0.0: 0.0, 0.1: 0.05, 0.2: 0.1})
        self.assertEqual(self.sod.to_pandas().attrs["units"], {"KineticEnergy": "J"})

    def test_tracks_go_by_time_and_id(self):
        frame = self.moving.particles([20, 30]).to_pandas()
        self.assertEqual(frame.loc[(1.0, 30), "p.x.x"], 31)
        self.assertTrue(np.isnan(frame.loc[(1.0, 20), "p.x.x"]))


@unittest.skipIf(WITHOUT["xarray"], WITHOUT["xarray"])
class Xarray(WithArchives):
    def test_fields_have_coordinates_and_units(self):
        data = self.plate.to_xarray()
        self.assertEqual(dict(data["c.temperature"].sizes), {"time": 2, "z": 1, "y": 4, "x": 6})
        self.assertEqual(data["c.temperature"].attrs["units"], "K")
        self.assertEqual(data["g.mass"].dims, ("time", "z_node", "y_node", "x_node"))
        np.testing.assert_allclose(data["y"], [0.125, 0.375, 0.625, 0.875])
        for index in (0, 1):
            np.testing.assert_array_equal(data["c.temperature"][index], self.plate[index]["c.temperature"].values)

    def test_they_are_read_when_they_are_used(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = tushar.open(fake_uda.make_heat(folder))
            data = archive.to_xarray(["c.temperature"])
            os.remove(archive.files[0])
            self.assertEqual(data["c.temperature"].isel(time=1, x=slice(0, 50, 7)).shape, (1, 1, 8))
            with self.assertRaisesRegex(tushar.ArchiveError, "t00000.h5"):
                data["c.temperature"].isel(time=0).values

    def test_a_start_that_lacks_a_field_has_no_numbers(self):
        with tempfile.TemporaryDirectory() as folder:
            import h5py
            archive = tushar.open(fake_uda.make_heat(folder))
            with h5py.File(archive.files[0], "r+") as file:
                del file["nodes/g.mass"]
            mass = archive.to_xarray()["g.mass"].values
            self.assertTrue(np.isnan(mass[0]).all() and (mass[1] == 1).all())

    def test_one_output_has_one_time(self):
        self.assertEqual(float(self.plate[-1].to_xarray()["time"]), 1.0)
        with self.assertRaisesRegex(tushar.ArchiveError, "contains no fields"):
            self.disks.to_xarray()

    def test_tracks_have_time_and_id(self):
        data = self.moving.particles([20, 30]).to_xarray()
        self.assertEqual(float(data["p.x"].sel(time=1, id=30, component_3="x")), 31)


@unittest.skipIf(WITHOUT["pyvista"], WITHOUT["pyvista"])
class Pyvista(WithArchives):
    def test_cells_nodes_and_particles(self):
        for archive in (self.plate, self.box):
            cells = archive[-1].to_pyvista()["cells"]
            np.testing.assert_array_equal(cells.cell_data["c.temperature"], archive[-1]["c.temperature"].ravel())
            self.assertTrue((cells.point_data["g.mass"] == 1).all())
            np.testing.assert_allclose(cells.bounds, [0, 1, 0, 1, 0, 1])
        blocks = self.disks[-1].to_pyvista()
        self.assertEqual(list(blocks.keys()), ["left", "right"])
        np.testing.assert_array_equal(blocks["left"].points, self.disks[-1]["p.x", "left"].values)
        self.assertEqual(blocks["right"].point_data["p.velocity"].shape[1], 3)


@unittest.skipIf(WITHOUT["yt"], WITHOUT["yt"])
class Yt(WithArchives):
    @classmethod
    def setUpClass(cls):
        import yt
        yt.set_log_level("error")
        super().setUpClass()

    def test_cells_and_their_units(self):
        data = self.box[-1].to_yt()
        warmest = data.all_data()["stream", "c.temperature"].max()
        self.assertEqual((float(warmest), str(warmest.units)), (self.box[-1]["c.temperature"].max(), "K"))
        place = data.find_max(("stream", "c.temperature"))[1]
        z, y, x = np.unravel_index(self.box[-1]["c.temperature"].argmax(), (3, 4, 6))
        np.testing.assert_allclose(place, [(x + 0.5) / 6, (y + 0.5) / 4, (z + 0.5) / 3])

    def test_particles(self):
        found = self.disks[-1].to_yt().all_data()
        self.assertEqual(len(found["io", "particle_position_x"]), len(self.disks[-1]["p.x"]))
        self.assertEqual(str(found["io", "p.density"].units), "kg/m**3")


class Missing(WithArchives):
    def test_a_library_that_is_not_there_is_named(self):
        from unittest import mock
        with mock.patch.dict("sys.modules", {name: None for name in WITHOUT}):
            for name, convert in (("pandas", self.sod.to_pandas), ("xarray", self.plate.to_xarray),
                                  ("pyvista", self.sod[-1].to_pyvista), ("yt", self.sod[-1].to_yt)):
                with self.assertRaisesRegex(ImportError, f"to_{name} needs {name}, .*: python3 -m pip install {name}"):
                    convert()


if __name__ == "__main__":
    unittest.main()
