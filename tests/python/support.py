"""What tests of the Python package share: it is found, with the libraries that it needs, and so is sus."""
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
    """Why a test is skipped, a sentence; None where this Python has the modules."""
    gone = [name for name in modules if importlib.util.find_spec(name) is None]
    return f"this Python has no {' and no '.join(gone)}" if gone else None
