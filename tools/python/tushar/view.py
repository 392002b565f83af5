"""The part of an output that a picture shows: variable, region and material."""
from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from tushar.archive import Archive, Variable
from tushar.errors import ArchiveError, check_name
from tushar.frames import tails
from tushar.grid import Grid, Values
from tushar.refined import levels_at
from tushar.snapshot import ID, Particles, Snapshot

Range = Tuple[Optional[float], Optional[float]]


@dataclass(frozen=True)
class View:
    """The options of a picture; None and {} select the defaults."""
    slices: Dict[int, float] = field(default_factory=dict)  # axis -> place [m]
    range: Optional[Range] = None
    log: bool = False
    cmap: Optional[str] = None
    material: Optional[str] = None
    other: Optional[Archive] = None  # the archive that is subtracted
    ranges: Dict[str, Range] = field(default_factory=dict)  # label -> range, common to the pictures of a film
    planes: Optional[Tuple[float, float, float]] = None  # where the three slices of a film are [m]
    boxes: bool = False  # outlines of the boxes of a refined grid

    def __post_init__(self) -> None:
        if self.log and self.other:
            raise ArchiveError("a difference has values below 0, so --log and --diff cannot be combined")
        limit = min((limit for limit in self.range or () if limit is not None), default=1)
        if self.log and limit <= 0:
            raise ArchiveError(f"a logarithmic scale has no place for {limit:g}: with --log, the limits of --range "
                               "must be above 0")

    def with_ranges(self, ranges: Dict[str, Range]) -> View:
        return dataclasses.replace(self, ranges=ranges)

    def with_planes(self, planes: Optional[Tuple[float, float, float]]) -> View:
        return dataclasses.replace(self, planes=planes)

    def limits(self, label: str) -> Range:
        """The smallest and the largest value shown for a label; None if they follow from the values."""
        (low, high), (least, most) = self.range or (None, None), self.ranges.get(label, (None, None))
        return least if low is None else low, most if high is None else high


@dataclass(frozen=True)
class Quantity:
    """A variable of an archive, or one component of it: `p.velocity`, `p.velocity.x`."""
    label: str
    variable: Variable
    component: Optional[int] = None

    @staticmethod
    def of(archive: Archive, label: str) -> Quantity:
        base, _, tail = label.rpartition(".")
        several = base in archive.variables and archive.variables[base].components > 1
        if label not in archive.variables and several:
            names = [name[1:] for name in tails(archive.variables[base].components)]
            check_name(f"component of {base}", tail, names)
            return Quantity(label, archive.variables[base], names.index(tail))
        if label in archive.globals:
            raise ArchiveError(f"'{label}' is a global value, which cannot be drawn on the grid; tools/uda "
                               f"{archive.folder} {label} prints it over time")
        return Quantity(label, archive.variables[check_name("variable", label, archive.variables)])

    @property
    def is_scalar(self) -> bool:
        return self.variable.components == 1 or self.component is not None

    def scalar(self, values: Values, axis: Optional[int] = None) -> Values:
        """The requested component; by default, for a vector on a line along an axis, the component along this axis,
        otherwise the magnitude."""
        if self.variable.components == 1:
            return values
        if self.component is not None:
            return np.asarray(values[..., self.component])
        if self.variable.components == 3 and axis is not None:
            return np.asarray(values[..., axis])
        return np.asarray(np.linalg.norm(values, axis=-1))


