"""Fields on the cells of a refined grid."""
from __future__ import annotations

from typing import Any, Callable, List, Sequence, Tuple

import h5py
import numpy as np

from tushar.arrays import Array, is_basic, runs_backwards
from tushar.grid import Grid, Values


class Box:
    """A box of cells on one level of a refined grid; vectors have components x, y, z. Its values are read when they are
    used."""

    def __init__(self, grid: Grid, row: int, read: Callable[[int], Values]) -> None:
        numbers = grid.boxes[row]
        self.level = int(numbers[0])
        self.first: Values = numbers[1:4]  # its first cell, counted in cells of its level from the corner of the domain
        self.cells: Values = numbers[4:] - numbers[1:4]  # numbers of cells
        self.spacing: Values = grid.spacing * grid.factor(self.level)  # widths of a cell [m]
        self.lower: Values = grid.lower + self.spacing * self.first  # corners [m]
        self.upper: Values = grid.lower + self.spacing * (self.first + self.cells)
        self._row, self._read = row, read

    def __repr__(self) -> str:
        size = " x ".join(map(str, self.cells))
        return f"<Box of {size} cells of level {self.level} from {self.lower} to {self.upper} m>"

    @property
    def values(self) -> Values:
        """Values of the box's cells (z, y, x) or (z, y, x, components); reads them now."""
        return self._read(self._row)

    def centres(self) -> Values:
        """The centres of the box's cells, x fastest (n, 3) [m]."""
        lines = [self.lower[axis] + (np.arange(self.cells[axis]) + 0.5) * self.spacing[axis] for axis in range(3)]
        z, y, x = np.meshgrid(*lines[::-1], indexing="ij")
        return np.column_stack([x.ravel(), y.ravel(), z.ravel()])


class Refined(Array):
    """A field on the cells of a refined grid. As an array, it has a value for each cell of the finest level, so values
    of coarser cells are repeated; a slice reads only the boxes that it touches. `boxes` contain the actual cells."""

    def __init__(self, data: h5py.Dataset, grid: Grid, name: str = "", unit: str = "", description: str = "") -> None:
        super().__init__([data], name, unit, description)
        self.grid = grid
        self._first = np.concatenate([[0], np.cumsum(np.prod(grid.boxes[:, 4:] - grid.boxes[:, 1:4], axis=1))])
        self.shape: Tuple[int, ...] = (*map(int, grid.cells[::-1]), *data.shape[1:])

    @property
    def values(self) -> Values:
        return np.asarray(self[...])

    @property
    def cell_values(self) -> Values:
        """Values of all actual cells, box by box: (n,) or (n, components); reads them now."""
        return np.asarray(self._parts[0][()])

    @property
    def boxes(self) -> List[Box]:
        """The boxes of cells; together they cover the domain without overlap."""
        return [Box(self.grid, row, self._read) for row in range(len(self.grid.boxes))]

    @property
    def levels(self) -> List[Grid]:
        """The uniform grids of all levels, the coarsest first."""
        return [self.grid.level(number) for number in range(self.grid.levels)]

    def level(self, number: int) -> Values:
        """Values on a uniform grid with the cells of a level: means of finer cells, and repeated values of coarser
        ones."""
        target = self.grid.level(number)
        found = np.zeros((*target.cells[::-1], *self.shape[3:]))
        for box in self.boxes:
            values, place = box.values, []
            for axis in range(3):
                low, high = int(box.first[axis]), int(box.first[axis] + box.cells[axis])
                values, low, high = _onto(values, 2 - axis, low, high, box.spacing[axis] / target.spacing[axis])
                place.append(slice(low, high))
            found[tuple(place[::-1])] += values
        return found

    def __getitem__(self, key: Any) -> Any:
        items = key if isinstance(key, tuple) else (key,)
        if not is_basic(key) or any(map(runs_backwards, items)) or items.count(Ellipsis) > 1:
            return self.values[key]
        items = _all_axes(items, self.ndim)
        found = sampled(self.grid, items[:3], self._read, self.dtype, self.shape[3:])
        kept = tuple(slice(None) if isinstance(item, slice) else 0 for item in items[:3])
        return found[(*kept, *items[3:])]

    def _read(self, row: int) -> Values:
        first, last = self._first[row:row + 2]
        cells = self.grid.boxes[row, 4:] - self.grid.boxes[row, 1:4]
        return np.asarray(self._parts[0][first:last]).reshape(*cells[::-1], *self.shape[3:])


def sampled(grid: Grid, key: Sequence[Any], read: Callable[[int], Values], kind: Any,
            tail: Tuple[int, ...] = ()) -> Values:
    """Values at the finest cells selected by a key (z, y, x) of numbers and slices; a number selects an axis of length
    one. `read(row)` returns the values of the box in that row."""
    rows = [_selected(item, int(count)) for item, count in zip(key, grid.cells[::-1])]
    found = np.empty((*map(len, rows), *tail), kind)
    for number, box in enumerate(grid.boxes):
        factor = grid.factor(int(box[0]))[::-1]
        ends = zip(rows, box[1:4][::-1] * factor, box[4:][::-1] * factor)
        parts = [slice(*np.searchsorted(line, (low, high))) for line, low, high in ends]
        if all(part.start < part.stop for part in parts):
            cells = [line[part] // f - low for line, part, f, low in zip(rows, parts, factor, box[1:4][::-1])]
            found[tuple(parts)] = read(number)[np.ix_(*cells)]
    return found


def levels_at(grid: Grid, key: Sequence[Any]) -> Values:
    """The level of the actual cell at each finest cell selected by a key."""
    def read(row: int) -> Values:
        return np.full((grid.boxes[row, 4:] - grid.boxes[row, 1:4])[::-1], grid.boxes[row, 0])

    return sampled(grid, key, read, int)


def cells_of(grid: Grid) -> Tuple[Values, Values]:
    """Centres (n, 3) [m] and levels (n,) of all cells of a refined grid, box by box."""
    boxes = [Box(grid, row, lambda row: np.zeros(0)) for row in range(len(grid.boxes))]
    levels = [np.full(int(np.prod(box.cells)), box.level) for box in boxes]
    return np.concatenate([box.centres() for box in boxes]), np.concatenate(levels)


def _selected(item: Any, count: int) -> Values:
    """The indices that a number or a slice selects on an axis of a given length."""
    if isinstance(item, slice):
        return np.arange(count)[item]
    if not -count <= item < count:
        raise IndexError(f"row {item} of {count}")
    return np.array([item % count])


def _all_axes(items: Tuple[Any, ...], axes: int) -> Tuple[Any, ...]:
    """A key completed to one item for each axis."""
    if Ellipsis in items:
        at = items.index(Ellipsis)
        items = (*items[:at], *[slice(None)] * (axes + 1 - len(items)), *items[at + 1:])
    if len(items) > axes:
        raise IndexError(f"{len(items)} indices for {axes} axes")
    return (*items, *[slice(None)] * (axes - len(items)))


def _onto(values: Values, axis: int, low: int, high: int, ratio: float) -> Tuple[Values, int, int]:
    """Values along an axis, and the cells [low, high) that they fill, in cells that are smaller or larger by a ratio;
    in larger cells, their contribution to the mean."""
    if ratio >= 1:
        times = round(ratio)
        return np.repeat(values, times, axis), low * times, high * times
    joined = round(1 / ratio)
    starts = np.flatnonzero(np.diff(np.arange(low, high) // joined, prepend=-1))
    return np.add.reduceat(values, starts, axis) / joined, low // joined, -(-high // joined)
