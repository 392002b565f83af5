"""Common set-up of the tests of the Python package: finds the package, its libraries and sus."""
import importlib.util
import os
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "tools/python"
sys.path[:0] = [str(LIBRARY), str(ROOT / "tests/tools")]
os.environ.setdefault("SUS", str(ROOT / "build/dev/sus"))
os.environ["SUS"] = str(pathlib.Path(os.environ["SUS"]).resolve())
SOD, TUBE = "ups/mpm/sod.ups", {"Grid/Level/Box/resolution": [40, 1, 1]}

from tushar.interpreter import ensure


def missing(*modules):
    """Returns the reason to skip a test if modules are missing; otherwise None."""
    gone = [name for name in modules if importlib.util.find_spec(name) is None]
    return f"this Python has no {' and no '.join(gone)}" if gone else None
