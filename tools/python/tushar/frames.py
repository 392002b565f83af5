"""Archives as pandas frames and xarray datasets."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from tushar.errors import ArchiveError, check_name, need
from tushar.grid import Grid, Values
from tushar.refined import Refined, cells_of
from tushar.snapshot import ID, Particles, Snapshot

if TYPE_CHECKING:
    from tushar.archive import Archive, Globals, Variable
    from tushar.tracks import Tracks

KINDS = {"particles": "particle", "cells": "cell", "nodes": "node"}
TAILS = {1: [""], 3: [".x", ".y", ".z"], 9: ["." + a + b for a in "xyz" for b in "xyz"]}
DIMS = {"cell": ("z", "y", "x"), "node": ("z_node", "y_node", "x_node")}


def tails(count: int) -> List[str]:
    """Suffixes of a variable's name for its components: .x, .y, .z."""
    return TAILS.get(count, [f".{k + 1}" for k in range(count)])


def columns_of(name: str, values: Values) -> Dict[str, Values]:
    """One column for each component of an array (n,) or (n, components)."""
    values = values[:, None] if values.ndim == 1 else values
    return {name + tail: column for tail, column in zip(tails(values.shape[1]), values.T)}


def _frame(columns: Dict[str, Values], units: Dict[str, str], **options: Any) -> Any:
    frame = need("pandas", "to_pandas").DataFrame(columns, **options)
    frame.attrs["units"] = units
    return frame


def of_globals(quantities: Globals) -> Any:
    pandas = need("pandas", "to_pandas")
    frames, units = [], {}
    for name, series in quantities.items():
        columns = columns_of(name, series.values)
        units.update(dict.fromkeys(columns, series.unit))
        frames.append(pandas.DataFrame(columns, index=pandas.Index(series.times, name="time")))
    frame = pandas.concat(frames, axis=1) if frames else pandas.DataFrame()
    frame.attrs["units"] = units
    return frame


def of_particles(particles: Particles) -> Any:
    """A frame with a row for each particle; a variable that a material does not have is NaN."""
    pandas = need("pandas", "to_pandas")
    archive = particles.snapshot.archive
    frames, units = [], {}
    for material in particles.materials:
        own = particles.snapshot.particles(material)
        columns: Dict[str, Values] = {}
        for name in own.variables:
            if name != ID:
                more = columns_of(name, own[name].values)
                units.update(dict.fromkeys(more, archive.variables[name].unit))
                columns.update(more)
        index = pandas.Index(own.ids.values, name="id") if ID in own.variables else None
        frame = pandas.DataFrame(columns, index=index)
        frame.insert(0, "material", material)
        frames.append(frame)
    frame = pandas.concat(frames) if frames else pandas.DataFrame()
    frame.attrs["units"] = units
    return frame


def of_snapshot(snapshot: Snapshot, of: Optional[str], material: Optional[str]) -> Any:
    held = {snapshot.archive.variables[name].centring for name in snapshot.variables}
    kinds = [kind for kind, centring in KINDS.items() if centring in held]
    if of is not None:
        check_name("kind of value", of, kinds)
    elif not kinds:
        raise ArchiveError(f"output {snapshot.index} of '{snapshot.archive.folder}' contains nothing")
    kind = of or kinds[0]
    if kind == "particles":
        return of_particles(snapshot.particles(material))
    return _of_field(snapshot, KINDS[kind], material)


def _of_field(snapshot: Snapshot, centring: str, material: Optional[str]) -> Any:
    """A frame with a row for each cell or node; for a refined grid, a row for each actual cell, with its level."""
    columns = places_of(snapshot.grid, centring)
    count = len(next(iter(columns.values())))
    units = {name: "" if name == "level" else "m" for name in columns}
    for name, variable, owner in fields_of(snapshot):
        if variable.centring == centring and material in (None, owner):
            more = columns_of(name, rows_of(_field(snapshot, variable, owner)).reshape(count, -1))
            columns.update(more)
            units.update(dict.fromkeys(more, variable.unit))
    return _frame(columns, units)


def places_of(grid: Grid, centring: str) -> Dict[str, Values]:
    """The centres of cells, or the nodes, along the axes in use [m], and the levels of the cells of a refined grid."""
    if grid.is_refined and centring == "cell":
        centres, levels = cells_of(grid)
        return {**{"xyz"[axis]: centres[:, axis] for axis in grid.axes}, "level": levels}
    z, y, x = np.meshgrid(*grid.coordinates(centring)[::-1], indexing="ij")
    return {"xyz"[axis]: (x, y, z)[axis].ravel() for axis in grid.axes}


def rows_of(field: Any) -> Values:
    """Values of a field in the order of `places_of`."""
    return np.asarray(field.cell_values if isinstance(field, Refined) else field.values)


def fields_of(snapshot: Snapshot) -> List[Tuple[str, Variable, Optional[str]]]:
    """Name, variable and material of each field of an output; the name is `g.mass.gas` if several materials have the
    variable."""
    found: List[Tuple[str, Variable, Optional[str]]] = []
    for variable in snapshot.archive.variables.values():
        if variable.centring not in DIMS:
            continue
        group = snapshot.file.get(variable.centring + "s", {})
        if variable.name in group:
            found.append((variable.name, variable, None))
        owners = [material for material in variable.materials if variable.name in group.get(material, {})]
        for owner in owners:
            several = len(variable.materials) > 1
            found.append((f"{variable.name}.{owner}" if several else variable.name, variable, owner))
    return found


