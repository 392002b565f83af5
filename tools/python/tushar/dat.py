"""Reads the files of global quantities, which have one line for each step: the time [s] and the values."""
from __future__ import annotations

import os
from typing import List, Union


def rows_of(path: Union[str, "os.PathLike[str]"]) -> List[List[float]]:
    """The numbers in each line, without an incomplete last line that a run is still writing. Raises OSError if there is
    no file."""
    with open(path, encoding="utf-8") as file:
        lines = [line.split() for line in file if line.endswith("\n") and not line.startswith("#")]
    count = len(lines[0]) if lines else 0
    return [[float(word) for word in line] for line in lines if len(line) == count]
