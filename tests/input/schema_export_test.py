#!/usr/bin/env python3
"""The schemas of `sus --schema` accept every scene of ups/ and reject scenes with a wrong structure."""
import pathlib
import re
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent / "support")]
import broken_scenes_test
import editors
import solid_mistakes_test
from sus import ROOT

RNG = "{http://relaxng.org/ns/structure/1.0}"
SCENES = sorted(str(file) for file in (ROOT / "ups").rglob("*.ups"))
# What sus says where the structure is wrong: of tags and attributes that are unknown, missing or given twice, of words
# that are no choice, and of texts where a value of another type belongs. All else follows from several values together.
STRUCTURE = re.compile(r"unknown (tag|section|attribute)|missing tag <\w+> in <|missing attribute|"
                       r"the section <\w+> is missing|"
                       r"is given twice|text '.*' in <|expected '|expected (a number|an integer|true or false|three )|"
                       r"found 'inf'|is not available(?! with)|expected \d+(, \d+)*: (?!loads)|wrong root|"
                       r"unknown shape|unclosed tag|empty file")


def broken_scenes():
    """Returns name -> text of each scene of the tests that has a wrong structure."""
    sod = broken_scenes_test.SOD
    scenes = {name: editors.overridden(sod, change)
              for name, (change, sentence) in broken_scenes_test.OVERRIDES.items() if STRUCTURE.search(sentence)}
    scenes |= {name: text for name, (text, _, sentence) in broken_scenes_test.TEXTS.items()
               if STRUCTURE.search(sentence) or STRUCTURE.search(name)}
    for name, (scene, (before, after), sentence, *sets) in solid_mistakes_test.REFUSED.items():
        if STRUCTURE.search(sentence):
            scenes[name] = editors.overridden((ROOT / scene).read_text().replace(before, after), *sets)
    return scenes


@unittest.skipUnless(editors.XMLLINT, "xmllint is missing (Debian: libxml2-utils)")
class SchemaExport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rng, cls.xsd = editors.schema("rng"), editors.schema("xsd")

    def invalid(self, texts, language="rng"):
        """Returns the names of the scenes that are not valid."""
        with tempfile.TemporaryDirectory() as folder:
            files = {}
            for number, (name, text) in enumerate(texts.items()):
                path = pathlib.Path(folder, f"{number}.ups")
                path.write_text(text)
                files[str(path)] = name
            return {files[file] for file in editors.invalid(getattr(self, language), language, list(files))}

    def test_every_scene_is_valid(self):
        self.assertGreater(len(SCENES), 80)
        self.assertEqual(editors.invalid(self.rng, "rng", SCENES), [])
        self.assertEqual(editors.invalid(self.xsd, "xsd", SCENES), [])

    def test_scenes_that_are_wrong_in_structure_are_not(self):
        broken = broken_scenes()
        self.assertGreater(len(broken), 35)
        missed = set(broken) - self.invalid(broken)
        self.assertLessEqual(len(missed), 0.05 * len(broken), missed)

    def test_what_sus_accepts_is_valid(self):
        sod = broken_scenes_test.SOD
        accepted = {
            "capitals of Uintah": sod.replace('type="mpm"', 'type="MPM"'),
            "numbers as they come": editors.overridden(sod, "Time/maxTime= +.2e0 ",
                                                       "Grid/Level/Box/resolution=[ 100.0, 1,1 ]"),
            "a formula": editors.overridden(sod, "MaterialProperties/MPM/material/geom_object[1]/density=1 + 0*x"),
            "flags": editors.overridden(sod, "DataArchiver/outputInitTimestep= true "),
            "idle sections": sod.replace("<Time>",
                                         '<LoadBalancer type="x"><y z="1">w</y></LoadBalancer><Debug/><Time>'),
            "tags in another order": re.sub(r"(<maxTime>.*</maxTime>)\s*(<end_at.*</end_at_max_time_exactly>)",
                                            r"\2\1", sod),
            "an included section": sod[:sod.index("  <Grid>")] + '<include href="grid.xml" section="Grid"/>'
                                   + sod[sod.index("  </Grid>") + 10:],
            "included tags": sod.replace("<maxTime>0.2</maxTime>",
                                         '<include href="t.xml" section="Time" excludeSectionTag="true"/>'),
            "compression": editors.overridden(sod, "DataArchiver/compression=gzip -9"),
            "name spaces of editors": sod.replace(
                "<Uintah_specification>", '<Uintah_specification xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
                'xsi:noNamespaceSchemaLocation="tushar.xsd">'),
        }
        for name, text in accepted.items():
            self.assertNotEqual(text, sod, name)
        self.assertEqual(self.invalid(accepted), set())
        self.assertEqual(self.invalid(accepted, "xsd"), set())

    def test_tags_depend_on_the_component_and_on_types(self):
        heat, sod = (ROOT / "ups/heat/sine.ups").read_text(), broken_scenes_test.SOD
        discs = (ROOT / "ups/solid/two_discs.ups").read_text()
        wrong = {
            "the section of another component": heat.replace('type="heat"', 'type="poisson"'),
            "the boundary label of another component": sod.replace('label="Symmetric"', 'label="Phi"'),
            "a tag of another module": sod.replace("</Module>", "<energy>1</energy></Module>", 1),
            "a switch of Uintah's that is not available": editors.overridden(discs, "MPM/AMR=true"),
        }
        self.assertEqual(self.invalid(wrong), set(wrong))
        self.assertEqual(self.invalid({"off": editors.overridden(discs, "MPM/AMR=0.0")}), set())

    def test_no_tag_stands_twice_in_an_interleave(self):
        grammar = ElementTree.fromstring(self.rng.encode())
        tags = {define.get("name"): define.find(RNG + "element").get("name")
                for define in grammar.findall(RNG + "define") if define.find(RNG + "element") is not None}
        for interleave in grammar.iter(RNG + "interleave"):
            branches = [{tags[ref.get("name")] for ref in branch.iter(RNG + "ref")} for branch in interleave]
            together = [tag for branch in branches for tag in branch]
            self.assertEqual(len(together), len(set(together)), sorted(together))

    def test_the_schema_beside_the_scenes_is_that_of_sus(self):
        file = ROOT / "ups/tushar.rng"
        self.assertTrue(file.exists() and file.read_text() == self.rng,
                        "ups/tushar.rng is not that of sus; write it anew: sus --schema rng > ups/tushar.rng")

    def test_scenes_name_the_schema(self):
        for scene in SCENES:
            found = re.search(r'<\?xml-model href="([^"]+)"', pathlib.Path(scene).read_text())
            self.assertTrue(found, scene)
            self.assertEqual((pathlib.Path(scene).parent / found[1]).resolve(), ROOT / "ups/tushar.rng")


if __name__ == "__main__":
    unittest.main()
