"""Runs scenes with several methods and resolutions, in interleaved repetitions, and collects the error and run time of
each."""
import csv
import dataclasses
import hashlib
import itertools
import json
import math
import pathlib
import re
import statistics
import tempfile
import time

from tushar.studies.change import Change
from tushar.program import SceneError, run_scene, scene_path
from tushar.studies.shorthand import SHORT


class StudyError(Exception):
    """An error in a study, described in a sentence."""


@dataclasses.dataclass(frozen=True)
class Method:
    """A scene with some of its values overridden: one line in the figures."""
    name: str
    scene: str
    sets: tuple = ()
    is_varied: bool = True  # else it runs once, as it is: what the others are compared with


@dataclasses.dataclass(frozen=True)
class Case:
    """A method with one value for each varied parameter."""
    method: Method
    varied: tuple  # of (name, value)

    def overrides(self):
        sets = list(self.method.sets)
        for name, value in self.varied:
            try:
                sets += SHORT[name](self.method.scene, value) if name in SHORT else [f"{name}={value}"]
            except ValueError as problem:
                raise StudyError(f"--vary {name}={value}: {problem}") from None
        return sets

    def key(self):
        """A key that is equal only for exactly the same scene with the same overrides."""
        text = json.dumps([self.method.name, self.method.scene, scene_text(self.method.scene), self.overrides()])
        return hashlib.sha1(text.encode()).hexdigest()[:12]


def scene_text(scene, outer=()):
    """The text of a scene and of the files that it includes; '' if it cannot be read, which sus will report."""
    path = scene_path(scene)
    try:
        text = path.read_text(errors="replace")
    except OSError:
        return ""
    included = re.findall(r"""<include\b[^>]*href\s*=\s*["']([^"']+)""", text)
    return text + "".join(scene_text(path.parent / name, (*outer, path)) for name in included if path not in outer)


class Study:
    """The cases of a study and their results; kept in study.json, so that a study can continue where it stopped."""

    def __init__(self, methods, varied, repeats, folder, sus, error):
        values = [[(name, value) for value in values] for name, values in varied.items()]
        self.cases = [Case(method, combination) for method in methods
                      for combination in (itertools.product(*values) if method.is_varied else [()])]
        self.repeats, self.error, self.change = repeats, error, Change.of(error)
        self.folder, self.sus = pathlib.Path(folder).resolve(), pathlib.Path(sus).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.runs = self._known_runs()

    def _known_runs(self):
        """Reports of earlier runs of this study, by case; those of another program are discarded."""
        path = self.folder / "study.json"
        if not path.exists():
            return {}
        known = json.loads(path.read_text())
        return known["runs"] if known.get("program") == self._program() else {}

    def _program(self):
        return hashlib.sha1(self.sus.read_bytes()).hexdigest()

    def todo(self):
        """Cases still to be run, in rounds: all cases once, then all again."""
        for repeat in range(self.repeats):
            for case in self.cases:
                if len(self.runs.get(case.key(), [])) <= repeat:
                    yield case

    def run(self, say):
        """Runs the remaining cases; calls `say(text)` with the progress."""
        left = list(self.todo())
        seconds = {}
        for number, case in enumerate(left):
            rest = sum(seconds.get(other.key(), 0) for other in left[number:])
            known = all(other.key() in seconds for other in left[number:])
            varied = " ".join(f"{name}={value}" for name, value in case.varied)
            say(f"{number + 1}/{len(left)}  {case.method.name}  {varied}" + (f"  ({rest:.0f} s left)" if known else ""))
            started = time.monotonic()
            self.runs.setdefault(case.key(), []).append(self._report(case))
            seconds[case.key()] = time.monotonic() - started
            self._save()

    def _report(self, case):
        """The report of one run of a case; for a run that fails, its message."""
        with tempfile.TemporaryDirectory(prefix="run-", dir=self.folder) as folder:
            sets = ["DataArchiver/outputInterval=0", *case.overrides()]
            try:
                report = run_scene(self.sus, case.method.scene, sets, folder)
            except SceneError as problem:
                raise StudyError(str(problem)) from None
            if report["failure"]:
                return {"died": report["failure"]}
            return report | {"change": self._change(case, folder)} if self.change else report

    def _change(self, case, folder):
        measured = self.change.measured(folder)
        if measured is None:
            raise StudyError(f"{case.method.scene} does not save {self.change.name}, or has no component "
                             f"{self.change.component}")
        return measured

    def _save(self):
        path = self.folder / "study.json.tmp"
        path.write_text(json.dumps({"program": self._program(), "error": self.error, "rows": self.rows(),
                                    "runs": self.runs}, indent=1))
        path.replace(self.folder / "study.json")

    def _error(self, report):
        if not self.change:
            return value_at(report["errors"], self.error)
        return self.change.error(report["change"], self.runs[self.cases[0].key()][0].get("change"))

    def rows(self):
        """One row for each case that has been run: error, cell width, median run time, and the orders relative to the
        previous case."""
        rows = []
        for case in self.cases:
            reports = self.runs.get(case.key())
            if not reports:
                continue
            row = {"method": case.method.name, "scene": case.method.scene, "varied": dict(case.varied)}
            if "died" in reports[0]:
                rows.append({**row, **row["varied"], "died": reports[0]["died"]})
                continue
            first = reports[0]
            row |= {"h": first["layout"]["h"], "error": self._error(first),
                    "seconds": statistics.median(report["wall"]["loop"] for report in reports),
                    "steps": first["steps"], "particle_count": first["particles"], "cells": first["layout"]["cells"],
                    "updates": first.get("updates", first["steps"] * first["layout"]["cells"]),
                    "is_refined": "updates" in first,
                    "mass_drift": first["drift"].get("mass"), "energy_drift": first["drift"].get("energy"),
                    "fingerprint": first["fingerprint"],
                    "tasks": time_by_task(reports)}
            before = rows[-1] if rows and rows[-1]["method"] == row["method"] and "h" in rows[-1] else None
            row["order"] = order(before, row)
            rows.append(row | row["varied"])
        return rows


