"""The grid of an output."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, List

import numpy as np

from tushar.errors import ArchiveError

Values = np.ndarray[Any, Any]


@dataclass
class Grid:
    """The grid of an output; vectors are x, y, z. An axis that is not in use has one cell and one node."""
    lower: Values  # corner of the box [m]
    spacing: Values  # widths of a cell [m]
    cells: Values  # numbers of cells
    dimension: int

    @property
    def upper(self) -> Values:
        """The other corner of the box [m]."""
        return np.asarray(self.lower + self.spacing * self.cells)

    @property
    def axes(self) -> List[int]:
        """The axes in use, 0 for x to 2 for z."""
        return sorted(sorted(range(3), key=lambda axis: (self.cells[axis] <= 1, axis))[:self.dimension])

    def coordinates(self, centring: str) -> List[Values]:
        """Three arrays: the positions of the cells or nodes along x, y and z [m]."""
        lines = []
        for axis in range(3):
            at_nodes = centring == "node" and axis in self.axes
            count = self.cells[axis] + 1 if at_nodes else self.cells[axis]
            lines.append(self.lower[axis] + (np.arange(count) + (0 if at_nodes else 0.5)) * self.spacing[axis])
        return lines

    def nearest(self, centring: str, axis: int, place: float) -> int:
        """The row of cells or nodes nearest to a place along an axis [m]; ArchiveError for one outside of the grid."""
        if not self.lower[axis] <= place <= self.upper[axis]:
            raise ArchiveError(f"{'xyz'[axis]} = {place:g} m is outside of the grid, which reaches from "
                               f"{self.lower[axis]:g} to {self.upper[axis]:g} m")
        return int(np.argmin(np.abs(self.coordinates(centring)[axis] - place)))

    def __eq__(self, other: object) -> bool:
        """Whether cells and nodes lie at the same places."""
        if not isinstance(other, Grid):
            return NotImplemented
        same = [np.array_equal(self.cells, other.cells), np.allclose(self.lower, other.lower, rtol=1e-12),
                np.allclose(self.spacing, other.spacing, rtol=1e-12)]
        return self.dimension == other.dimension and all(same)
