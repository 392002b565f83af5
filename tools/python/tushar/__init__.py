"""Tushar from Python: opens archives, runs scenes, and sweeps over parameters.

    import tushar
    archive = tushar.open("sod.uda")
    density = archive[-1]["p.density"]                    # an array with .unit, read when its values are used
    run = tushar.run("ups/mpm/sod.ups", {"Time/maxTime": 0.1})
    table = tushar.sweep("ups/mpm/sod.ups", {"MPM/gas_dynamics/cfl": [0.1, 0.2]}, jobs=2).to_pandas()
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, List

__version__ = "0.1.0"
# The names of each module, loaded when one is first used, so that `tushar.interpreter` needs no numpy.
_NAMES = {
    "archive": ["Archive", "Variable", "Series", "Globals"], "snapshot": ["Snapshot", "Particles"], "arrays": ["Array"],
    "refined": ["Refined", "Box"],
    "grid": ["Grid"], "tracks": ["Tracks"], "program": ["find_sus"], "runs": ["run", "Run"],
    "sweeps": ["sweep", "Sweep", "Point"],
    "errors": ["TusharError", "ArchiveError", "MissingLibrary", "SusError", "CommandError", "InputError",
               "NumericalError", "Interrupted"],
}
_HOME = {name: module for module, names in _NAMES.items() for name in names}
__all__ = ["open", "Archive", "Variable", "Series", "Globals", "Snapshot", "Particles", "Array", "Refined",
           "Box", "Grid", "Tracks",
           "find_sus", "run", "Run", "sweep", "Sweep", "Point", "TusharError", "ArchiveError", "MissingLibrary",
           "SusError", "CommandError", "InputError", "NumericalError", "Interrupted"]

if TYPE_CHECKING:
    from tushar.archive import Archive, Globals, Series, Variable
    from tushar.archive import open_archive as open
    from tushar.arrays import Array
    from tushar.errors import (ArchiveError, CommandError, InputError, Interrupted, MissingLibrary, NumericalError,
                               SusError, TusharError)
    from tushar.grid import Grid
    from tushar.program import find_sus
    from tushar.refined import Box, Refined
    from tushar.runs import Run, run
    from tushar.snapshot import Particles, Snapshot
    from tushar.sweeps import Point, Sweep, sweep
    from tushar.tracks import Tracks


def __getattr__(name: str) -> Any:
    if name == "open":
        return importlib.import_module("tushar.archive").open_archive
    if name not in _HOME:
        raise AttributeError(f"module 'tushar' has no '{name}'; it has {', '.join(__all__)}")
    return getattr(importlib.import_module(f"tushar.{_HOME[name]}"), name)


def __dir__() -> List[str]:
    return sorted([*globals(), *__all__])
