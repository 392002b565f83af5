"""Particles over time."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Optional, Sequence

import h5py
import numpy as np

from tushar.errors import ArchiveError, check_name
from tushar.grid import Values
from tushar.snapshot import ID, NO_IDS, Snapshot

if TYPE_CHECKING:
    from tushar.archive import Archive

FEW = 64  # rows that are read one by one; of more, all between the first and the last


def checked_ids(ids: Any) -> Values:
    """The ids as an array; raises ArchiveError if some are not whole numbers from 0 on."""
    given = np.atleast_1d(np.asarray(ids))
    if given.size and (given.dtype.kind not in "iu" or given.min() < 0):
        raise ArchiveError(f"found {str(ids)[:60]}, expected ids of particles, which are whole numbers from 0 on")
    return given.astype(np.uint64)


class Tracks:
    """Particles by their ids over all outputs: `tracks["p.x"]` has the shape (times, ids) or (times, ids, components),
    NaN if a particle does not exist. Whatever is asked for is read then, and not kept. Raises ArchiveError if an id is
    that of particles of several materials, and no material is named."""

    def __init__(self, archive: Archive, ids: Optional[Sequence[int]], material: Optional[str]) -> None:
        self.archive, self.material = archive, material
        if ID not in archive.variables:
            raise ArchiveError(NO_IDS)
        if not len(archive):
            raise ArchiveError(f"'{archive.folder}' has no outputs yet")
        if ids is None:
            with archive[-1] as last:
                ids = last.particles(material).ids.values
        self.ids: Values = checked_ids(ids)

    @property
    def times(self) -> Values:
        """Times of the outputs [s]."""
        return np.array(self.archive.times)

    @property
    def variables(self) -> List[str]:
        return [name for name, variable in self.archive.variables.items() if variable.centring == "particle"]

    def __len__(self) -> int:
        return len(self.ids)

    def __repr__(self) -> str:
        return f"<{len(self)} particles of {self.archive.folder} at {len(self.archive)} times>"

    def __getitem__(self, name: str) -> Values:
        check_name("particle variable", name, self.variables)
        components = self.archive.variables[name].components
        values = np.full((len(self.archive), len(self.ids), components), np.nan)
        seen = np.zeros(len(self.ids), bool)
        for row, snapshot in zip(values, self.archive):
            with snapshot:
                seen |= self._read(snapshot, name, row)
        if not seen.all():
            gone = [str(number) for number in self.ids[~seen]]
            raise ArchiveError(f"no output has a particle with id "
                               f"{', '.join(gone[:5])}{', …' if len(gone) > 5 else ''}")
        return values[..., 0] if components == 1 else values

    def _read(self, snapshot: Snapshot, name: str, row: Values) -> Values:
        """Writes the values of an output into `row`; returns which ids were found."""
        found, owners = np.zeros(len(self.ids), bool), np.zeros(len(self.ids), object)
        for material in [self.material] if self.material else snapshot.materials:
            group = snapshot.file["particles"][check_name("material", material, snapshot.materials)]
            if ID not in group:
                continue
            known = group[ID][()]
            order = np.argsort(known, kind="stable")  # outputs are in the order of the ids already
            places = np.searchsorted(known, self.ids, sorter=order)
            here = places < len(known)
            here[here] = known[order[places[here]]] == self.ids[here]
            if (found & here).any():
                twice = int(np.argmax(found & here))
                raise ArchiveError(f"particles of several materials, {owners[twice]} and {material}, have the id "
                                   f"{self.ids[twice]}; choose one: particles(ids, material='{material}')")
            if name in group and here.any():
                row[here] = rows_of(group[name], order[places[here]]).reshape(int(here.sum()), -1)
            found, owners = found | here, np.where(here, material, owners)
        return found

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each time and particle, indexed by (time, id)."""
        from tushar import frames
        return frames.of_tracks(self)

    def to_xarray(self) -> Any:
        """A Dataset over `time` and `id`."""
        from tushar import frames
        return frames.dataset_of_tracks(self)


def rows_of(data: h5py.Dataset, rows: Values) -> Values:
    """Reads rows of a dataset, in any order, without reading distant ones."""
    if len(rows) <= FEW:
        return np.stack([data[int(row)] for row in rows])
    first = int(rows.min())
    between: Values = data[first:int(rows.max()) + 1]
    return np.asarray(between[rows - first])
