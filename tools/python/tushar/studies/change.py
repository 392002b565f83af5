"""Errors computed from a saved global quantity: its change, compared with that of another run or with a number."""
import dataclasses
import pathlib
import re

from tushar.dat import rows_of


@dataclasses.dataclass(frozen=True)
class Change:
    """`change.NAME[k]=VALUE`: the k-th component of a global quantity (by default the first), and the expected change;
    by default, the change in the first run of the study. `last.NAME[k]=VALUE`: the same for the last value instead of
    the mean over the last quarter of the time. `end.NAME[k]=VALUE`: the last value itself."""
    name: str
    component: int = 0
    value: float = None
    takes_last: bool = False
    from_zero: bool = False

    @staticmethod
    def of(text):
        """Parses `text`; returns None if it names an error norm of the report instead."""
        found = re.fullmatch(r"(change|last|end)\.(\w+)(?:\[(\d)\])?(?:=(\S+))?", text)
        if not found:
            return None
        kind, name, component, value = found.groups()
        return Change(name, int(component or 0), None if value is None else float(value), kind != "change",
                      kind == "end")

    def measured(self, folder):
        """Mean over the last quarter of the simulated time, or the last value, minus the first value unless it counts
        from zero. The mean is the final value whether the run oscillates about it or has come to rest. None where the
        run has not saved the global."""
        files = sorted(pathlib.Path(folder).glob(f"*.uda.*/{self.name}.dat"))
        lines = rows_of(files[-1]) if files else []
        if not lines or len(lines[0]) <= 1 + self.component:
            return None
        values = [(line[0], line[1 + self.component]) for line in lines]
        if self.takes_last:
            return values[-1][1] - (0 if self.from_zero else values[0][1])
        start, end = values[0][0], values[-1][0]
        late = [value for time, value in values if time >= end - (end - start) / 4]
        return sum(late) / len(late) - values[0][1]

    def error(self, measured, first):
        """The relative error, |measured / expected - 1|."""
        return abs(measured / (first if self.value is None else self.value) - 1)