def of_tracks(tracks: Tracks) -> Any:
    pandas = need("pandas", "to_pandas")
    index = pandas.MultiIndex.from_product([tracks.times, tracks.ids], names=["time", "id"])
    columns: Dict[str, Values] = {}
    units: Dict[str, str] = {}
    for name in tracks.variables:
        if name != ID:
            more = columns_of(name, tracks[name].reshape(len(index), -1))
            columns.update(more)
            units.update(dict.fromkeys(more, tracks.archive.variables[name].unit))
    return _frame(columns, units, index=index)


def dataset_of_tracks(tracks: Tracks) -> Any:
    xarray = need("xarray", "to_xarray")
    found = {}
    coordinates: Dict[str, Any] = {"time": ("time", tracks.times, {"units": "s"}), "id": tracks.ids}
    for name in tracks.variables:
        if name != ID:
            variable = tracks.archive.variables[name]
            dims = ("time", "id", *_components(variable))
            found[name] = (dims, tracks[name], _attributes(variable))
            coordinates.update(_names_of_components(variable))
    return xarray.Dataset(found, coordinates, {"title": tracks.archive.title})


def _attributes(variable: Variable) -> Dict[str, str]:
    return {"units": variable.unit, "long_name": variable.description}


def _components(variable: Variable) -> Tuple[str, ...]:
    return () if variable.components == 1 else (f"component_{variable.components}",)


def _names_of_components(variable: Variable) -> Dict[str, Any]:
    """Names of the components: x, y, z of vectors, xx to zz of tensors."""
    names = [tail[1:] for tail in tails(variable.components)]
    return {dim: (dim, names, {}) for dim in _components(variable)}


def dataset(archive: Archive, snapshots: Sequence[Snapshot], names: Optional[Sequence[str]] = None) -> Any:
    """Fields over time, read lazily. All outputs have the grid and the fields of the last, or not a number; a refined
    grid is sampled onto the finest level of the last."""
    xarray = need("xarray", "to_xarray")
    if not snapshots:
        raise ArchiveError(f"'{archive.folder}' has no outputs yet")
    for name in names or ():
        check_name("variable", name, [v.name for v in archive.variables.values() if v.centring in DIMS])
    grid = snapshots[-1].grid
    found = {}
    coordinates: Dict[str, Any] = {"time": ("time", [snapshot.time for snapshot in snapshots], {"units": "s"})}
    for name, variable, owner in fields_of(snapshots[-1]):
        if names and variable.name not in names:
            continue
        dims = ("time", *DIMS[variable.centring], *_components(variable))
        found[name] = (dims, _lazy(snapshots, variable, owner), _attributes(variable))
        coordinates.update(_places(grid, variable.centring))
        coordinates.update(_names_of_components(variable))
    if not found:
        raise ArchiveError(f"'{archive.folder}' contains no fields on cells or nodes")
    return xarray.Dataset(found, coordinates, {"title": archive.title})


def _places(grid: Grid, centring: str) -> Dict[str, Any]:
    lines = grid.coordinates(centring)
    return {name: (name, line, {"units": "m"}) for name, line in zip(DIMS[centring], lines[::-1])}


def _lazy(snapshots: Sequence[Snapshot], variable: Variable, owner: Optional[str]) -> Any:
    """An xarray array (time, z, y, x, …) that reads only the selected values."""
    from xarray.backends import BackendArray
    from xarray.core import indexing

    first = _field(snapshots[-1], variable, owner)

    class Series(BackendArray):  # type: ignore[misc]
        shape, dtype = (len(snapshots), *first.shape), first.dtype

        def __getitem__(self, key: Any) -> Any:
            return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.BASIC, self._read)

        def _read(self, key: Any) -> Values:
            times, *rest = key
            chosen = list(snapshots)[times] if isinstance(times, slice) else [snapshots[times]]
            parts = [_values(snapshot, variable, owner, tuple(rest), first) for snapshot in chosen]
            return np.stack(parts) if isinstance(times, slice) else np.asarray(parts[0])

    return indexing.LazilyIndexedArray(Series())


def _field(snapshot: Snapshot, variable: Variable, owner: Optional[str]) -> Any:
    return snapshot[variable.name, owner] if owner else snapshot[variable.name]


def _values(snapshot: Snapshot, variable: Variable, owner: Optional[str], key: Any, like: Any) -> Values:
    """The selected values of an output; NaN if the output does not have the field, as the initial output lacks
    variables that are
    computed in steps."""
    with Snapshot(snapshot.archive, snapshot.index, snapshot.path, snapshot.time, snapshot.step) as own:
        held = {name for name, *_ in fields_of(own)}
        if not held & {variable.name, f"{variable.name}.{owner}"}:
            return np.asarray(np.broadcast_to(np.nan, like.shape)[key])
        field = _field(own, variable, owner)
        if field.shape == like.shape:
            return np.asarray(field[key])
        if not isinstance(field, Refined):
            raise ArchiveError(f"output {own.index} has other cells than the last: use to_xarray() of each output")
        return np.asarray(field.level(like.grid.levels - 1 if isinstance(like, Refined) else 0)[key])
