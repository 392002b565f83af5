"""Reads `.uda` archives; all other Python code of this project uses this module for that."""
from __future__ import annotations

import difflib
import glob
import json
import os
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Set, Tuple

import h5py
import numpy as np

from tushar.dat import rows_of
from tushar.errors import ArchiveError, check_name
from tushar.grid import Grid, Values
from tushar.snapshot import Snapshot
from tushar.tracks import Tracks


FORMAT = 2  # of archives: the newest that is known here
BY_LETTER = {"p.": ("particle",), "c.": ("cell", "node"), "g.": ("cell", "node")}


@dataclass
class Variable:
    """A saved variable or a global quantity."""
    name: str
    unit: str
    description: str
    components: int = 1
    centring: str = "global"  # particle, cell, node or global
    materials: List[str] = field(default_factory=list)


@dataclass
class Series:
    """A global quantity as a function of time: `times` [s] (n,), `values` (n,) or (n, components)."""
    name: str
    unit: str
    description: str
    times: Values
    values: Values

    def __array__(self, dtype: Any = None, copy: Any = None) -> Values:
        return self.values if dtype is None else self.values.astype(dtype)

    def __len__(self) -> int:
        return len(self.times)


def _xml(path: str) -> ElementTree.Element:
    try:
        return ElementTree.parse(path).getroot()
    except (OSError, ElementTree.ParseError) as error:
        raise ArchiveError(f"cannot read '{path}': {error}") from None


def unlisted(folder: str, known: Set[str]) -> List[Tuple[int, float, str]]:
    """Step, time [s] and file of the outputs that index.xml lacks: it may be out of date during a run, or after a run
    was killed."""
    found = []
    for name in os.listdir(folder):
        if name in known or not re.fullmatch(r"t\d{5,}\.h5", name):
            continue
        try:
            with h5py.File(os.path.join(folder, name), "r") as file:
                found.append((int(file.attrs["step"]), float(file.attrs["time"]), name))
        except (OSError, KeyError):  # gone, or not of sus
            continue
    return found


class Globals(Mapping[str, Series]):
    """The global quantities of an archive, from its .dat files: `archive.globals["KineticEnergy"]`."""

    def __init__(self, variables: Dict[str, Variable], files: Dict[str, str]) -> None:
        self.variables, self._files = variables, files

    def __iter__(self) -> Iterator[str]:
        return iter(self.variables)

    def __len__(self) -> int:
        return len(self.variables)

    def __contains__(self, name: object) -> bool:
        return name in self.variables

    def __repr__(self) -> str:
        return f"<Globals: {', '.join(self.variables) or 'none'}>"

    def __getitem__(self, name: str) -> Series:
        variable = self.variables[check_name("global", name, self.variables)]
        try:
            rows = rows_of(self._files[name])
        except OSError as error:
            raise ArchiveError(f"cannot read '{self._files[name]}': {error}") from None
        columns = 1 + variable.components
        if rows and len(rows[0]) != columns:
            raise ArchiveError(f"'{self._files[name]}' has {len(rows[0])} numbers in its first line, expected "
                               f"{columns}: the time and the values")
        table = np.array(rows, dtype=float).reshape(-1, columns)
        values = table[:, 1] if columns == 2 else table[:, 1:]
        return Series(name, variable.unit, variable.description, table[:, 0], values)

    def to_pandas(self) -> Any:
        """A DataFrame of all quantities, indexed by time [s]; units in `frame.attrs["units"]`."""
        from tushar import frames
        return frames.of_globals(self)


