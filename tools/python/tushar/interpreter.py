"""Finds a Python that has the libraries that a tool needs: a machine often has several Pythons."""
from __future__ import annotations

import importlib
import os
import shutil
import subprocess
import sys
from typing import Optional, Sequence

_TRIED = "TUSHAR_PYTHON_TRIED"


def ensure(*modules: str) -> None:
    """Returns if this Python can import the modules; otherwise restarts the program with one that can, or ends it with
    a message on what to install. Call it before those imports."""
    missing = [module for module in modules if not _can_import(module)]
    already_tried = os.environ.pop(_TRIED, None)
    if not missing:
        return
    other = None if already_tried else python_with(modules)
    if other:
        sys.stdout.flush()
        os.environ[_TRIED] = "1"
        os.execv(other, [other, *getattr(sys, "orig_argv", [None, *sys.argv])[1:]])
    sys.exit(_advice(missing, modules))


def _can_import(module: str) -> bool:
    try:
        importlib.import_module(module)
        return True
    except ImportError:
        return False


def python_with(modules: Sequence[str]) -> Optional[str]:
    """The first python3 on the path, or the system's one, that has the modules."""
    folders = os.environ.get("PATH", "").split(os.pathsep)
    found = [shutil.which("python3", path=folder) for folder in folders if folder] + ["/usr/bin/python3"]
    for python in dict.fromkeys(path for path in found if path and os.path.exists(path)):
        if _has(python, modules):
            return python
    return None


def _has(python: str, modules: Sequence[str]) -> bool:
    command = [python, "-c", "import " + ", ".join(modules)]
    try:
        return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def _advice(missing: Sequence[str], modules: Sequence[str]) -> str:
    packages = " ".join("python3-" + module for module in modules)
    noun = "library" if len(missing) == 1 else "libraries"
    return (f"This tool needs the Python {noun} {' and '.join(missing)}, which no Python on this machine has: install "
            f"{packages} (Debian, Ubuntu) or run 'python3 -m pip install {' '.join(modules)}'.")
