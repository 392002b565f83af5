"""Reads the files of global quantities, which have one line for each step: the time [s] and the values."""
from __future__ import annotations

import os
from typing import List, Union

from tushar.errors import ArchiveError


def rows_of(path: Union[str, "os.PathLike[str]"]) -> List[List[float]]:
    """The numbers in each line, without an incomplete last line that a run is still writing. Raises OSError if there is
    no file, and ArchiveError if a word is not a number."""
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [(number, line.split()) for number, line in enumerate(file, 1)
                 if line.endswith("\n") and not line.startswith("#")]
    count = len(lines[0][1]) if lines else 0
    return [_numbers(words, path, number) for number, words in lines if len(words) == count]


def _numbers(words: List[str], path: Union[str, "os.PathLike[str]"], line: int) -> List[float]:
    """The words of a line as numbers."""
    numbers: List[float] = []
    for word in words:
        try:
            numbers.append(float(word))
        except ValueError:
            raise ArchiveError(f"{os.fspath(path)}:{line}: found '{word}', expected a number") from None
    return numbers
