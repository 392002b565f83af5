#!/usr/bin/env python3
"""Tests of what pictures say: names on axes, the exact solution, notes: python3 tests/tools/plot_texts_test.py"""
import tempfile
import unittest

from plot_test import WithArchives

import fake_uda
from tushar import Archive
from tushar.figure import Figure
from tushar.panels import words


class Names(unittest.TestCase):
    def test_are_labels_in_words_and_keep_abbreviations(self):
        for label, name in (("p.particleID", "particle ID"), ("p.internalEnergy", "internal energy"),
                            ("p.loadCurveID", "load curve ID"), ("p.velGrad", "vel grad"), ("p.x", "x")):
            self.assertEqual(words(label), name)


class Exact(WithArchives):
    def test_is_not_the_place_of_the_particles(self):
        for label, legend in (("p.x", None), ("p.velocity.x", None), ("p.density", ["particles", "exact"])):
            shown = Figure(Archive(self.sod), variables=[label]).figure.axes[0].get_legend()
            self.assertEqual(shown and [text.get_text() for text in shown.get_texts()], legend, label)


class Notes(WithArchives):
    def test_a_gas_lacks_what_its_scene_does_not_save_and_a_solid_lacks_nothing(self):
        others = ("p.density", "p.pressure", "p.internalEnergy")
        for left_out, count in ((others, 0), (others[1:], 2)):
            with tempfile.TemporaryDirectory() as folder:
                notes = Figure(Archive(fake_uda.make_sod(folder, leave_out=left_out))).notes
            self.assertEqual(len(notes), count, notes)
            self.assertTrue(all('add <save label="' in note for note in notes))


if __name__ == "__main__":
    unittest.main()
