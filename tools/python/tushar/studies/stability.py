"""Runs the gallery of hard cases over methods and time steps, and judges the results."""
import hashlib
import json
import math
import pathlib
import tempfile

from tushar.studies import scene_variants
from tushar.dat import rows_of
from tushar.program import run_scene
from tushar.studies.study import value_at

GLOBALS = ("LeastDensity", "LeastInternalEnergy", "TotalEntropy", "TotalMass")
DRIFT = 1e-11  # relative, of what a case keeps
FALL = 1e-9  # of the entropy over c_v and the mass, from start to end
GREATEST_FACTOR, CLOSE = 16, 1.05  # of the search for the largest time step
WALL = 600  # s, for a run


def scene_of(case, method):
    """The scene of a case for a method."""
    root = scene_variants.read(case.path())
    scene_variants.resolve_files(root, case.path().parent)
    if method.change:
        method.change(root)
    return root


def write_scene(case, method, path):
    """Writes the scene of a case as a method runs it, without its reference solution."""
    root = scene_of(case, method)
    for text in sets_of(case, method):
        scene_variants.override(root, text)
    for analysis in root.findall("DataAnalysis"):
        root.remove(analysis)
    scene_variants.write(root, pathlib.Path(path))


def sets_of(case, method):
    """The overrides with which that scene is run."""
    return [*method.sets, *case.sets]


class Gallery:
    """Runs of cases by methods; kept in a file, so that an interrupted gallery continues where it stopped. Runs of
    another program, and of scenes that have changed since, are forgotten."""

    def __init__(self, folder, sus):
        self.folder, self.sus = pathlib.Path(folder).resolve(), pathlib.Path(sus).resolve()
        (self.folder / "scenes").mkdir(parents=True, exist_ok=True)
        self.program = hashlib.sha1(self.sus.read_bytes()).hexdigest()
        self.file = self.folder / "runs.json"
        self.runs = self._known_runs()

    def _known_runs(self):
        """Results of earlier runs; none if the file is damaged."""
        try:
            known = json.loads(self.file.read_text())
            return known["runs"] if known["program"] == self.program else {}
        except (OSError, ValueError, KeyError, TypeError):
            return {}

    def scene(self, case, method):
        """Writes the scene of a case for a method to a place where it can be run again by hand."""
        root = scene_of(case, method)
        if root.find("SimulationComponent").get("type") not in ("heat", "impm"):
            scene_variants.save(root, *GLOBALS)
        path = self.folder / "scenes" / f"{case.name}-{method.name}.ups"
        scene_variants.write(root, path)
        return path

    def run(self, case, method, factor=1.0):
        """The result of running a case with a method, with a multiple of the method's own time step."""
        scene = self.scene(case, method)
        sets = [*sets_of(case, method), f"Time/timestep_multiplier={factor!r}", f"Time/max_wall_time={WALL}"]
        key = hashlib.sha1(json.dumps([scene.read_text(), sets]).encode()).hexdigest()[:12]
        if key not in self.runs:
            self.runs[key] = self._measure(scene, sets, case)
            self._save()
        return self.runs[key]

    def _measure(self, scene, sets, case):
        with tempfile.TemporaryDirectory(prefix="run-", dir=self.folder) as folder:
            report = run_scene(self.sus, scene, sets, folder)
            totals = {path.stem: [row[1] for row in rows_of(path)]
                      for path in pathlib.Path(folder).glob("*.uda.000/*.dat")}
        return measured(report, totals, case)

    def _save(self):
        path = self.file.with_suffix(".tmp")
        path.write_text(json.dumps({"program": self.program, "runs": self.runs}, indent=1))
        path.replace(self.file)

    def largest_factor(self, case, method, say):
        """The largest factor for the time step, at most 16 and accurate to 5 %, with which the run completes and its
        error is less than twice the error with factor 1. None if there is no such factor."""
        first = self.run(case, method)
        if first.get("failure"):
            return None
        good, bad = 1.0, None
        while bad is None or bad > CLOSE * good:
            factor = 2 * good if bad is None else math.sqrt(good * bad)
            if factor > GREATEST_FACTOR:
                return good
            say(f"{case.name}  {method.name}  time step x {factor:.3g}")
            if is_stable(self.run(case, method, factor), first):
                good = factor
            else:
                bad = factor
        return good


