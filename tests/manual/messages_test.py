#!/usr/bin/env python3
"""Every message of the C++ sources belongs to a numbered family, and numbers never change."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT)]
from tests.support import sus  # noqa: E402
from tushar.manual.messages import catalogue, family_of, is_fragment, pattern  # noqa: E402
from tushar.manual.templates import templates, templates_in  # noqa: E402

IDS = ROOT / "tests/manual/message_ids.txt"
JOINED = {"T704", "T709"}  # families whose message is put together from several texts
SOD = "ups/mpm/sod.ups"
MISTAKES = (
    ("T101", (SOD, "--set", "Time/maxTimes=1")),
    ("T102", (SOD, "--set", "Grid/Level/Box/@foo=3")),
    ("T105", (SOD, "--set", "Time/maxTime=abc")),
    ("T105", (SOD, "--set", "Grid/Level/Box/lower=3")),
    ("T106", (SOD, "--set", "Time/maxTime=-1")),
    ("T107", (SOD, "--set", "MPM/interpolator=cubic")),
    ("T108", ("ups/solid/two_discs.ups", "--set", "MPM/refine_particles=true")),
    ("T110", (SOD, "--set", "DataArchiver/outputInterval=0.1", "--set", "DataArchiver/outputTimestepInterval=3")),
    ("T111", (SOD, "--set", "Time/delt_min=1", "--set", "Time/delt_max=0.5")),
    ("T114", (SOD, "--set", "DataArchiver/save[1]/@label=p.foo")),
    ("T117", (SOD, "--set", "Time/maxTime")),
    ("T301", ("ups/stability/random.ups",)),
    ("T401", ("nothere.ups",)),
    ("T501", ("-restart", "nothere.uda")),
    ("T701", ("--descrbe", "mpm")),
    ("T705", (SOD, "--load", "nothere.so")),
)


class Messages(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.families = catalogue()[0]
        cls.templates = templates()

    def test_every_message_of_the_sources_has_a_family(self):
        without = [f"{t.path}:{t.line}: {t.text}" for t in self.templates
                   if not is_fragment(t.text) and not family_of(t.text)]
        self.assertEqual(without, [], "give it a family in tools/manual_pages/messages, or name it a fragment there")

    def test_the_sources_are_searched(self):
        texts = {template.text for template in self.templates}
        self.assertGreater(len(texts), 300)
        for text in ("unknown tag <{}> in <{}>{}{}", "the time step became {} s (step {}, time {} s)",
                     "another run is writing to '{}'; wait until it ends, or stop it"):
            self.assertIn(text, texts)

    def test_the_numbers_stay(self):
        kept = dict(line.split(" ", 1) for line in IDS.read_text().splitlines() if not line.startswith("#"))
        self.assertEqual({family.id: family.title for family in self.families}, kept,
                         "a number must not vanish or change its meaning; add new ones to tests/manual/message_ids.txt")

    def test_a_number_is_given_once_and_has_cause_and_remedy(self):
        numbers = [family.id for family in self.families]
        self.assertEqual(sorted(set(numbers)), numbers)
        for family in self.families:
            self.assertRegex(family.id, r"^T[1-9]\d\d$")
            self.assertTrue(family.title and family.cause.endswith(".") and family.remedy, family.id)

    def test_every_family_has_a_message_in_the_sources(self):
        texts = [template.text for template in self.templates]
        empty = [family.id for family in self.families if family.id not in JOINED
                 and not any(pattern(words).search(text) for words in family.words for text in texts)]
        self.assertEqual(empty, [])

    def test_what_sus_says_of_mistakes_is_found(self):
        for number, words in MISTAKES:
            with self.subTest(number=number, words=words), tempfile.TemporaryDirectory() as folder:
                scene = words[0] if words[0].endswith(".ups") else ""
                command = [sus.SUS, *([str(ROOT / scene)] if scene else []), *words[bool(scene):], "--quiet"]
                done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                first = done.stderr.splitlines()[0]
                self.assertIsNotNone(family_of(first), first)
                self.assertEqual(family_of(first).id, number, first)
                self.assertTrue(first.endswith(f" [{number}]"), first)


class Search(unittest.TestCase):
    """Tests of the search through a source file."""

    def found(self, source):
        return [template.text for template in templates_in(source, "x.cpp")]

    def test_calls_throws_and_returns(self):
        source = 'diagnostics.error(e, fmt::format("a {:g} of the {}"\n  " kind", x, y));'
        self.assertEqual(self.found(source), ["a {} of the {} kind"])
        self.assertEqual(self.found('throw FileError("no more room left");'), ["no more room left"])
        self.assertEqual(self.found('return ok ? "" : "something is wrong here";'), ["something is wrong here"])

    def test_joined_texts_have_a_gap(self):
        self.assertEqual(self.found('throw FileError("cannot write it: " + why + " is the reason");'),
                         ["cannot write it: {} is the reason"])

    def test_comments_and_short_texts_are_left_out(self):
        self.assertEqual(self.found('// throw X("a b c d")\nthrow X("two words");\n'), [])

    def test_lines_are_counted(self):
        self.assertEqual([t.line for t in templates_in('\n\nthrow X("one two three");', "x.cpp")], [3])


if __name__ == "__main__":
    unittest.main()