class Output:
    """An output as shown by a view. `notes` describe choices and omissions."""

    def __init__(self, snapshot: Snapshot, view: View) -> None:
        self.snapshot, self.view, self.grid = snapshot, view, snapshot.grid
        self.notes: List[str] = []
        for axis in view.slices:
            if axis not in self.grid.axes:
                used = ", ".join("xyz"[other] for other in self.grid.axes)
                raise ArchiveError(f"there is no slice at {'xyz'[axis]}: the grid has only {used}")
        if len(view.slices) >= self.grid.dimension:
            raise ArchiveError("with slices along all axes, nothing remains to draw")
        self.axes = [axis for axis in self.grid.axes if axis not in view.slices]
        if view.material:
            check_name("material", view.material, snapshot.archive.materials)
        if view.boxes and not self.grid.is_refined:
            self.notes.append("the grid has one level, so there are no boxes to draw")
        self.other = self._counterpart()

    def _counterpart(self) -> Optional[Snapshot]:
        """The output of the other archive that is nearest in time."""
        if not self.view.other:
            return None
        other = self.view.other.at(self.snapshot.time)
        if abs(other.time - self.snapshot.time) > 1e-9 * max(abs(self.snapshot.time), 1e-300):
            self.notes.append(f"the difference is relative to t = {other.time:g} s, the nearest output of "
                              f"'{self.view.other.folder}'")
        return other

    def materials_with(self, variable: Variable) -> List[str]:
        """Materials with particles that have a variable."""
        counts = self.snapshot.materials
        held = [name for name in counts if counts[name] and name in variable.materials]
        if self.view.material:
            held = [name for name in held if name == self.view.material]
        if not held:
            raise ArchiveError(f"output {self.snapshot.index} contains no '{variable.name}' of "
                               + (f"material '{self.view.material}'" if self.view.material else "any particles"))
        return held

    def particles(self, quantity: Quantity, material: str, axis: Optional[int] = None,
                  slices: Optional[Dict[int, float]] = None) -> Tuple[Values, Values]:
        """Positions (n, 3) [m] and values (n,) of the particles within half a cell of the slices."""
        own = self.snapshot.particles(material)
        x, values = own["p.x"].values, own[quantity.variable.name].values
        if self.other:
            x, values = _minus(own, self._others(material), quantity.variable.name)
        kept = np.ones(len(x), bool)
        for cut, place in (self.view.slices if slices is None else slices).items():
            self.grid.nearest("cell", cut, place)
            kept &= np.abs(x[:, cut] - place) <= self.grid.spacing[cut] / 2
        return x[kept], quantity.scalar(values[kept], axis)

    def _others(self, material: str) -> Particles:
        """The particles to be subtracted."""
        assert self.other
        if material not in self.other.materials:
            raise ArchiveError(f"'{self.other.archive.folder}' has no particles of '{material}', so there is no "
                               "difference to draw")
        here, there = self.grid, self.other.grid
        shapes = [f"{grid.levels} levels" if here == there else shape_of(grid) for grid in (here, there)]
        if here != there or here.levels != there.levels:
            raise ArchiveError(f"the grids differ, {shapes[0]} here and {shapes[1]} in '{self.other.archive.folder}', "
                               "so the particles do not correspond: choose a run with the same cells")
        return self.other.particles(material)

    def owners(self, quantity: Quantity) -> List[Optional[str]]:
        """The materials whose field is shown; None for a field that does not belong to a material."""
        materials = quantity.variable.materials
        if self.view.material and materials:
            return [check_name("material", self.view.material, materials)]
        return list(materials) or [None]

    def field(self, quantity: Quantity, owner: Optional[str], axis: Optional[int] = None,
              slices: Optional[Dict[int, float]] = None) -> Values:
        """Values of a field along the remaining axes, the last axis first: (y, x) for a plane."""
        name, centring = quantity.variable.name, quantity.variable.centring
        key = self.place(centring, slices)
        values = self.snapshot[name, owner][key]
        if self.other:
            if not self.other.grid == self.grid:
                raise ArchiveError(f"the grids differ, {shape_of(self.grid)} here and {shape_of(self.other.grid)} in "
                                   f"'{self.other.archive.folder}', so there is no difference to draw")
            values = values - self.other[name, owner][key]
        return quantity.scalar(np.asarray(values), axis)

    def place(self, centring: str, slices: Optional[Dict[int, float]] = None) -> Tuple[Any, ...]:
        """The key of the row of cells or nodes nearest to each slice; an axis that is not in use has one row."""
        cuts = self.view.slices if slices is None else slices
        rows: List[Any] = [slice(None) if axis in self.grid.axes else 0 for axis in range(3)]
        for cut, place in cuts.items():
            rows[cut] = self.grid.nearest(centring, cut, place)
        return tuple(rows[::-1])

    def cells_along(self, axis: int) -> Tuple[Values, Values, Values]:
        """For the cells of a refined grid along the only remaining axis: their centres [m], their levels, and the
        indices of finest cells; for a difference, all finest cells."""
        levels = levels_at(self.grid, self.place("cell")).ravel()
        number = np.arange(len(levels))
        width = np.where(bool(self.other), 1, 2 ** (self.grid.levels - 1 - levels))
        first = number % width == 0
        middles = self.grid.lower[axis] + (number + width / 2) * self.grid.spacing[axis]
        return middles[first], levels[first], number[first]

    def boxes(self, slices: Optional[Dict[int, float]] = None) -> List[Tuple[Values, Values]]:
        """The corners [m] of the boxes of a refined grid that slices cut."""
        cuts = self.view.slices if slices is None else slices
        rows = {cut: self.grid.nearest("cell", cut, place) for cut, place in cuts.items()}
        found = []
        for box in self.grid.boxes:
            factor = self.grid.factor(int(box[0]))
            low, high = box[1:4] * factor, box[4:] * factor
            if all(low[cut] <= row < high[cut] for cut, row in rows.items()):
                found.append((self.grid.lower + low * self.grid.spacing, self.grid.lower + high * self.grid.spacing))
        return found

    def extent(self, axis: int) -> Tuple[float, float]:
        return float(self.grid.lower[axis]), float(self.grid.upper[axis])

    def planes(self, quantity: Quantity) -> Tuple[float, float, float]:
        """The positions of the three most informative slices [m]: the middle of the grid or, for particles, the rows of
        cells with most particles."""
        if self.view.planes:
            return self.view.planes
        if quantity.variable.centring != "particle":
            return tuple(sum(self.extent(axis)) / 2 for axis in range(3))  # type: ignore[return-value]
        x = np.concatenate([self.particles(quantity, name)[0] for name in self.materials_with(quantity.variable)])
        rows = np.floor((x - self.grid.lower) / self.grid.spacing).astype(int)
        fullest = [int(np.bincount(np.clip(rows[:, axis], 0, None)).argmax()) for axis in range(3)]
        return tuple(self.grid.lower + (np.array(fullest) + 0.5) * self.grid.spacing)

    def values_of(self, quantity: Quantity) -> Values:
        """All values that a picture shows of a quantity; some may be NaN or infinite."""
        axis = self.axes[0] if len(self.axes) == 1 else None
        if quantity.variable.centring == "particle":
            parts = [self.particles(quantity, name, axis)[1] for name in self.materials_with(quantity.variable)]
        else:
            parts = [self.field(quantity, owner, axis).ravel() for owner in self.owners(quantity)]
        return np.asarray(np.concatenate(parts))


def shape_of(grid: Grid) -> str:
    return " x ".join(str(grid.cells[axis]) for axis in grid.axes) + " cells"


def _minus(own: Particles, other: Particles, name: str) -> Tuple[Values, Values]:
    """Positions and differences of the particles that both outputs have: matched by id or, without ids, one by one."""
    x, here, there = own["p.x"].values, own[name].values, other[name].values
    if ID in own.variables and ID in other.variables:
        _, mine, theirs = np.intersect1d(own.ids.values, other.ids.values, return_indices=True)
        return x[mine], here[mine] - there[theirs]
    if len(here) != len(there):
        raise ArchiveError(f"{len(here)} particles in one archive and {len(there)} in the other: a difference needs "
                           f"{ID} in both")
    return x, here - there
