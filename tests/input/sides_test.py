#!/usr/bin/env python3
"""Impossible conditions on side parts, and impossible formulas in them: each is reported at its place."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest
from sus import ROOT, run

SLOT = 'rectangle="x-" lower="0 -0.125 0" upper="0 0.125 1"'
JET = (ROOT / "ups/ice/jet.ups").read_text()
LINE = 1 + JET[:JET.index(SLOT)].count("\n")
CIRCLE = 'circle="x-" origin="0 0 0.5" radius="0.1"'
SECOND = f'</Face><Face {CIRCLE}><BCType id="0" label="Velocity" var="Dirichlet"><value>[1,0,0]</value></BCType></Face>'

# What stands in place of the slot's attributes, and its sentence.
FACES = {
    "":
        ("missing attribute 'side' of <Face>, or one of the attributes for a part of a side: 'circle', 'annulus', "
         "'ellipse', "
         "'rectangle' and 'rectangulus'"),
    'rectangel="x-" lower="0 0 0" upper="0 1 1"':
        "unknown attribute 'rectangel' of <Face> (did you mean 'rectangle'?)",
    'circle="x" origin="0 0 0" radius="1"':
        "attribute 'circle': found 'x', expected 'x-', 'x+', 'y-', 'y+', 'z-' or 'z+'",
    'circle="x-" origin="0 0 0"':
        "missing attribute 'radius': circle needs origin, radius",
    'circle="x-" origin="0 0 0" radius="-1"':
        "attribute 'radius': found '-1', expected a value greater than 0 m",
    'circle="x-" origin="0 0 0" radius="1" angle="3"':
        "unknown attribute 'angle' of a part with circle; it belongs to ellipse",
    'side="x+" radius="1"':
        "unknown attribute 'radius' of a whole side; it belongs to circle",
    'side="x+" circle="x-"':
        "gives both side and circle; keep one",
    'circle="x-" origin="0 0" radius="1"':
        "attribute 'origin': found '0 0', expected three numbers, such as 0 0.5 0.5",
    'circle="x-" origin="0 a 0" radius="1"':
        "attribute 'origin': found '0 a 0', expected three numbers",
    'circle="x-" origin="0.5 0 0" radius="1"':
        "attribute 'origin': x = 0.5 m is not in side x-, which is at x = 0 m",
    'annulus="x-" origin="0 0 0" inner_radius="2" outer_radius="1"':
        "inner_radius is greater than outer_radius: 2 > 1 m",
    'ellipse="x-" origin="0 0 0" minor_radius="2" major_radius="1" angle="0"':
        "minor_radius is greater than major_radius: 2 > 1 m",
    'rectangle="x-" lower="0 1 0" upper="0 0 1"':
        "upper is below lower along y: 0 < 1 m",
}


class Sides(SceneTest):
    def assert_refused(self, text, *sentences):
        path = self.scene(text)
        result = run(path, outputs=True)
        self.assertEqual(result.code, 3, result.err)
        for sentence in sentences:
            self.assertIn(sentence.replace("SCENE", str(path)), result.err)
        self.assertEqual((result.files, result.out), ([], ""))

    def test_faces_that_cannot_be(self):
        for attributes, sentence in FACES.items():
            with self.subTest(attributes):
                self.assert_refused(JET.replace(SLOT, attributes), f"SCENE:{LINE}:8: Grid/BoundaryConditions/"
                                    f"Face: {sentence}")

    def test_parts_that_overlap(self):
        self.assert_refused(JET.replace("</Face>", SECOND, 1), "overlaps the part at SCENE",
                            "both contain the face at (0, ")

    def test_the_same_part_twice_with_one_condition(self):
        again = SECOND.replace(CIRCLE, SLOT)
        self.assert_refused(JET.replace("</Face>", again, 1), "Velocity already has a condition on this face, at SCENE")

    def test_a_condition_of_all_materials_beside_one_of_a_material(self):
        for first, second in (("0", "all"), ("all", "0")):
            with self.subTest(first):
                face = "".join(f'<BCType id="{number}" label="Velocity" var="Dirichlet"><value>[{u},0,0]</value>'
                               "</BCType>" for number, u in ((first, 1), (second, 2)))
                text = JET.replace('<Face side="z-">', f'<Face side="x+">{face}</Face><Face side="z-">')
                self.assertNotEqual(text, JET)
                self.assert_refused(text, "Velocity already has a condition on this face, at SCENE")

    def test_a_part_of_a_periodic_side(self):
        self.assert_refused(JET.replace("<Level>", "<Level><periodic>[1,0,0]</periodic>"),
                            "x is periodic, so no part of this side can have conditions")

    def test_a_part_between_the_middles_of_faces_is_said_to_do_nothing(self):
        text = JET.replace(SLOT, 'circle="x-" origin="0 0 0.5" radius="0.001"')
        result = run(self.scene(text), "Time/max_Timesteps=1", options=())
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("does nothing: no face of the finest cells on side x- has its centre in this part",
                      result.out + result.err)

    def test_a_component_that_takes_no_parts(self):
        text = (ROOT / "ups/mpm/sod.ups").read_text().replace('<Face side="x-">', f"<Face {CIRCLE}>")
        self.assert_refused(text, "conditions on a part of a side (circle) are not available; use side=\"x-\" to "
                                  "apply them to the whole side")

    def test_a_vector_may_be_the_number_0(self):
        texts = [JET.replace("<value>[1,0,0]<", f"<value>{value}<") for value in ("[0,0,0]", " 0.0 ", "1")]
        vector, number, one = (run(self.scene(text), options=("--check",)) for text in texts)
        self.assertEqual((vector.code, number.code), (0, 0), number.err)
        sentence = "the value 0 is taken as the vector [0,0,0]"
        self.assertEqual([(done.out + done.err).count(sentence) for done in (vector, number)], [0, 1])
        self.assertEqual(one.code, 3)
        self.assertIn("value: found '1', expected three formulas", one.err)

    def test_values_that_are_neither_numbers_nor_formulas(self):
        self.assert_refused(JET.replace("<value>3<", "<value>3+<"), "BCType: value: found '3+', expected a number")
        self.assert_refused(JET.replace("<value>[1,0,0]<", "<value>[1,t<"), "BCType: value: found '[1,t'")

    def test_a_component_that_takes_no_formulas(self):
        text = (ROOT / "ups/heat/sine.ups").read_text().replace("<value>0<", "<value>t<", 1)
        self.assert_refused(text, "BCType: value: found 't', expected a number")

    def test_a_formula_that_becomes_impossible(self):
        result = run(self.scene(JET.replace("<value>3<", "<value>3 - 10*t<")), outputs=True)
        self.assertEqual(result.code, 4, result.err)
        self.assertIn("Temperature at side x- is -", result.err)


if __name__ == "__main__":
    unittest.main()
