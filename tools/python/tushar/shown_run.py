"""Runs a scene that was given to a tool instead of an archive, and shows the report; the tool then draws the
archive."""
from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from typing import Any, Dict, List, Optional, Sequence

from tushar.errors import SusError
from tushar.program import ROOT, find_sus
from tushar.runs import read_report

OUTPUTS = 100  # of a film, about
BY_TIME, BY_STEPS = "DataArchiver/outputInterval", "DataArchiver/outputTimestepInterval"


def is_scene(path: str) -> bool:
    """Whether a command-line argument names a scene instead of an archive."""
    return path.endswith(".ups")


def film_interval(scene: str, sets: Sequence[str]) -> Optional[float]:
    """The time between outputs [s] that gives enough of them for a film; None if the scene has enough outputs or
    counts steps, if `sets` (PATH=VALUE) overrides the time, or if the times of the scene cannot be
    read."""
    overrides = dict(item.partition("=")[::2] for item in sets)
    try:
        root: Any = ElementTree.parse(scene).getroot()
        found = {path: float(overrides.get(path) or root.findtext(path) or 0)
                 for path in ("Time/maxTime", "Time/initTime", BY_TIME, BY_STEPS)}
    except (OSError, ElementTree.ParseError, ValueError):  # sus says what is wrong with it
        return None
    if BY_TIME in overrides or found[BY_STEPS]:
        return None
    needed = (found["Time/maxTime"] - found["Time/initTime"]) / OUTPUTS
    return needed if needed > 0 and not 0 < found[BY_TIME] <= needed else None


def run_shown(scene: str, sets: Sequence[str]) -> str:
    """Runs a scene with tools/run, or with the program in $SUS; returns the folder of its archive. The output of sus
    goes to standard error. SusError, with the exit code of sus, for a run that failed; sus has printed why."""
    program = [find_sus()] if os.environ.get("SUS") else ["bash", str(ROOT / "tools/run")]
    overrides = [word for item in sets for word in ("--set", item)]
    with tempfile.TemporaryDirectory() as folder:
        words = [*program, scene, "--json", str(pathlib.Path(folder, "report.json")), *overrides]
        code = _wait(subprocess.Popen(words, stdout=sys.stderr))
        report: Dict[str, Any] = read_report(folder) or {}
    archive = str(report.get("archive", ""))
    if code:
        kept = f"; its outputs are in {archive}" if archive else ""
        code = 128 - code if code < 0 else code
        raise SusError(f"the run of {scene} ended with exit code {code}, so nothing is drawn{kept}", code)
    if not archive:
        raise SusError(f"the run of {scene} left no archive, so there is nothing to draw")
    return archive


def _wait(process: subprocess.Popen[bytes]) -> int:
    """Waits for a run and returns its exit code. Ctrl-C reaches the run, too, which then writes its output and ends."""
    while True:
        try:
            return process.wait()
        except KeyboardInterrupt:
            continue


def overrides_for(scene: str, sets: Sequence[str], film: bool) -> List[str]:
    """`sets` and, for a film, overrides that make the scene save often enough."""
    interval = film_interval(scene, sets) if film else None
    return [*sets, *([f"{BY_TIME}={interval:g}"] if interval else [])]
