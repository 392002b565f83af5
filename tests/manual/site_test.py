#!/usr/bin/env python3
"""The manual is complete: every tag and every scene has its page, and no link is dead."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT)]
from tests.support import sus  # noqa: E402
from tushar.manual import api, tags  # noqa: E402
from tushar.manual.links import dead_links  # noqa: E402
from tushar.manual.pictures import Album, bound_of, broken_bounds  # noqa: E402

TITLE = re.compile(r'^ *((?:<[^>]+>(?:, )?)+|[\w.-]+=(?:"[^"]*")?|\(text\))(?= —|:)')
HEADER = """
/// A box.
class Box {
 public:
  /// Its size, m.
  double size() const { return 1; }

 private:
  /// Hidden.
  int x_;
};
/// Twice.
template <class T>
T twice(T x);
"""


def setUpModule():
    global FOLDER, SITE
    try:
        from tushar.manual.site import Site
    except ImportError as error:
        raise unittest.SkipTest(f"{error}: tools/test installs python3-markdown-it") from None
    FOLDER = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(FOLDER.cleanup)
    SITE = Site(sus.SUS, Album(sus.SUS, False, f"{FOLDER.name}/cache"))
    SITE.write(f"{FOLDER.name}/site")


def described():
    """(name, line) of all that --describe prints, collected without the manual's own parser."""
    listed = printed("--list").partition("shapes")[0]
    for name in ["scene", *re.findall(r"^  (\w+)", listed, re.MULTILINE)]:
        yield from ((name, line) for line in printed("--describe", name).splitlines()
                    if not re.match(r"(Where|For) .*, instead:$", line))


def printed(*words):
    return subprocess.run([sus.SUS, *words], capture_output=True, text=True, check=True).stdout


class Pages(unittest.TestCase):
    def test_every_tag_of_every_component_and_module_has_a_place(self):
        items = {}
        for page in SITE.reference.pages:
            for tag in (page.tag, *(item.tag for item in page.items)):
                items.setdefault(tag.title(), set()).update((tag.sentence, tag.role or tag.sentence))
        missing, count = [], 0
        for name, line in described():
            titles = TITLE.match(line)
            self.assertIsNotNone(titles, line)
            for title in re.findall(r"<[^>]+>", titles[1]) or [titles[1]]:
                count += 1
                sentences = items.get(title, set())
                if not any(said in line for said in sentences - {""}) and (": " in line or "" not in sentences):
                    missing.append(f"{name}: {line.strip()}")
        self.assertEqual(missing, [])
        self.assertGreater(count, 1000)

    def test_every_tag_that_a_scene_uses_is_described(self):
        self.assertEqual(SITE.undescribed, [])

    def test_no_link_is_dead_and_no_anchor_is_there_twice(self):
        self.assertEqual(dead_links(f"{FOLDER.name}/site"), [])

    def test_every_scene_has_a_page_with_what_it_expects(self):
        for scene in SITE.scenes:
            self.assertEqual(set(scene.head), {"What", "Source", "Expect", "Takes"}, scene.path)
            self.assertIn(scene.command, SITE.files[scene.url])
        self.assertEqual(len(SITE.scenes), len(list((ROOT / "ups").rglob("*.ups"))))

    def test_a_tag_names_the_scenes_that_use_it(self):
        page = SITE.reference.root(next(s for s in SITE.sections if s.name == "mpm" and not s.variant), "MPM")
        self.assertIn("ups/solid/two_discs.ups", page.item("tag", "interpolator").scenes)
        self.assertNotIn("ups/mpm/sod.ups", page.item("tag", "interpolator").scenes)

    def test_tags_of_a_scene_lead_to_their_descriptions(self):
        discs = SITE.files["gallery/solid-two_discs.html"]
        self.assertRegex(discs, r'&lt;<a href="\.\./reference/shared-MPM\.html#interpolator"[^>]*>interpolator</a>&gt;')
        self.assertRegex(discs, r'<a href="\.\./reference/constitutive_model-comp_mooney_rivlin\.html"')

    def test_pages_need_no_network(self):
        for url, text in SITE.files.items():
            self.assertNotRegex(text, r'<(?:script|img|link)[^>]*(?:src|href)="(?:https?:)?//', url)

    def test_the_manual_writes_over_its_own_folder_only(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "mine.txt").write_text("keep")
            with self.assertRaises(FileExistsError):
                SITE.write(folder)
            self.assertTrue(pathlib.Path(folder, "mine.txt").exists())


