"""What tests of the Python package share: it is found, with the libraries that it needs, and so is sus."""
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
    """Why a test is skipped, a sentence; None where this Python, or another that then takes over, has the modules."""
    try:
        ensure(*modules)
    except SystemExit:
        return f"no Python here has {', '.join(modules)}"
    return None
