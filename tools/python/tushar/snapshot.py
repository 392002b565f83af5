"""One output of an archive."""
from __future__ import annotations

import os
from types import TracebackType
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple, Type, Union

import h5py

from tushar.arrays import Array
from tushar.errors import ArchiveError, check_name
from tushar.grid import Grid, Values
from tushar.refined import Refined

if TYPE_CHECKING:
    from tushar.archive import Archive, Variable

ID = "p.particleID"
NO_IDS = f'the scene does not save the ids of particles; add <save label="{ID}"/> to its DataArchiver'


class Snapshot:
    """One output of an archive: `snapshot["p.density"]`, `snapshot["c.velocity"]`, `snapshot["g.mass", "gas"]`.

    Arrays of particles have the shape (n,) or (n, components), arrays of cells and nodes (z, y, x) or (z, y, x,
    components); on a refined grid, the shape is that of the finest level (`Refined`). Values are read only when they
    are used. Wrong names raise ArchiveError.
    """

    def __init__(self, archive: Archive, index: int, path: str, time: float, step: int) -> None:
        self.archive, self.index, self.path, self.time, self.step = archive, index, path, time, step
        self._opened: Optional[h5py.File] = None
        self._grid: Optional[Grid] = None

    def __repr__(self) -> str:
        name = os.path.basename(self.archive.folder)
        return f"<Snapshot {self.index} of {name}, t = {self.time:g} s, step {self.step}>"

    def __enter__(self) -> Snapshot:
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file; arrays that have not been read yet can no longer be read."""
        if self._opened:
            self._opened.close()
        self._opened = None

    @property
    def file(self) -> h5py.File:
        """The HDF5 file, opened when it is first needed."""
        if not self._opened:
            try:
                self._opened = h5py.File(self.path, "r")
            except OSError as error:
                if not os.path.exists(self.path):
                    raise ArchiveError(f"the file of output {self.index}, '{self.path}', is missing") from None
                raise ArchiveError(f"cannot read '{self.path}', which is damaged or incomplete: {error}") from None
        return self._opened

    @property
    def grid(self) -> Grid:
        """The grid; for a refined grid, the uniform grid of its finest level, with the actual boxes."""
        if self._grid is None:
            group = self.file["grid"]
            kept = group.attrs
            self._grid = Grid(kept["lower"], kept["spacing"], kept["cells"], int(kept["dimension"]))
            if "inside" in group:
                self._grid.inside = group["inside"][()].astype(int)
            if "boxes" in group:
                levels = len(group["levels"])
                self._grid = self._grid.level(levels - 1)
                self._grid.boxes, self._grid.levels = group["boxes"][()].astype(int), levels
        return self._grid

    @property
    def materials(self) -> Dict[str, int]:
        """Material -> number of particles, in the order of the scene."""
        groups = sorted(self.file.get("particles", {}).items(), key=lambda item: int(item[1].attrs.get("index", 0)))
        return {name: len(group["p.x"]) for name, group in groups}

    @property
    def reference(self) -> Dict[str, Values]:
        """Column -> values of the exact solution; empty if the archive has none."""
        return {name: column[()] for name, column in self.file.get("reference", {}).items()}

    @property
    def variables(self) -> List[str]:
        """Names of the variables in this output."""
        return [name for name in self.archive.variables if self._holds(name)]

    def _holds(self, name: str) -> bool:
        variable = self.archive.variables[name]
        top = self.file.get("particles" if variable.centring == "particle" else variable.centring + "s", {})
        return name in top or any(name in group for group in top.values() if isinstance(group, h5py.Group))

    def __contains__(self, name: str) -> bool:
        return name in self.archive.variables and self._holds(name)

    def __getitem__(self, key: Union[str, Tuple[str, Optional[str]]]) -> Array:
        name, material = key if isinstance(key, tuple) else (key, None)
        variable = self.archive.variable(name)
        if variable.centring == "particle":
            return self.particles(material)[name]
        return self._field(variable, material)

    def particles(self, material: Optional[str] = None) -> Particles:
        """The particles of a material, or of all materials."""
        known = self.materials
        return Particles(self, [check_name("material", material, known)] if material else list(known), material)

    def _field(self, variable: Variable, material: Optional[str]) -> Array:
        name = variable.name
        group = self.file.get(variable.centring + "s", {})
        if material:
            check_name("material", material, variable.materials)
        if name in group and not material:
            return self._on_grid(group[name], variable)
        names = [material] if material else [other for other in variable.materials if name in group.get(other, {})]
        if len(names) > 1:
            raise ArchiveError(f"'{name}' belongs to several materials; choose one: {', '.join(names)}")
        if not names or name not in group.get(names[0], {}):
            initial = self.file.attrs["step"] == 0
            why = "; it is computed in a step, and this output is the initial state" if initial else ""
            raise ArchiveError(f"output {self.index} contains no '{name}'{why}")
        return self._on_grid(group[names[0]][name], variable)

    def _on_grid(self, data: h5py.Dataset, variable: Variable) -> Array:
        if variable.centring == "cell" and self.grid.is_refined:
            return Refined(data, self.grid, variable.name, variable.unit, variable.description)
        return self._array([data], variable)

    @staticmethod
    def _array(parts: List[h5py.Dataset], variable: Variable) -> Array:
        return Array(parts, variable.name, variable.unit, variable.description)

    def to_pandas(self, of: Optional[str] = None, material: Optional[str] = None) -> Any:
        """A DataFrame with a row for each particle, cell or node: `of` is "particles", "cells" or "nodes"; by default
        the first of these that exists. Units are in `frame.attrs["units"]`."""
        from tushar import frames
        return frames.of_snapshot(self, of, material)

    def to_xarray(self) -> Any:
        """A Dataset of the fields on cells and nodes, with coordinates [m] and units."""
        from tushar import frames
        return frames.dataset(self.archive, [self]).isel(time=0)

    def to_pyvista(self) -> Any:
        """A pyvista MultiBlock: `cells`, with the fields of cells and nodes, and a PolyData for each material's
        particles."""
        from tushar import scenes3d
        return scenes3d.to_pyvista(self)

    def to_yt(self) -> Any:
        """A dataset of yt, with the fields of the cells, and the particles of all materials."""
        from tushar import scenes3d
        return scenes3d.to_yt(self)


class Particles:
    """The particles of one or more materials in an output: `particles["p.density"]`, an Array."""

    def __init__(self, snapshot: Snapshot, materials: List[str], asked: Optional[str]) -> None:
        self.snapshot, self.materials, self._asked = snapshot, materials, asked

    def __len__(self) -> int:
        known = self.snapshot.materials
        return sum(known[name] for name in self.materials)

    def __repr__(self) -> str:
        return f"<{len(self)} particles of {', '.join(self.materials) or 'nothing'} at t = {self.snapshot.time:g} s>"

    @property
    def variables(self) -> List[str]:
        """Names of the variables that at least one of the materials has."""
        groups = [self.snapshot.file["particles"][name] for name in self.materials]
        return [name for name in self.snapshot.archive.variables if any(name in group for group in groups)]

    @property
    def ids(self) -> Array:
        """The permanent ids of the particles. Raises ArchiveError if the scene does not save them."""
        if ID not in self.variables:
            raise ArchiveError(NO_IDS)
        return self[ID]

    def __getitem__(self, name: str) -> Array:
        variable = self.snapshot.archive.variable(name, ("particle",))
        groups = [self.snapshot.file["particles"][material] for material in self.materials]
        parts = [group[name] for group in groups if name in group]
        if not parts:
            of = f" of material '{self._asked}'" if self._asked else ""
            raise ArchiveError(f"output {self.snapshot.index} contains no '{name}'{of}")
        return Snapshot._array(parts, variable)

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each particle, indexed by its id if ids are saved."""
        from tushar import frames
        return frames.of_particles(self)
