#!/usr/bin/env python3
"""Words of a scene that had been passed over, or had ended the program: each is refused or noted."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS, run

DISCS = (ROOT / "ups/solid/two_discs.ups").read_text()
GRAINS = (ROOT / "ups/solid/passing_grains.ups").read_text()
SLAB = (ROOT / "ups/fsi/burning_slab.ups").read_text()
GAS = (ROOT / "ups/ice/jet.ups").read_text()
BLOCKS = (ROOT / "ups/solid/two_material_contact.ups").read_text()


def without(text, tag):
    return re.sub(rf"<{tag}\b.*?</{tag}>", "", text, flags=re.DOTALL)


def module(text, tags):
    return text.replace("<DataArchiver>", f"<DataAnalysis>{tags}</DataAnalysis><DataArchiver>", 1)


def sampling(name, tags):
    return (f'<Module name="{name}"><samplingFrequency>100</samplingFrequency><timeStart>0</timeStart>'
            f"<timeStop>1</timeStop>{tags}</Module>")


def variables(*labels):
    return "<Variables>" + "".join(f'<analyze label="{label}"/>' for label in labels) + "</Variables>"


def first_law(*faces):
    return sampling("firstLawThermo", "<controlVolume>" + "".join(faces) + "</controlVolume>")


def part(side, start, end):
    return (f'<Face side="{side}" extents="partialFace"><startPt>{start}</startPt><endPt>{end}</endPt></Face>')


class PassedOver(unittest.TestCase):
    def check(self, text, *options):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "scene.ups")
            scene.write_text(text)
            for given in (ROOT / "ups/solid").glob("*.txt"):
                (scene.parent / given.name).write_text(given.read_text())
            return run(scene, options=("--check", *options))

    def assert_refused(self, text, sentence):
        result = self.check(text)
        self.assertEqual(result.code, 3, result.out + result.err)
        self.assertIn(sentence, result.err)

    def assert_noted(self, text, sentence):
        result = self.check(text)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn(sentence, result.out + result.err)

    def test_what_is_missing_of_bodies(self):
        self.assert_refused(without(SLAB, "MaterialProperties"), "the section <MaterialProperties> is missing")
        self.assert_refused(without(GRAINS, "geom_object"), "there are no particles: no geom_object overlaps the grid")

    def test_planes_of_slices(self):
        for plane in ("w = 3", "z", "z = x"):
            self.assert_refused(module(GAS, f'<Module name="slice"><plane>{plane}</plane><label>c.density</label>'
                                            "<outputTimestepInterval>2</outputTimestepInterval></Module>"),
                                f"found '{plane}', expected an axis and a coordinate in m")

    def test_variables_of_modules(self):
        extract = sampling("particleExtract", "<colorThreshold>0</colorThreshold>" + variables("p.velocity", "g.mass"))
        self.assert_refused(module(DISCS, extract), "found 'g.mass', expected a particle variable (p.)")
        orientation = "<planeOrientation>YZ</planeOrientation>"
        self.assert_refused(module(DISCS, sampling("planeAverage", orientation + variables("g.mass"))),
                            "found 'g.mass', expected a cell variable (c.)")

    def test_tags_of_models(self):
        for extra, sentence in (("<Simple_Burn><BurnCoeff>9</BurnCoeff></Simple_Burn>", "<Simple_Burn> is given twice"),
                                ("<useCrackModel>true</useCrackModel>", "unknown tag <useCrackModel> in <Model>")):
            self.assert_refused(SLAB.replace("</Model>", extra + "</Model>", 1), sentence)

    def test_materials_of_a_contact(self):
        for listed, sentence in (("[0,5]", "there is no material 5; materials are numbered from 0 to 1"),
                                 ("[0]", "lists less than two materials, so that this contact has no effect")):
            text = re.sub(r"<materials>.*?</materials>", f"<materials>{listed}</materials>", BLOCKS)
            self.assert_noted(text, sentence)

    def test_totals_of_one_material(self):
        self.assert_noted(BLOCKS.replace('<save label="KineticEnergy"/>', '<save label="KineticEnergy" material="0"/>'),
                          "'KineticEnergy' is a total over all materials, and is saved as such")

    def test_parts_of_sides(self):
        whole = '<Face side="x-"/>'
        for faces, sentence in (((whole, whole), "the same side as on line"),
                                ((part("x-", "[5,0,0]", "[5,1,1]"),), "where this side is"),
                                ((part("x-", "[0,1,1]", "[0,0,0]"),), "the coordinate of startPt"),
                                (('<Face side="x-"><startPt>[0,0,0]</startPt></Face>',), "need extents 'partialFace'")):
            with self.subTest(sentence):
                self.assert_refused(module(GAS, first_law(*faces)), sentence)

    def test_variables_that_only_steps_compute_can_be_saved(self):
        for scene, label in (("spall", "p.temperatureChange"), ("glued_blocks", "p.czMassTop")):
            text = (ROOT / f"ups/solid/{scene}.ups").read_text()
            result = self.check(text.replace("<DataArchiver>", f'<DataArchiver><save label="{label}"/>', 1))
            self.assertEqual(result.code, 0, result.err)

    def test_labels_of_other_models_get_a_note(self):
        for label in ("p.CapX", "p.porosity", "g.normAlphaToBeta"):
            self.assert_noted(DISCS.replace("<DataArchiver>", f'<DataArchiver><save label="{label}"/>', 1),
                              f"'{label}' is not saved, since no task computes it in this scene")

    def test_half_spaces(self):
        space = "<half_space type='relativ'><offset>{}</offset></half_space>"
        sides = "".join(space.format(at) for at in ("[1,0,0]", "[-1,0,0]", "[0,1,0]", "[0,-1,0]"))
        shape = f"<polyhedron><center>[0,0,0]</center><bounds>{sides}</bounds></polyhedron>"
        text = DISCS.replace("<geom_object>", f"<geom_object>{shape}<res>[2,2,1]</res></geom_object><geom_object>", 1)
        self.assert_refused(text, "attribute 'type': found 'relativ', expected 'absolute' or 'relative'")

    def test_overrides_that_come_too_late(self):
        with tempfile.TemporaryDirectory() as folder:
            sets = ("DataArchiver/checkpoint/@timestepInterval=2", "Time/max_Timesteps=4")
            def sus(*words):
                return subprocess.run([SUS, *words], cwd=ROOT, capture_output=True, text=True, timeout=300)

            def override(*all):
                return [word for one in all for word in ("--set", one)]

            first = sus("ups/solid/two_material_contact.ups", "--output", folder,
                        *override("DataArchiver/checkpoint/@timestepInterval=2", "Time/max_Timesteps=4"))
            self.assertEqual(first.returncode, 0, first.stderr)
            archive = next(pathlib.Path(folder).glob("*.uda.*"))
            body = "MaterialProperties/MPM/material[1]/geom_object/velocity=[1,0,0]"
            again = sus("--restart", archive,
                        *override("Time/max_Timesteps=6", "DataArchiver/filebase=other", body))
            self.assertEqual(again.returncode, 0, again.stderr)
            said = again.stdout + again.stderr
            self.assertIn("does not change anything: the run goes on in its folder", said)
            self.assertIn("does not change anything: the state of the run is that of its checkpoint", said)


if __name__ == "__main__":
    unittest.main()
