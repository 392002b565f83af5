#!/usr/bin/env python3
"""Tests of what pictures say: names on axes, the exact solution, notes: python3 tests/tools/plot_texts_test.py"""
import unittest

from plot_test import WithArchives

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


if __name__ == "__main__":
    unittest.main()
