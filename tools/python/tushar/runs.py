"""Runs scenes."""
from __future__ import annotations

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import weakref
from typing import Any, Dict, List, Mapping, Optional, Sequence, Union

from tushar.errors import BY_EXIT_CODE, CommandError, SusError
from tushar.program import Path, command_of, find_sus

# Open MPI refuses root, and more ranks than cores, unless it is allowed to.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}


class Temporary:
    """A folder that is deleted when no object refers to it any more."""

    def __init__(self) -> None:
        self.path = tempfile.mkdtemp(prefix="tushar-")
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


class Run:
    """A finished run. `report` is the output of `sus --json`, {} if there is none. `folder` contains the archive and
    report.json; if no output folder was named, it is deleted when neither the run nor its archive is in use."""

    def __init__(self, scene: Path, sets: Mapping[str, Any], folder: pathlib.Path,
                 keeps: Optional[Temporary] = None) -> None:
        self.scene, self.sets, self.folder, self._keeps = os.fspath(scene), dict(sets), folder, keeps
        self.report: Dict[str, Any] = read_report(folder) or {}
        self.errors = ""  # what sus wrote to its standard error

    def __repr__(self) -> str:
        steps, time = self.report.get("steps", 0), self.report.get("time", 0)
        ended = self.report.get("failure") or f"{steps} step{'s'[steps == 1:]} to t = {time:g} s"
        return f"<Run of {self.scene}: {ended}>"

    @property
    def archive(self) -> Any:
        """The archive that the run wrote. Raises ArchiveError if it wrote none."""
        from tushar.archive import Archive
        from tushar.errors import ArchiveError
        written = self.report.get("archive", "")
        if not written:
            found = [path.parent for path in self.folder.glob("*.uda.*/index.xml")]
            written = str(max(found, key=lambda path: path.stat().st_mtime)) if found else ""
        if not written:
            raise ArchiveError(f"the run of {self.scene} left no archive in '{self.folder}'")
        return Archive(written, self.report or None, self._keeps)


def run(scene: Path, sets: Optional[Mapping[str, Any]] = None, *, ranks: int = 1, threads: Optional[int] = None,
        output: Optional[Path] = None, options: Union[str, Sequence[str]] = (), sus: Optional[Path] = None,
        timeout: Optional[float] = None) -> Run:
    """Runs a scene with overrides `sets`, path -> value: {"Grid/Level/Box/resolution": [200, 1, 1]}.

    The scene's path is relative to the current folder or to the root of the repository; the program is searched in
    `sus`, $SUS, the repository's build and the PATH. `threads` are per rank; None chooses a suitable number. The
    archive is written to the folder `output`, by default to a folder that is deleted with the run. `options` are
    further arguments of sus, as a list or as one string. After `timeout` [s], the run is ended.

    Raises InputError (exit code 3), NumericalError (4), CommandError (2), Interrupted (5), otherwise SusError, with the
    messages of sus.
    """
    program, overrides = find_sus(sus), dict(sets or {})
    words = [*words_of(options), *(["--nthreads", str(threads)] if threads else [])]
    keeps = None if output else Temporary()
    folder = pathlib.Path(keeps.path if keeps else output or ".").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "report.json").unlink(missing_ok=True)
    command = launcher(ranks) + command_of(program, scene, sets_of(overrides), folder, words)
    code, errors = _finish(command, ranks, timeout, scene)
    done = Run(scene, overrides, folder, keeps)
    done.errors = errors
    if code:
        raise error_of(code, errors, done)
    return done


def _finish(command: List[str], ranks: int, timeout: Optional[float], scene: Path) -> Any:
    """Waits for a run; returns its exit code and standard error. If an exception (Ctrl-C) interrupts the wait, the run
    is ended."""
    environment = {**os.environ, **(MPI if ranks > 1 else {})}
    try:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   env=environment)
    except FileNotFoundError:
        raise SusError(f"'{command[0]}' was not found on the PATH; on Debian: apt install openmpi-bin") from None
    try:
        _, errors = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        raise SusError(f"{os.fspath(scene)} did not end within {timeout:g} s") from None
    finally:
        if process.poll() is None:
            _end(process)
    return process.returncode, errors


def _end(process: subprocess.Popen[str]) -> None:
    """Ends a run; it first has ten seconds to write its output."""
    process.terminate()
    try:
        process.communicate(timeout=10)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()


def launcher(ranks: int) -> List[str]:
    """The command that starts a program on several ranks; empty for one rank."""
    if ranks < 1:
        raise CommandError(f"found ranks={ranks}, expected at least 1")
    return [] if ranks == 1 else ["mpirun", "-n", str(ranks)]


def words_of(options: Union[str, Sequence[str]]) -> List[str]:
    """The words of options that are a list or, as in a shell, one string."""
    try:
        return shlex.split(options) if isinstance(options, str) else list(options)
    except ValueError as error:
        raise CommandError(f"found the options '{options}': {error}") from None


def error_of(code: int, errors: str, done: Run) -> SusError:
    """The error for an exit code, with the messages of sus."""
    said = errors.strip() or str(done.report.get("failure", ""))
    if code < 0:
        said = said or f"sus was killed by signal {-code}"
    said = said.replace("sus: ", "", 1) or f"sus failed with exit code {code}"
    return BY_EXIT_CODE.get(code, SusError)(said, code, done)


def sets_of(overrides: Mapping[str, Any]) -> List[str]:
    """PATH=VALUE for each override, for `sus --set`."""
    return [f"{path}={text_of(value)}" for path, value in overrides.items()]


def text_of(value: Any) -> str:
    """A value in the notation of scenes: 0.1, true, [200,1,1]."""
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist"):  # numpy's numbers and arrays
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(map(text_of, value)) + "]"
    return repr(value) if isinstance(value, float) else str(value)


def read_report(folder: Path) -> Optional[Dict[str, Any]]:
    """The report that a run has written to its folder; None if there is none."""
    path = pathlib.Path(folder, "report.json")
    if not path.exists():
        return None
    found: Dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found