def error_of(case, errors):
    """The path in a report to the error of a case; if a method has no particle error, the L2 norm over cells."""
    variable, where, norm = case.error.split(".")
    has_it = where != "particle" or where in errors.get(variable, {})
    return case.error if has_it else f"{variable}.cell.L2"


def measured(report, totals, case):
    """The relevant part of a report."""
    if "steps" not in report:
        return {"failure": report["failure"], "steps": 0}
    result = {"failure": report.get("failure", ""), "steps": report["steps"], "retries": report["retries"],
              "limits": report["time_step_limits"], "seconds": report["wall"]["loop"], "ended": report["ended"],
              "mass": report["drift"].get("mass"), "momentum": report["drift"].get("momentum"),
              "energy": report["drift"].get("energy"), "fingerprint": report["fingerprint"]}
    if case.error and not result["failure"]:
        result["error"] = value_at(report["errors"], error_of(case, report["errors"]))
    for name, label in (("least_density", "LeastDensity"), ("least_energy", "LeastInternalEnergy")):
        if totals.get(label):
            result[name] = min(totals[label])
    if totals.get("TotalEntropy"):
        entropy = [s / m for s, m in zip(totals["TotalEntropy"], totals["TotalMass"])]
        result["entropy"] = entropy[-1] - entropy[0]
        result["entropy_fall"] = max([0.0, *(a - b for a, b in zip(entropy, entropy[1:]))])
    return result


def is_stable(run, first):
    """Whether a run completes with at most twice the error of another."""
    if run["failure"] or run["ended"] != "maxTime":
        return False
    return "error" not in first or run["error"] <= 2 * max(first["error"], 1e-12)


def judge(run, case, isOurs):
    """`pass`, or the bound that a run violates. The error counts only for the default method: others have no bound."""
    if case.fails:
        return ["pass"] if case.fails in run["failure"] else ["did not fail as it should"]
    if run["failure"]:
        return ["died"]
    broken = [] if run["ended"] == "maxTime" else [run["ended"]]
    if isOurs and case.most is not None and not run["error"] <= case.most:
        broken.append(f"error above {case.most:g}")
    for name in case.keeps:
        if not abs(run[name]) <= DRIFT:
            broken.append(f"{name} drifts")
    for name in ("least_density", "least_energy"):
        if name in run and not run[name] > 0:
            broken.append(f"{name.replace('_', ' ')} not positive")
    if case.entropy and not run["entropy"] >= -FALL:
        broken.append("entropy falls")
    return broken or ["pass"]


def row_of(case, method, run, factor):
    return {"case": case.name, "method": method.name, "verdict": judge(run, case, method.name == "default"),
            "largest_factor": factor, **run}


def number(value, form=".3g"):
    return "" if value is None else format(value, form)


def write_markdown(rows, command, path):
    lines = [f"`{command}`", "",
             "| case | method | verdict | error | least density | least energy | mass drift | momentum drift "
             "| energy drift | entropy rises by | greatest fall in a step | steps | repeated | time loop [s] "
             "| largest factor |", "|" + "---|" * 15]
    for row in rows:
        cells = [row["case"], row["method"], ", ".join(row["verdict"]), number(row.get("error")),
                 number(row.get("least_density")), number(row.get("least_energy")), number(row.get("mass"), ".1e"),
                 number(row.get("momentum"), ".1e"), number(row.get("energy"), ".1e"),
                 number(row.get("entropy"), ".1e"),
                 number(row.get("entropy_fall"), ".1e"), row["steps"],
                 row.get("retries", ""), number(row.get("seconds"), ".2g"), number(row.get("largest_factor"))]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    died = [row for row in rows if row["failure"]]
    lines += ["", *(f"- {row['case']}, {row['method']}: {first_sentence(row['failure'])}" for row in died)]
    pathlib.Path(path).write_text("\n".join(lines).rstrip() + "\n")


def first_sentence(failure):
    """The reason why a run failed, without surrounding values and advice."""
    text = failure.removeprefix("sus: ")
    place = text[text.rfind("(task"):].split(")")[0] + ")" if "(task" in text else ""
    return f"{text.split('; around it')[0].split(' (task')[0]} {place}".strip()
