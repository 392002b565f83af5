"""Arrays of an archive that are read only when their values are used, and only the part that is used."""
from __future__ import annotations

from typing import Any, Sequence, Tuple

import h5py
import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin


class Array(NDArrayOperatorsMixin):
    """Values of a variable that remain on the disk until they are used: `array[::10]` reads every tenth row,
    `array.values` all.

    It supports arithmetic and numpy's functions, which return plain numpy arrays. Particles of several materials are
    concatenated in the order of the scene. `unit` is the unit in the archive, such as `kg/m^3`; `1` if dimensionless.
    """

    def __init__(self, parts: Sequence[h5py.Dataset], name: str = "", unit: str = "", description: str = "") -> None:
        self._parts = list(parts)
        self.name, self.unit, self.description = name, unit, description
        self.shape: Tuple[int, ...] = (sum(len(part) for part in self._parts), *self._parts[0].shape[1:])
        self.dtype: np.dtype[Any] = self._parts[0].dtype

    @property
    def ndim(self) -> int:
        return len(self.shape)

    @property
    def size(self) -> int:
        return int(np.prod(self.shape))

    @property
    def values(self) -> np.ndarray[Any, Any]:
        """All values; reads them now."""
        if len(self._parts) == 1:
            return np.asarray(self._parts[0][()])
        return np.concatenate([part[()] for part in self._parts])

    def __len__(self) -> int:
        return self.shape[0]

    def __repr__(self) -> str:
        unit = f" [{self.unit}]" if self.unit else ""
        return f"<Array {self.name}{unit}, shape {self.shape}, {self.dtype}, not read yet>"

    def __getitem__(self, key: Any) -> Any:
        """Like numpy's indexing of the whole array, but slices and numbers read only the selected values."""
        if not is_basic(key):
            return self.values[key]
        if any(runs_backwards(item) for item in (key if isinstance(key, tuple) else (key,))):
            return self.values[key]
        if len(self._parts) == 1:
            return self._parts[0][key]
        return self._of_several(key if isinstance(key, tuple) else (key,))

    def _of_several(self, key: Tuple[Any, ...]) -> Any:
        if not key or key[0] is Ellipsis:
            return self.values[key]
        first, rest = key[0], key[1:]
        if not isinstance(first, slice):
            part, row = self._row(int(first))
            return part[(row, *rest)]
        start, stop, step = first.indices(len(self))
        found, begin = [], 0
        for part in self._parts:
            end = begin + len(part)
            low = start if start >= begin else start + -(-(begin - start) // step) * step
            if low < min(stop, end):
                found.append(part[(slice(low - begin, min(stop, end) - begin, step), *rest)])
            begin = end
        return np.concatenate(found) if found else self._parts[0][(slice(0, 0), *rest)]

    def _row(self, row: int) -> Tuple[h5py.Dataset, int]:
        """The part that contains a row, and the index of the row in it."""
        if not -len(self) <= row < len(self):
            raise IndexError(f"row {row} of {len(self)}")
        row %= len(self)
        for part in self._parts:
            if row < len(part):
                break
            row -= len(part)
        return part, row

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray[Any, Any]:
        return self.values if dtype is None else self.values.astype(dtype)

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **options: Any) -> Any:
        return getattr(ufunc, method)(*[item.values if isinstance(item, Array) else item for item in inputs], **options)

    def __getattr__(self, name: str) -> Any:
        """Other attributes of numpy's arrays, such as `max()`, `mean(axis=0)` and `T`: they apply to all values, which
        are read now."""
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self.values, name)


def is_basic(key: Any) -> bool:
    """Whether a key contains only numbers, slices and `...`."""
    items = key if isinstance(key, tuple) else (key,)
    return all(item is Ellipsis or isinstance(item, (int, np.integer, slice)) and not isinstance(item, bool)
               for item in items)


def runs_backwards(item: Any) -> bool:
    """Whether an item of a key is a slice with a negative step."""
    return isinstance(item, slice) and item.step is not None and item.step < 0
