"""The errors of the package: each message states what is wrong and, where possible, what to do."""
from __future__ import annotations

import difflib
import importlib
from types import ModuleType
from typing import TYPE_CHECKING, Iterable, Optional

if TYPE_CHECKING:
    from tushar.runs import Run


class TusharError(Exception):
    """Base class of the errors of this package."""


class ArchiveError(TusharError):
    """An error in an archive, or in a request for its contents."""


class MissingLibrary(TusharError, ImportError):
    """Error for an optional library that is not installed."""


class SusError(TusharError):
    """Error for a failed run. `sentences` are the messages of sus, `code` is its exit code, `run` contains what the run
    left."""

    def __init__(self, message: str, code: int = 1, run: Optional[Run] = None) -> None:
        super().__init__(message)
        self.sentences = [line for line in message.splitlines() if line.strip()]
        self.code = code
        self.run = run


class CommandError(SusError):
    """Exit code 2: options that sus does not accept."""


class InputError(SusError):
    """Exit code 3: all mistakes in the scene or its overrides, one sentence for each."""


class NumericalError(SusError):
    """Exit code 4: a value became unphysical during the run. `run.archive` contains the outputs until then."""


class Interrupted(SusError):
    """Exit code 5: the run was stopped by a signal, after writing its output."""


BY_EXIT_CODE = {2: CommandError, 3: InputError, 4: NumericalError, 5: Interrupted}


def sentence_of(error: BaseException) -> str:
    """What an error says; for a file, its name and what is wrong with it, without the number of the error."""
    if isinstance(error, OSError) and error.filename and error.strerror:
        return f"'{error.filename}': {error.strerror}"
    return str(error)


def check_name(kind: str, name: str, names: Iterable[str]) -> str:
    """Returns `name` if it is among `names`; otherwise raises ArchiveError with the most similar name and all
    others."""
    names = list(names)
    if name in names:
        return name
    lowered = {other.lower(): other for other in names}
    near = difflib.get_close_matches(str(name).lower(), lowered, 1, 0.5)
    hint = f" (did you mean '{lowered[near[0]]}'?)" if near else ""
    there = ", ".join(names) if names else "none"
    raise ArchiveError(f"no {kind} '{name}'{hint}; there is: {there}")


def need(module: str, what: str) -> ModuleType:
    """Imports an optional library; raises MissingLibrary with the package to install if it is not installed."""
    try:
        return importlib.import_module(module)
    except ImportError:
        name = module.split(".")[0]
        advice = f"python3 -m pip install {name}"
        raise MissingLibrary(f"{what} needs {name}, which this Python does not have: {advice}") from None
