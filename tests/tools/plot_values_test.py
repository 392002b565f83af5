#!/usr/bin/env python3
"""Tests of values that cannot be drawn: beyond the range, not numbers, not above 0 on a logarithmic scale."""
import tempfile
import unittest
import warnings
from unittest import mock

from plot_test import WithArchives

import h5py
import numpy as np

import fake_uda
from tushar import Archive, ArchiveError, film
from tushar.figure import Figure
from tushar.view import View


class Unusual(WithArchives):
    def plate_with(self, change, cells=(6, 4, 1), dimension=2):
        """Returns an archive with changed temperatures in the last output."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        plate = Archive(fake_uda.make_heat(folder.name, cells, dimension, "plate"))
        with h5py.File(plate.files[-1], "r+") as file:
            file["cells/c.temperature"][...] = change(file["cells/c.temperature"][()])
        return plate

    @staticmethod
    def figure(archive, **choices):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            figure = Figure(archive, variables=["c.temperature"], view=View(**choices))
            figure.pixels()
        return figure


class Ranges(Unusual):
    def test_beyond_the_values_are_told(self):
        for archive, slices in ((self.plate, {}), (self.plate, {1: 0.6}), (self.box, {})):
            for limits, sentence in (((400, None), "the range begins at 400, but the values of 'c.temperature' extend"),
                                     ((None, 0.1), "the range ends at 0.1, but the values of 'c.temperature' extend")):
                with self.assertRaisesRegex(ArchiveError, sentence):
                    self.figure(Archive(archive), slices=slices, range=limits)

    def test_are_told_by_the_tool(self):
        code, _, err = self.plot(self.plate, "c.temperature", "--range", "400,")
        self.assertEqual(code, 1)
        self.assertRegex(err, "plot: the range begins at 400, but the values of 'c.temperature' extend from 3.* to 3")

    def test_of_one_limit_hold_for_a_constant_at_this_limit(self):
        plate = self.plate_with(lambda values: 0 * values + 5)
        for limits in ((5, None), (None, 5)):
            low, high = self.figure(plate, range=limits).figure.axes[0].images[0].get_clim()
            self.assertTrue(low < 5 < high)

    def test_of_one_limit_have_the_other_in_common_in_a_film(self):
        values = np.concatenate([snapshot["c.temperature"].ravel() for snapshot in Archive(self.plate)])
        figures = film.figures(Archive(self.plate), ["c.temperature"], None, View(range=(None, 400)))
        self.assertEqual({figure.figure.axes[0].images[0].get_clim() for figure in figures}, {(values.min(), 400)})
        with self.assertRaisesRegex(ArchiveError, "the range begins at 400"):
            list(film.figures(Archive(self.plate), ["c.temperature"], None, View(range=(400, None))))


def spoilt(values):
    """Values of which the first two are not numbers."""
    values.ravel()[:2] = np.nan, np.inf
    return values


class NoNumbers(Unusual):
    def test_are_counted(self):
        for slices, count in (({}, "2 of 24"), ({1: 0.1}, "2 of 6")):
            figure = self.figure(self.plate_with(spoilt), slices=slices)
            self.assertEqual(figure.notes, [f"{count} values of 'c.temperature' are not numbers"])
        with mock.patch("tushar.space._pyvista", return_value=None):
            notes = self.figure(self.plate_with(spoilt, (6, 4, 3), 3)).notes
        self.assertEqual(notes[0], "2 of 72 values of 'c.temperature' are not numbers")

    def test_alone_are_told(self):
        for slices, count in (({}, "24 of 24"), ({1: 0.1}, "6 of 6")):
            with self.assertRaisesRegex(ArchiveError, f"^{count} values of 'c.temperature' are not numbers, so"):
                self.figure(self.plate_with(lambda values: values * np.nan), slices=slices)

    def test_do_not_end_a_film(self):
        plate = self.plate_with(lambda values: values * np.nan)
        for slices, count in (({}, "24 of 24"), ({1: 0.1}, "6 of 6")):
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                figures = list(film.figures(plate, ["c.temperature"], None, View(slices)))
                figures[1].pixels()
            self.assertEqual([figure.notes for figure in figures],
                             [[], [f"output 1: {count} values of 'c.temperature' are not numbers"]])


class Logarithms(Unusual):
    def test_of_nothing_above_0_are_told(self):
        for slices in ({}, {1: 0.6}):
            for limits in (None, (1, 2)):
                with self.assertRaisesRegex(ArchiveError, "'c.temperature' has no values above 0"):
                    self.figure(self.plate_with(lambda values: -values), slices=slices, range=limits, log=True)

    def test_of_limits_that_are_not_above_0_are_told(self):
        for limits, found in (("-1,1", -1), ("0,", 0), (",-2", -2)):
            code, _, err = self.plot(self.plate, "c.temperature", "--log", f"--range={limits}")
            self.assertEqual((code, err), (1, f"plot: a logarithmic scale has no place for {found}: with --log, the "
                                              "limits of --range must be above 0\n"))


if __name__ == "__main__":
    unittest.main()