def time_by_task(reports):
    """Task -> median over the runs of the task's time [s], and of the time that the time loop spent outside tasks."""
    walls = [report["wall"] for report in reports]
    tasks = {name: statistics.median(wall["tasks"][name] for wall in walls) for name in walls[0]["tasks"]}
    return tasks | {"between tasks": statistics.median(wall["loop"] - sum(wall["tasks"].values()) for wall in walls)}


def order(before, row):
    """Observed order of the error in the cell width h between two rows; None if there is none."""
    if before is None or before["h"] == row["h"] or not before["error"] > 0 or not row["error"] > 0:
        return None
    return math.log(before["error"] / row["error"]) / math.log(before["h"] / row["h"])


def value_at(tree, path):
    """The number at a path such as `density.cell.L1` in `errors`; raises StudyError with the available names."""
    for word in path.split("."):
        if word not in tree:
            raise StudyError(f"there is no error '{path}': at '{word}', available: {', '.join(tree) or 'nothing'}")
        tree = tree[word]
    return tree


def write_csv(rows, path):
    """Writes one line for each row; the last columns are tasks, `tasks.NAME` [s], empty if a method has no such
    task."""
    flat = [{name: value for name, value in row.items() if name not in ("tasks", "varied")} for row in rows]
    times = [{f"tasks.{name}": seconds for name, seconds in row.get("tasks", {}).items()} for row in rows]
    columns = list(dict.fromkeys(name for part in (flat, times) for row in part for name in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns)
        table.writeheader()
        table.writerows(row | tasks for row, tasks in zip(flat, times))


def write_markdown(rows, error, command, path):
    names = list(dict.fromkeys(name for row in rows for name in row["varied"]))
    refines = any(row.get("is_refined") for row in rows)
    heads = ["method", *names, "h", f"error ({error})", "order", "time loop [ms]", "steps",
             *(["cell updates"] if refines else []), "mass drift"]
    lines = [f"`{command}`", "", f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    for row in rows:
        what = " | ".join([row["method"], *(row["varied"].get(name, "") for name in names)])
        if "died" in row:
            lines.append(f"| {what} | | died | | | | |" + " |" * refines)
            continue
        rank = "" if row["order"] is None else f"{row['order']:.2f}"
        drift = "" if row["mass_drift"] is None else f"{row['mass_drift']:.1e}"
        lines.append(f"| {what} | {row['h']:g} | {row['error']:.4g} | {rank} | {1e3 * row['seconds']:.3g} "
                     f"| {row['steps']} |" + (f" {row['updates']:.3g} |" if refines else "") + f" {drift} |")
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
