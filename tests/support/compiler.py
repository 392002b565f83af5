"""Asks the compiler whether a piece of C++ compiles."""
import os
import pathlib
import shutil
import subprocess
import tempfile

from sus import ROOT


def include_paths():
    """Returns the include paths of Eigen's headers."""
    found = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True)
    words = found.stdout.split() if found.returncode == 0 else ["-I/usr/include/eigen3"]
    return [word.replace("-I", "-isystem") for word in words]


def complaints(code, headers=None):
    """What the compiler says of a source file with this text; empty where it compiles. `headers`, texts by path, stand
    before those of the project."""
    compiler = os.environ.get("CXX") or shutil.which("c++") or "g++"
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "piece.cpp")
        for path, text in {source: code, **(headers or {})}.items():
            file = pathlib.Path(folder) / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wshadow", "-Wno-psabi",
                               "-Werror", f"-I{folder}", f"-I{ROOT}", *include_paths(), str(source)],
                              capture_output=True, text=True)
    if done.returncode == 0:
        return ""
    return done.stderr or f"{compiler} failed"