class Links(unittest.TestCase):
    def test_what_is_dead_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder, "a.html")
            page.write_text('<p id="x"><p id="x"><a href="b.html"><a href="#y"><a href="#x"><a href="https://a.org">')
            dead = [target for _, target in dead_links(folder)]
            self.assertEqual(dead, ["#x, which is there twice", "b.html", "#y"])


class Tags(unittest.TestCase):
    """Tests of the parser for the text of --describe."""

    def test_a_value(self):
        tag = tags.parse_line("<r> — number in m, greater than 0 and at most 1, default 0.5: radius [Tushar's own]")
        self.assertEqual((tag.title(), tag.type, tag.unit), ("<r>", "number", "m"))
        self.assertEqual(tag.limits, "greater than 0 and at most 1")
        self.assertEqual((tag.presence, tag.default, tag.sentence, tag.ours), ("default", "0.5", "radius", True))

    def test_a_choice_a_vector_and_a_formula(self):
        self.assertEqual(tags.parse_line("<axis> — 'x', 'y' or 'z', default z: what").choices, ["x", "y", "z"])
        self.assertEqual(tags.parse_line("<lower> — numbers [a,b,c] in m, default [0,0,0]: c").default, "[0,0,0]")
        self.assertEqual(tags.parse_line("<T> — formula in x, y, z, t in K, without t, required: T").unit, "K")

    def test_words_of_uintah(self):
        self.assertEqual(tags.parse_line("<a> — ignored: nothing").status, "ignored")
        self.assertEqual(tags.parse_line("<a>: only false: b does it").status, "limited")
        self.assertEqual(tags.parse_line("<a>: not available: take b").status, "absent")

    def test_an_unknown_form_is_an_error(self):
        self.assertRaises(ValueError, tags.parse_line, "something else")
        self.assertRaises(ValueError, tags.parse_line, "<a> — miles per hour, required: speed")


class Interface(unittest.TestCase):
    def test_comments_come_with_their_declarations(self):
        symbols = api.symbols_of(HEADER)
        self.assertEqual([(s.full_name, s.declaration, s.comment) for s in symbols],
                         [("Box", "class Box", "A box."), ("Box::size", "double size() const", "Its size, m."),
                          ("twice", "template <class T> T twice(T x);", "Twice.")])

    def test_what_the_author_of_a_component_needs_is_there(self):
        names = {symbol.full_name for files in SITE.headers.values() for found in files.values() for symbol in found}
        for name in ("TaskList::perPatch", "requiresOld", "computes", "ParticleView", "Schema::value"):
            self.assertIn(name, names)


class Pictures(unittest.TestCase):
    def test_a_scene_is_run_once_and_drawn(self):
        scene = next(scene for scene in SITE.scenes if scene.path == "ups/heat/sine.ups")
        with tempfile.TemporaryDirectory() as cache:
            picture = Album(sus.SUS, True, cache).picture(scene)
            self.assertGreater(picture.stat().st_size, 5000)
            self.assertEqual(Album(sus.SUS, False, cache).picture(scene), picture)
            self.assertEqual(Album(sus.SUS, False, cache).report(scene)["ended"], "maxTime")

    def test_a_value_beyond_its_bound_is_told(self):
        scene = next(scene for scene in SITE.scenes if scene.path == "ups/stability/sod.ups")

        class Fake:
            def report(self, _):
                return {"errors": {"density": {"cell": {"relative": 1.0}}}}

        self.assertEqual(bound_of(scene)[0], "errors.density.cell.relative")
        self.assertEqual(len(list(broken_bounds([scene], Fake()))), 1)


if __name__ == "__main__":
    unittest.main()
