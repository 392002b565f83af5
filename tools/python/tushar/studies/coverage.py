"""Runs every scene in a folder, and reports which ones run, which are refused and why, and how long each takes."""
import concurrent.futures
import dataclasses
import json
import math
import os
import pathlib
import re
import signal
import subprocess
import tempfile
import threading
import time

from tushar.program import SceneError
from tushar.runs import read_report

COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
TYPE = re.compile(r"<SimulationComponent[^>]*?\btype\s*=\s*[\"']\s*([^\"']*?)\s*[\"']")
NUMBER = re.compile(r"\s*\[(T\d+)\]\s*$")
PLACE = re.compile(r"^(.+?:\d+(?::\d+)?): ")
REFUSED, SIGNALLED = 3, 5  # exit codes of sus
GRACE = 10  # s, in which a run that has reached its limit may write its output
LONGEST = 130  # characters of a sentence in tables
GRAIN = .01  # s, between two looks at a run


@dataclasses.dataclass(frozen=True)
class Scene:
    """A scene file that can be run. `name` is its path relative to the folder."""
    name: str
    path: pathlib.Path
    type: str


@dataclasses.dataclass(frozen=True)
class Settings:
    """How scenes are run. Each may take `limit` [s] of wall time and `work` [s] of processor time; with `check`, scenes
    are only read."""
    sus: str
    limit: float
    work: float = math.inf
    sets: tuple = ()
    threads: int = 1
    check: bool = False


@dataclasses.dataclass
class Outcome:
    """The outcome of a scene: `ran`, `stopped` at the limit, `refused` or `failed`. Times in s; `time` is how far it
    came."""
    scene: str
    type: str
    result: str
    code: int
    wall: float
    processor: float
    steps: int = 0
    time: float = 0
    particles: int = 0
    cells: int = 0
    notes: int = 0
    problems: list = dataclasses.field(default_factory=list)


def type_of(path):
    """The component of a scene, in lower case; empty for a file that is not a scene."""
    found = TYPE.search(COMMENT.sub("", path.read_text(encoding="utf-8", errors="replace")))
    return found[1].lower() if found else ""


def scenes_of(folder, types=()):
    """The scenes below a folder, of the given types or of all, and the numbers of skipped files by kind. Raises
    SceneError where none is left."""
    folder = pathlib.Path(folder).resolve()
    if not folder.is_dir():
        raise SceneError(f"there is no folder '{folder}'")
    files = sorted(path for path in folder.rglob("*.ups") if path.is_file())
    own = [path for path in files if not (path.is_symlink() and folder in path.resolve().parents)]
    found = [Scene(path.relative_to(folder).as_posix(), path, type_of(path)) for path in own]
    scenes = [scene for scene in found if scene.type]
    wanted = [scene for scene in scenes if not types or scene.type in types]
    if not wanted:
        known = ", ".join(sorted({scene.type for scene in scenes}))
        raise SceneError(f"'{folder}' has no scene" + (f" of type {' or '.join(types)}; there are {known}" if known
                                                       else ""))
    return wanted, {"links to other scenes of the folder": len(files) - len(own),
                    "files that name no component": len(found) - len(scenes)}


def problems_of(said):
    """The messages with which sus ended, each kind once, without notes and advice. A value that a sentence repeats may
    have several lines."""
    problems = []
    for line in said.splitlines():
        place = PLACE.match(line)
        if place or line.startswith("sus: "):
            text = line[place.end():] if place else line.removeprefix("sus: ")
            problems.append({"sentence": text, "number": "", "place": place[1] if place else ""})
        elif problems and not problems[-1]["number"] and not line.startswith(("note: ", "tushar: ", "     ")):
            problems[-1]["sentence"] += " " + line.strip()
        else:
            continue
        number = NUMBER.search(problems[-1]["sentence"])
        if number:
            problems[-1].update(sentence=problems[-1]["sentence"][:number.start()], number=number[1])
    kinds = {short(problem["sentence"]): problem for problem in reversed(problems)
             if not problem["place"].startswith("note: ")}
    return list(reversed(kinds.values()))


def result_of(code, limited):
    """The meaning of an exit code; a run that was stopped may have ended by itself."""
    if code == 0:
        return "ran"
    if limited:
        return "stopped"
    return "refused" if code == REFUSED else "failed"


