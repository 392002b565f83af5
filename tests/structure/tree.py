"""The project's own files, for the tests of its structure."""
import json
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = ("core", "components", "tools", "tests")
INCLUDE = re.compile(r'^\s*#include\s+"([^"]+)"', re.MULTILINE)
# A comment, a string or a character.
QUIET = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.DOTALL)


def files(*suffixes, folders=FOLDERS):
    """Returns the sorted paths below ROOT of files with these endings."""
    return sorted(file.relative_to(ROOT).as_posix() for folder in folders for file in (ROOT / folder).rglob("*")
                  if file.suffix in suffixes)


def cpp_files(folders=FOLDERS):
    return files(".hpp", ".cpp", folders=folders)


def python_files():
    """Returns the Python modules, and the commands of tools that are in Python."""
    commands = [path for path in files("", folders=("tools",)) if (ROOT / path).is_file()
                and (ROOT / path).read_bytes()[:40].startswith(b"#!/usr/bin/env python3")]
    return sorted(files(".py") + commands)


def build_files():
    """Returns the files that CMake reads, including included parts."""
    lists = [path for path in files(".txt") if path.endswith("CMakeLists.txt")]
    return sorted(["CMakeLists.txt", *lists, *files(".cmake", ".sh")])


def read(path):
    return (ROOT / path).read_text()


def comments(text):
    """Returns (line, comment) for each comment of a C++ text."""
    return [(text.count("\n", 0, found.start()) + 1, found[0]) for found in QUIET.finditer(text)
            if found[0].startswith("/")]


def without_comments(text):
    return QUIET.sub(lambda found: " " if found[0].startswith("/") else found[0], text)


def code_alone(text):
    """Returns C++ text with comments and string contents blanked; line numbers are kept."""
    return QUIET.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def includes(path):
    """Returns the project's own files that a file includes."""
    return [name for name in INCLUDE.findall(read(path)) if (ROOT / name).is_file()]


def folder_of(path):
    return path.rpartition("/")[0]


def has_ctags():
    """Whether the installed ctags is Universal Ctags with JSON output."""
    if not shutil.which("ctags"):
        return False
    said = subprocess.run(["ctags", "--list-features"], capture_output=True, text=True)
    return "json" in said.stdout


def functions(kinds, folders=("core", "components", "tools")):
    """Returns a dictionary for each function that Universal Ctags finds; `kinds`: "f" definitions, "p" declarations."""
    options = ["--languages=C++", f"--kinds-C++={kinds}", "--fields=+neS", "--output-format=json"]
    listed = subprocess.run(["ctags", *options, "-L", "-", "-f", "-"], cwd=ROOT, capture_output=True, text=True,
                            check=True, input="\n".join(cpp_files(folders)))
    return [json.loads(line) for line in listed.stdout.splitlines()]
