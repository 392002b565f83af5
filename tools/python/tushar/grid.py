"""The grid of an output."""
from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, List

import numpy as np

from tushar.errors import ArchiveError

Values = np.ndarray[Any, Any]


@dataclass
class Grid:
    """The grid of an output; vectors have components x, y, z. An axis that is not in use has one cell and one node.

    On a refined grid, `spacing` and `cells` are those of the finest of its `levels`, as if the whole grid were that
    fine; `boxes` has a row for each box of cells: level, 0 the coarsest, then lower x, y, z and upper x, y, z in cells
    of that level. The boxes tile the domain. On a single level there are no boxes.

    If a single level consists of several boxes, `inside` has a row for each: lower x, y, z, upper x, y, z, in cells.
    Values of cells and nodes outside them are 0."""
    lower: Values  # corner of the box [m]
    spacing: Values  # widths of a cell [m]
    cells: Values  # numbers of cells
    dimension: int
    boxes: Values = field(default_factory=lambda: np.zeros((0, 7), int))
    levels: int = 1
    inside: Values = field(default_factory=lambda: np.zeros((0, 6), int))

    @property
    def upper(self) -> Values:
        """The upper corner of the box [m]."""
        return np.asarray(self.lower + self.spacing * self.cells)

    @property
    def axes(self) -> List[int]:
        """The axes in use, 0 for x to 2 for z."""
        return sorted(sorted(range(3), key=lambda axis: (self.cells[axis] <= 1, axis))[:self.dimension])

    @property
    def is_refined(self) -> bool:
        """Whether the output consists of boxes on several levels."""
        return len(self.boxes) > 0

    def factor(self, level: int) -> Values:
        """Number of finest cells along x, y and z in a cell of a level."""
        used = [axis in self.axes for axis in range(3)]
        return np.where(used, 2 ** (self.levels - 1 - level), 1)

    def level(self, number: int) -> Grid:
        """The uniform grid with the cells of a level; for levels beyond the finest, cells are halved further."""
        if number < 0:
            raise ArchiveError(f"no level {number}: the coarsest is 0, the finest {self.levels - 1}")
        shift = np.where(np.isin(range(3), self.axes), number + 1 - self.levels, 0)
        cells = np.where(shift < 0, self.cells >> np.maximum(-shift, 0), self.cells << np.maximum(shift, 0))
        return Grid(self.lower, np.ldexp(self.spacing, -shift), cells, self.dimension)

    def mask(self, centring: str) -> Values:
        """Whether each cell or node, z, y, x, belongs to the grid, or is outside the boxes of which it consists."""
        nodes = [centring == "node" and axis in self.axes for axis in range(3)]
        shape = tuple(self.cells[axis] + nodes[axis] for axis in (2, 1, 0))
        mask = np.full(shape, len(self.inside) == 0)
        for row in self.inside:
            mask[tuple(slice(row[axis], row[axis + 3] + nodes[axis]) for axis in (2, 1, 0))] = True
        return mask

    @property
    def counts(self) -> List[int]:
        """The number of cells of each level, the coarsest first."""
        if not self.is_refined:
            return [int(np.count_nonzero(self.mask("cell")))] if len(self.inside) else [int(np.prod(self.cells))]
        sizes = np.prod(self.boxes[:, 4:] - self.boxes[:, 1:4], axis=1)
        return [int(sizes[self.boxes[:, 0] == level].sum()) for level in range(self.levels)]

    def coordinates(self, centring: str) -> List[Values]:
        """Three arrays: the positions of the cells or nodes along x, y and z [m]."""
        lines = []
        for axis in range(3):
            at_nodes = centring == "node" and axis in self.axes
            count = self.cells[axis] + 1 if at_nodes else self.cells[axis]
            lines.append(self.lower[axis] + (np.arange(count) + (0 if at_nodes else 0.5)) * self.spacing[axis])
        return lines

    def nearest(self, centring: str, axis: int, place: float) -> int:
        """The row of cells or nodes nearest to a coordinate along an axis [m]; raises ArchiveError if it is outside the
        grid."""
        if not self.lower[axis] <= place <= self.upper[axis]:
            raise ArchiveError(f"{'xyz'[axis]} = {place:g} m is outside the grid, which extends from "
                               f"{self.lower[axis]:g} to {self.upper[axis]:g} m")
        return int(np.argmin(np.abs(self.coordinates(centring)[axis] - place)))

    def __eq__(self, other: object) -> bool:
        """Whether cells and nodes have the same positions."""
        if not isinstance(other, Grid):
            return NotImplemented
        same = [np.array_equal(self.cells, other.cells), np.allclose(self.lower, other.lower, rtol=1e-12),
                np.allclose(self.spacing, other.spacing, rtol=1e-12)]
        return self.dimension == other.dimension and all(same)