class Archive(Sequence[Snapshot]):
    """An archive, `sod.uda` or `sod.uda.000`: a sequence of its outputs. `archive[0]` is the first, `archive[-1]` the
    last, `archive.at(0.1)` the nearest to a time. Opening it reads its index, and the times of outputs that a run has
    not listed there yet. Wrong names raise ArchiveError."""

    def __init__(self, path: Any, report: Optional[Dict[str, Any]] = None, keeps: Any = None) -> None:
        self.folder = os.path.normpath(os.fspath(path))
        self._report, self._keeps = report, keeps
        if not os.path.isfile(os.path.join(self.folder, "index.xml")):
            raise ArchiveError(self._not_an_archive())
        self.reload()

    def reload(self) -> None:
        """Rereads the index, for an archive to which a run is still writing."""
        path = os.path.join(self.folder, "index.xml")
        index = _xml(path)
        if index.tag == "Uintah_DataArchive":
            raise ArchiveError(f"'{self.folder}' is an archive of Uintah, which this reader does not support")
        try:
            self._read(index)
        except ValueError as error:
            raise ArchiveError(f"cannot read '{path}', which is damaged: {error}") from None

    def _read(self, index: ElementTree.Element) -> None:
        """Contents of the index; raises ValueError if a number is invalid."""
        self.version = index.get("version", "")
        if int(index.get("format", FORMAT)) > FORMAT:
            raise ArchiveError(f"'{self.folder}' has format {index.get('format')}, but this reader supports only "
                               f"formats up to {FORMAT}; it was written by sus {self.version}")
        self.variables = {item.get("name", ""): self._variable(item) for item in index.iterfind("variables/variable")}
        totals = {item.get("name", ""): item for item in index.iterfind("globals/global")}
        files = {name: os.path.join(self.folder, item.get("href", "")) for name, item in totals.items()}
        self.globals = Globals({name: self._variable(item) for name, item in totals.items()}, files)
        listed = [(int(output.text or 0), float(output.get("time", "nan")), output.get("href", ""))
                  for output in index.iterfind("timesteps/timestep")]
        outputs = sorted([*listed, *unlisted(self.folder, {name for _, _, name in listed})])
        self.times = [time for _, time, _ in outputs]
        self.steps = [step for step, _, _ in outputs]
        self.files = [os.path.join(self.folder, name) for _, _, name in outputs]

    def _not_an_archive(self) -> str:
        """Message for a path that is not an archive; names the archive that may be meant."""
        numbered = sorted(glob.glob(glob.escape(self.folder) + ".[0-9]*"))
        above, name = os.path.split(self.folder)
        if os.path.isdir(self.folder):
            what, near = "has no index.xml, so it is not an archive", numbered or self._links(self.folder)
        elif os.path.exists(self.folder):
            what, near = "is a file, but an archive is a folder", []
            if os.path.isfile(os.path.join(above, "index.xml")):
                what = f"is a file of an archive, which is the folder '{above or '.'}'"
        else:
            links = {os.path.basename(path)[:-len(".uda")]: path for path in self._links(above)}
            alike = difflib.get_close_matches(name.split(".uda")[0], links, 1)
            what, near = "is no folder", numbered or [links[other] for other in alike]
        return f"'{self.folder}' {what}" + (f"; there is '{near[-1]}'" if near else "")

    @staticmethod
    def _links(folder: str) -> List[str]:
        """The archives in a folder, without those of earlier runs with the same name."""
        return sorted(glob.glob(os.path.join(glob.escape(folder), "*.uda")))

    @staticmethod
    def _variable(item: ElementTree.Element) -> Variable:
        materials = item.get("materials", "")
        return Variable(item.get("name", ""), item.get("unit", ""), item.get("description", ""),
                        int(item.get("components", 1)), item.get("centring", "global"),
                        materials.split(", ") if materials else [])

    def __repr__(self) -> str:
        many = "output" if len(self) == 1 else "outputs"
        names = ", ".join([*self.variables, *self.globals])
        return f"<Archive {self.folder}: {self.title}, {len(self)} {many}, {names}>"

    def __len__(self) -> int:
        return len(self.times)

    def __getitem__(self, index: Any) -> Any:
        """The output with this index, or a list of outputs for a slice."""
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if isinstance(index, str):
            raise ArchiveError(f"outputs are selected by number: archive[-1]['{index}'], or archive.globals['{index}']")
        if not isinstance(index, (int, np.integer)):
            raise ArchiveError(f"outputs are selected by whole numbers, found {index!r}; archive.at({index!r}) finds "
                               "the output nearest to a time")
        count = len(self)
        if not -count <= index < count:
            if not count:
                raise OutputError(f"'{self.folder}' has no outputs yet")
            raise OutputError(f"no output {index}: '{self.folder}' has {count}, 0 to {count - 1}")
        index = int(index) % count
        return Snapshot(self, index, self.files[index], self.times[index], self.steps[index])

    def at(self, time: float) -> Snapshot:
        """The output whose time is nearest to a time [s]."""
        found: Snapshot = self[self.index_at(time)]
        return found

    def index_at(self, time: float) -> int:
        """The index of the output whose time is nearest to a time [s]."""
        if not np.isfinite(time):
            raise ArchiveError(f"found the time {time}, expected a finite number of seconds")
        if not self.times:
            raise ArchiveError(f"'{self.folder}' has no outputs yet")
        return int(np.argmin(np.abs(np.array(self.times) - time)))

    def variable(self, name: str, centrings: Sequence[str] = ()) -> Variable:
        """The saved variable of this name with one of the given centrings; by default the centring that its first
        letter denotes."""
        wanted = centrings or BY_LETTER.get(name[:2], ("particle", "cell", "node"))
        names = [other for other, variable in self.variables.items() if variable.centring in wanted]
        kind = "variable" if len(wanted) == 3 else " or ".join(wanted) + " variable"
        return self.variables[check_name(kind, name, names)]

    def has_file(self, index: int) -> bool:
        """Whether the file of an output exists."""
        return os.path.exists(self.files[index])

    @property
    def title(self) -> str:
        """The title of the scene, `Meta/title`; the folder's name if there is none."""
        try:
            title = (_xml(os.path.join(self.folder, "input.xml")).findtext("Meta/title") or "").strip()
        except ArchiveError:
            title = ""
        return title or os.path.basename(self.folder)

    @property
    def runs(self) -> List[Dict[str, Any]]:
        """The entries of run.json, one for each start and restart: program, command line, dates and end; [] of older
        archives."""
        try:
            with open(os.path.join(self.folder, "run.json"), encoding="utf-8") as file:
                found: List[Dict[str, Any]] = json.load(file)["runs"]
        except (OSError, ValueError, KeyError, TypeError):
            return []
        return found if isinstance(found, list) else []

    @property
    def materials(self) -> List[str]:
        """Names of the materials that have variables."""
        return list(dict.fromkeys(name for variable in self.variables.values() for name in variable.materials))

    @property
    def grid(self) -> Grid:
        """The grid of the last output."""
        with self[-1] as snapshot:
            found: Grid = snapshot.grid
        return found

    @property
    def report(self) -> Dict[str, Any]:
        """The report of the run: the contents of the report.json that `sus --json` wrote to the archive's folder or
        next to it."""
        if self._report is None:
            self._report = self._find_report()
        return self._report

    def _find_report(self) -> Dict[str, Any]:
        own = os.path.realpath(self.folder)
        for path in (os.path.join(own, "report.json"), os.path.join(os.path.dirname(own), "report.json")):
            try:
                with open(path, encoding="utf-8") as file:
                    found = json.load(file)
            except (OSError, ValueError):
                continue
            if isinstance(found, dict) and os.path.basename(found.get("archive", "")) == os.path.basename(own):
                return found
        raise ArchiveError(f"there is no report of '{self.folder}': sus --json report.json writes one next to it")

    def particles(self, ids: Optional[Sequence[int]] = None, material: Optional[str] = None) -> Tracks:
        """Particles over time, identified by their ids; by default all particles of the last output. Particles of
        different materials may have the same id; then name the material."""
        return Tracks(self, ids, material)

    def to_xarray(self, variables: Optional[Sequence[str]] = None) -> Any:
        """A Dataset of the fields on cells and nodes over time; values are read when they are used."""
        from tushar import frames
        return frames.dataset(self, list(self), variables)

    def to_pandas(self) -> Any:
        """The global quantities over time as a DataFrame; for a single output use `archive[-1].to_pandas()`."""
        return self.globals.to_pandas()


class OutputError(ArchiveError, IndexError):
    """Error for an index that has no output."""


def open_archive(path: Any) -> Archive:
    """Opens an archive, `sod.uda` or `sod.uda.000`."""
    return Archive(path)