class Runner:
    """Runs scenes, `jobs` at a time. Their files are written to a temporary folder, which is deleted."""

    def __init__(self, settings, jobs=1):
        self.settings, self.jobs, self._stop = settings, jobs, threading.Event()

    def run(self, scenes, tell):
        """Runs all scenes. Calls `tell` with each outcome as it arrives, the number of outcomes, and all outcomes so
        far in the order of the scenes. An early end, for example by Ctrl-C, also ends the runs."""
        outcomes = {}
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            waiting = {pool.submit(self.run_scene, scene): scene for scene in scenes}
            try:
                for done in concurrent.futures.as_completed(waiting):
                    outcomes[waiting[done].name] = done.result()
                    tell(done.result(), len(outcomes), [outcomes[s.name] for s in scenes if s.name in outcomes])
            except BaseException:
                self._stop.set()
                pool.shutdown(cancel_futures=True)
                raise

    def run_scene(self, scene):
        """Runs one scene."""
        with tempfile.TemporaryDirectory(prefix="coverage-") as folder:
            said = pathlib.Path(folder, "said.txt")
            started = time.monotonic()
            with open(said, "wb") as errors:
                process = subprocess.Popen(self._command(scene, folder), stdin=subprocess.DEVNULL,
                                           stdout=subprocess.DEVNULL, stderr=errors, start_new_session=True)
                limited, usage = self._wait(process, started)
            wall = time.monotonic() - started
            return self._outcome(scene, process.returncode, limited,
                                 (wall, usage.ru_utime + usage.ru_stime), pathlib.Path(folder))

    def _command(self, scene, folder):
        words = [self.settings.sus, str(scene.path), "--nthreads", str(self.settings.threads), "--output", folder]
        for override in self.settings.sets:
            words += ["--set", override]
        return [*words, "--check"] if self.settings.check else [*words, "--json", os.path.join(folder, "report.json")]

    def _wait(self, process, started):
        """Waits until the run ends; stops it when its time limit is exceeded, if necessary by force. Returns whether it
        was stopped, and the resources that the process has used."""
        told = None
        while True:
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
            if ended:
                process.returncode = os.waitstatus_to_exitcode(status)
                return told is not None, usage
            now = time.monotonic()
            is_over = now - started > self.settings.limit or work_of(process.pid) > self.settings.work
            if told is None and (is_over or self._stop.is_set()):
                process.send_signal(signal.SIGTERM)
                told = now
            elif told is not None and now - told > (0 if self._stop.is_set() else GRACE):
                os.killpg(process.pid, signal.SIGKILL)
            time.sleep(GRAIN)

    def _outcome(self, scene, code, limited, seconds, folder):
        above = str(scene.path).removesuffix(scene.name)
        said = (folder / "said.txt").read_text(errors="replace").replace(above, "")
        report = read_report(folder) or {}
        outcome = Outcome(scene.name, scene.type, result_of(code, limited), code, *seconds)
        outcome.notes = sum(line.startswith("note: ") for line in said.splitlines())
        outcome.steps, outcome.time = report.get("steps", 0), report.get("time", 0)
        outcome.particles, outcome.cells = report.get("particles", 0), report.get("layout", {}).get("cells", 0)
        if outcome.result == "stopped":
            outcome.problems = [{"sentence": stopped_after(outcome, report), "number": "", "place": ""}]
        elif outcome.result != "ran":
            outcome.problems = problems_of(said) or [{"sentence": ended_by(code), "number": "", "place": ""}]
        return outcome


def work_of(pid):
    """Processor time that a process has used [s]; 0 if the system does not report it."""
    try:
        words = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0
    return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")


def stopped_after(outcome, report):
    """The time at which a run was stopped and, if it wrote a report, the simulated time reached."""
    far = f" at t = {report['time']:.4g} s" if report.get("steps") else ""
    return f"stopped after {outcome.wall:.0f} s, {outcome.processor:.0f} s of processor time,{far}".rstrip(",")


def ended_by(code):
    """The reason why a program ended without a message."""
    return f"ended by signal {-code}" if code < 0 else f"ended with exit code {code}, without a message"


