"""Runs a scene over all combinations of values."""
from __future__ import annotations

import concurrent.futures
import itertools
import os
import pathlib
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence

from tushar.errors import CommandError, SusError
from tushar.program import Path
from tushar.runs import Run, run


@dataclass
class Point:
    """One combination of a sweep: its values by path, and the run, or the error with which it ended."""
    values: Dict[str, Any]
    run: Optional[Run] = None
    error: Optional[SusError] = None

    @property
    def report(self) -> Dict[str, Any]:
        """The report of the run, also of a failed one; {} if there is none."""
        done = self.run or (self.error.run if self.error else None)
        return done.report if done else {}

    @property
    def archive(self) -> Any:
        """The archive of the run; raises the error of a run that failed."""
        if self.error:
            raise self.error
        assert self.run is not None
        return self.run.archive

    def row(self) -> Dict[str, Any]:
        """The point's values, and the numbers of its report: steps, time, seconds, errors.*, drift.*; and failure, a
        message."""
        report = self.report
        known = {"steps": report.get("steps"), "time": report.get("time"),
                 "seconds": report.get("wall", {}).get("loop")}
        flat = {**_flat("errors", report.get("errors", {})), **_flat("drift", report.get("drift", {}))}
        return {**self.values, **known, **flat, "failure": str(self.error) if self.error else ""}


def _flat(name: str, tree: Any) -> Dict[str, Any]:
    if not isinstance(tree, dict):
        return {name: tree}
    return {path: value for key, branch in tree.items() for path, value in _flat(f"{name}.{key}", branch).items()}


class Sweep(List[Point]):
    """The points of a sweep, in the order of the combinations: the last value changes fastest."""

    @property
    def failed(self) -> List[Point]:
        return [point for point in self if point.error]

    def rows(self) -> List[Dict[str, Any]]:
        """One dictionary for each point, as described at `Point.row`."""
        return [point.row() for point in self]

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each point."""
        from tushar.errors import need
        return need("pandas", "to_pandas").DataFrame(self.rows())


def sweep(scene: Path, values: Mapping[str, Sequence[Any]], *, jobs: Optional[int] = None, ranks: int = 1,
          threads: int = 1, output: Optional[Path] = None, sets: Optional[Mapping[str, Any]] = None,
          **options: Any) -> Sweep:
    """Runs a scene with every combination of `values`, path -> values, `jobs` at a time (by default as many as the
    cores allow). `sets` are overrides for all runs. Archives are written to `output`/000, 001, …, by default to folders
    that are deleted with the sweep. A failed run becomes a point with an error; the others continue. `options` are
    those of `run`."""
    for path, several in values.items():
        if isinstance(several, str) or not hasattr(several, "__iter__"):
            raise CommandError(f"{path}: found {several!r}, expected a list of values, such as [{several!r}]")
    combinations = [dict(zip(values, chosen)) for chosen in itertools.product(*values.values())]
    common = dict(sets or {})

    def point(number: int) -> Point:
        folder = None if output is None else pathlib.Path(output, f"{number:03}")
        chosen = combinations[number]
        try:
            done = run(scene, {**common, **chosen}, ranks=ranks, threads=threads, output=folder, **options)
            return Point(chosen, done)
        except SusError as error:
            return Point(chosen, None, error)

    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    workers = jobs or max(1, cores // (ranks * threads))
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(point, number) for number in range(len(combinations))]
        try:
            return Sweep(future.result() for future in futures)
        except BaseException:
            for future in futures:
                future.cancel()
            raise
