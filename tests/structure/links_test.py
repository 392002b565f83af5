#!/usr/bin/env python3
"""Links of Markdown pages lead to existing files and headings; paths and scenes named in them exist."""
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CODE_BLOCK = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.+?) *$", re.MULTILINE)
# core/tasks/task.hpp, but neither build/dev/tests/unit_tests nor ups/$s/vortex.ups.
PATH = re.compile(r"(?<![\w./$-])(?:core|components|ups|tests|tools)/[\w./-]*\w(?![\w*{$])")
# A file below the folder of the page that names it.
NEARBY = re.compile(r"`([\w.-]+(?:/[\w.-]+)+\.(?:hpp|cpp|py|ups))`")
# Parts of a path that stand for another name, or for what a command on the page makes.
EXAMPLES = {"NAME", "SCENE.ups", "wave", "wave.ups"}


def pages():
    """Returns every page of the project with its text."""
    listed = subprocess.run(["git", "ls-files", "-z", "*.md"], cwd=ROOT, capture_output=True, text=True)
    if listed.returncode == 0:
        files = [ROOT / name for name in listed.stdout.split("\0") if name]
    else:
        files = [file for file in ROOT.rglob("*.md") if "build" not in file.relative_to(ROOT).parts]
    return [(file, file.read_text()) for file in files if file.is_file()]


def anchors(text):
    """Returns the anchors of a page's headings as GitHub generates them: `Two commands` -> two-commands."""
    headings = HEADING.findall(CODE_BLOCK.sub("", text))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(file, text):
    """Returns the links of a page whose file or heading does not exist."""
    for target in LINK.findall(CODE.sub("code", CODE_BLOCK.sub("", text))):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        linked = (file.parent / path).resolve() if path else file
        if not linked.exists() or ROOT not in (linked, *linked.parents):
            yield target
        elif anchor and anchor not in anchors(linked.read_text()):
            yield target


def stale_paths(file, text):
    """Returns paths on a page that exist neither below the project's root nor below the page's folder."""
    for path in PATH.findall(text):
        if not EXAMPLES & set(path.split("/")) and not (ROOT / path).exists():
            yield path
    for path in NEARBY.findall(text):
        if not EXAMPLES & set(path.split("/")) and not (ROOT / path).exists() and not (file.parent / path).exists():
            yield path


class Pages(unittest.TestCase):
    def find(self, problems):
        return [f"{file.relative_to(ROOT)}: {problem}" for file, text in pages() for problem in problems(file, text)]

    def test_every_relative_link_has_its_file_and_heading(self):
        self.assertEqual(self.find(broken_links), [])

    def test_every_path_that_a_page_names_exists(self):
        self.assertEqual(sorted(set(self.find(stale_paths))), [])

    def test_the_first_page_has_at_most_900_words(self):
        self.assertLessEqual(len((ROOT / "README.md").read_text().split()), 900)


class Check(unittest.TestCase):
    """Tests of the check itself."""
    HERE = ROOT / "README.md"

    def test_a_link_to_a_missing_file_or_heading_is_found(self):
        text = "[a](core/none.md) [b](README.md#no-such-heading) [c](#here) [d](https://example.org)\n# Not here\n"
        self.assertEqual(list(broken_links(self.HERE, text)), ["core/none.md", "README.md#no-such-heading", "#here"])

    def test_links_in_code_are_not_links(self):
        self.assertEqual(list(broken_links(self.HERE, "`a[i](j)`\n```\nb[i](j)\n```\n")), [])

    def test_a_path_that_does_not_exist_is_found(self):
        text = "core/none.hpp, `ups/mpm/sod.ups`, `tasks/none.cpp`, `components/wave`, build/dev/tests/unit_tests"
        self.assertEqual(list(stale_paths(self.HERE, text)), ["core/none.hpp", "tasks/none.cpp"])

    def test_headings_become_anchors_as_on_github(self):
        self.assertEqual(anchors("# Two commands\n## `sus`: options, 1-D\n"), {"two-commands", "sus-options-1-d"})


if __name__ == "__main__":
    unittest.main()
