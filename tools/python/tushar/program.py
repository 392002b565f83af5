"""The locations of the simulator and its scenes."""
from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
from typing import Any, Dict, List, Optional, Sequence, Union

from tushar.errors import SusError

Path = Union[str, "os.PathLike[str]"]
PRESETS = ("release", "dev")


def _tree() -> pathlib.Path:
    """The root of the repository: above this file or, for an installed package, the working folder or one above it."""
    here = pathlib.Path(__file__).resolve()
    for folder in (*here.parents, *pathlib.Path(os.path.abspath(".")).joinpath("x").parents):
        if (folder / "tools/run").is_file() and (folder / "ups").is_dir():
            return folder
    return pathlib.Path.cwd()


ROOT = _tree()
SUS = str(ROOT / "build/release/sus")


class SceneError(SusError):
    """The messages of sus for a scene that it does not run."""


def scene_path(scene: Path) -> pathlib.Path:
    """The path of a scene relative to the working folder or, failing that, to the root of the repository."""
    return pathlib.Path(scene).resolve() if os.path.exists(scene) else ROOT / scene


def find_sus(sus: Optional[Path] = None) -> str:
    """The program: `sus` if given, else $SUS, the repository's build, the PATH. Raises SusError if it is in none of
    them."""
    named = sus or os.environ.get("SUS")
    if named:
        found = shutil.which(os.fspath(named))
        if not found:
            raise SusError(f"'{os.fspath(named)}'{'' if sus else ', which $SUS names,'} is not a program")
        return os.path.abspath(found)
    built = [ROOT / "build" / preset / "sus" for preset in PRESETS]
    for path in [*built, *sorted((ROOT / "build").glob("*/sus"))]:
        if os.access(path, os.X_OK) and path.is_file():
            return str(path)
    installed = shutil.which("sus")
    if not installed:
        raise SusError(f"sus was not found in $SUS, in {ROOT / 'build'} or on the PATH; tools/run builds it in the "
                       f"repository, and $SUS can name it: SUS=REPOSITORY/build/release/sus")
    return installed


def command_of(sus: Path, scene: Path, sets: Sequence[str], folder: Path, options: Sequence[str] = ()) -> List[str]:
    """The command of a run that prints nothing; its files and report.json are written to `folder`."""
    words = [str(sus), str(scene_path(scene)), "--quiet", "--json", str(pathlib.Path(folder, "report.json")),
             "--output", str(folder), *options]
    for override in sets:
        words += ["--set", override]
    return words


def run_scene(sus: Path, scene: Path, sets: Sequence[str], folder: Path) -> Dict[str, Any]:
    """Runs a scene with overrides, with its files in `folder`; returns the report. Its entry `failure` is the message
    of a failed run, otherwise empty. Raises SceneError for a scene that does not run."""
    from tushar.runs import read_report
    done = subprocess.run(command_of(sus, scene, sets, folder), capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SceneError(f"{scene}: {done.stderr.strip() or 'sus failed'}", done.returncode)
    report = read_report(folder)
    if done.returncode == 0 and report is None:
        raise SceneError(f"{sus} wrote no report; it may not be sus")
    return {"failure": done.stderr.strip()} if report is None else report


def ensure_built(sus: str) -> None:
    """If this is the repository's program and it does not exist, installs missing packages and builds the release
    preset."""
    if sus == SUS and not os.path.exists(sus):
        subprocess.run(["bash", "-euc", '. tools/lib/build.sh; install_missing "${packages[@]}"; build release sus'],
                       cwd=ROOT, check=True)