def short(sentence):
    """The first part of a message, without allowed values, advice and line numbers."""
    text = re.sub(r" on line \d+| of \S+:\d+:\d+(?= is still open)", "", sentence.split(";")[0])
    return text if len(text) <= LONGEST else text[:LONGEST].rsplit(" ", 1)[0].rstrip(",") + " …"


def reason_of(outcome):
    """The first message, and its code; empty for a scene that ran."""
    if not outcome.problems:
        return ""
    first = outcome.problems[0]
    return short(first["sentence"]) + (f" [{first['number']}]" if first["number"] else "")


def blockers(outcomes, result):
    """The reasons why scenes do not run, by message: (message, code, names of scenes, number of these without another
    problem), the most frequent first. Messages for the same scenes are grouped."""
    scenes, numbers = {}, {}
    for outcome in outcomes:
        for problem in outcome.problems if outcome.result == result else []:
            sentence = short(problem["sentence"])
            scenes.setdefault(sentence, []).append(outcome.scene)
            numbers[sentence] = problem["number"]
    together = {}
    for sentence, names in scenes.items():
        together.setdefault((numbers[sentence], tuple(dict.fromkeys(names))), []).append(sentence)
    kinds = {}
    for (number, names), sentences in together.items():
        for name in names:
            kinds.setdefault(name, set()).add((number, names))
    rows = [(sentences[0] + (f" (and {len(sentences) - 1} of its kind)" if sentences[1:] else ""), number, list(names),
             sum(len(kinds[name]) == 1 for name in names)) for (number, names), sentences in together.items()]
    return sorted(rows, key=lambda row: (-len(row[2]), -row[3], row[0]))


RESULTS = ("ran", "stopped", "refused", "failed")


def counts(outcomes, among=()):
    """type -> number of scenes with each result, and in total; also for the scenes named in `among`."""
    table = {}
    for outcome in outcomes:
        for name in (outcome.type, f"{outcome.type}, among those named")[:1 + (outcome.scene in among)]:
            row = table.setdefault(name, dict.fromkeys((*RESULTS, "scenes"), 0))
            row[outcome.result] += 1
            row["scenes"] += 1
    return dict(sorted(table.items()))


def as_json(outcomes, about, among=()):
    """All results as JSON, for programs."""
    return json.dumps({**about, "counts": counts(outcomes, among),
                       "blockers": [{"sentence": sentence, "number": number, "alone": alone, "scenes": names}
                                    for sentence, number, names, alone in blockers(outcomes, "refused")],
                       "scenes": [dataclasses.asdict(outcome) for outcome in outcomes]}, indent=1) + "\n"


def escaped(text):
    """A sentence as a cell of a Markdown table: tags are marked as code."""
    return re.sub(r"(</?[\w-]+>)", r"`\1`", text).replace("|", "/")


def summary(outcomes, among=()):
    """Tables of the counts and of the reasons for refusals, as Markdown."""
    lines = ["| type | scenes | ran to the end | stopped at the limit | refused | failed |", "|" + "---|" * 6]
    for name, row in counts(outcomes, among).items():
        lines.append(f"| {name} | {row['scenes']} | " + " | ".join(str(row[result]) for result in RESULTS) + " |")
    for result, title in (("refused", "Refused"), ("failed", "Failed")):
        rows = blockers(outcomes, result)
        if rows:
            lines += ["", f"| {title}: sentence | number | scenes | nothing else |", "|---|---|---|---|"]
            lines += [f"| {escaped(sentence)} | {number} | {len(names)} | {alone} |"
                      for sentence, number, names, alone in rows]
    return "\n".join(lines) + "\n"


def table(outcomes, among=()):
    """A row for each scene, as Markdown; scenes named in `among` are marked."""
    heads = ["scene", "type", *(["named"] if among else []), "result", "particles or cells", "steps", "wall s",
             "processor s", "notes", "reason"]
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for one in outcomes:
        cells = [one.scene, one.type, *(["yes" if one.scene in among else ""] if among else []), one.result,
                 one.particles or one.cells or "", one.steps or "", f"{one.wall:.2f}", f"{one.processor:.2f}",
                 one.notes or "", escaped(reason_of(one))]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines) + "\n"
