#!/usr/bin/env python3
"""The commands of the tutorials run and print what the tutorials show.

A block `sh` is run, `sh exits 3` ends with that code, `sh not run: why` is left out. A block `text` after it has lines
of what it prints, in their order: … stands for anything, ⟨same⟩ (or another name) for something that is the same each
time.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = str(pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve())
PAGES = ROOT / "tools/manual_pages"
BLOCK = re.compile(r"^```(\w+)(?: ([^\n]*))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# tools/run builds; here it is the program that is there.
PRELUDE = """set -euo pipefail
tools/run() {
  if [ "$1" = -np ]; then local ranks=$2; shift 2; mpirun --oversubscribe -n "$ranks" "$SUS" "$@"; else "$SUS" "$@"; fi
}
"""


def blocks(page):
    """Returns [(language, note, text)] for the code blocks of a page."""
    return [(language, note or "", text) for language, note, text in BLOCK.findall(page.read_text())]


def line_pattern(line):
    """Returns a regular expression for a line of a `text` block, with anything after it on the same line."""
    def meaning(part):
        if part.startswith("⟨"):
            return rf"(?P<{part[1:-1]}>\S+)"
        return ".*" if part == "…" else r"\s+".join(map(re.escape, part.split(" ")))
    return re.compile("".join(map(meaning, re.split(r"(…|⟨\w+⟩)", line.strip()))))


def what_is_missing(expected, printed):
    """Returns the first line of `expected` that is not in `printed` after its predecessors; None if all are."""
    lines, at, same = printed.splitlines(), 0, {}
    for line in filter(str.strip, expected.splitlines()):
        pattern = line_pattern(line)
        while True:
            if at == len(lines):
                return line
            found = pattern.search(lines[at])
            at += 1
            for name, value in (found.groupdict() if found else {}).items():
                if same.setdefault(name, value) != value:
                    return f"{line} as before, {same[name]}, but {value}"
            if found:
                break
    return None


class Tutorials(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("components", "core", "tests", "tools", "ups"):
            os.symlink(ROOT / name, pathlib.Path(self.folder.name, name))
        programs = pathlib.Path(self.folder.name, ".bin")
        programs.mkdir()
        os.symlink(sys.executable, programs / "python3")

    def run_block(self, text):
        environment = {**os.environ, "SUS": SUS, "MPLBACKEND": "Agg",
                       "PATH": f"{self.folder.name}/.bin:{os.environ['PATH']}",
                       "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                       "OMPI_MCA_mpi_yield_when_idle": "1"}
        return subprocess.run(["bash", "-c", PRELUDE + text], cwd=self.folder.name, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)

    def check(self, name):
        printed = None
        for language, note, text in blocks(PAGES / f"{name}.md"):
            if language == "sh" and not note.startswith("not run:"):
                done = self.run_block(text)
                printed = done.stdout
                wanted = int(note.removeprefix("exits ")) if note else 0
                self.assertEqual(done.returncode, wanted, f"{text}\n{printed}")
            elif language == "text" and printed is not None:
                self.assertIsNone(what_is_missing(text, printed), printed)

    def test_first_run(self):
        self.check("first_run")

    def test_own_material(self):
        self.check("own_material")

    def test_component(self):
        self.check("component")

    def test_restart_and_ranks(self):
        self.check("restart_and_ranks")

    def test_refined_grids(self):
        self.check("refined_grids")

    def test_from_uintah(self):
        self.check("from_uintah")

    def test_there_is_a_test_for_each_tutorial(self):
        tested = {name.removeprefix("test_") for name in dir(self) if name.startswith("test_")}
        self.assertEqual({page.stem for page in PAGES.glob("*.md")} - tested, set())

    def test_what_is_not_run_has_a_reason(self):
        wrong = [f"{page.name}: {note}" for page in PAGES.glob("*.md") for language, note, _ in blocks(page)
                 if language == "sh" and not re.fullmatch(r"|exits \d|not run: .{10,}", note)]
        self.assertEqual(wrong, [])


class Check(unittest.TestCase):
    """Tests that the comparison itself finds differences."""

    def test_lines_are_found_in_their_order_only(self):
        self.assertIsNone(what_is_missing("a …\nb", "x\na 1 2\n  b  c\n"))
        self.assertEqual(what_is_missing("b\na …", "a 1\nb\n"), "a …")

    def test_what_must_be_the_same_is_compared(self):
        self.assertIsNone(what_is_missing("f ⟨same⟩\nf ⟨same⟩", "f 1\nf 1\n"))
        self.assertIn("but 2", what_is_missing("f ⟨same⟩\nf ⟨same⟩", "f 1\nf 2\n"))
        self.assertIsNone(what_is_missing("f ⟨same⟩\nf ⟨other⟩\nf ⟨same⟩", "f 1\nf 2\nf 1\n"))
        self.assertIn("but 3", what_is_missing("f ⟨same⟩\nf ⟨other⟩\nf ⟨other⟩", "f 1\nf 2\nf 3\n"))


if __name__ == "__main__":
    unittest.main()
