"""Runs scenes for the gallery: a picture and a report of each, kept in a cache until the scene or the program
changes."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

from tushar.studies.gallery import CASES
from tushar.program import ROOT

DIES = re.compile(r"\bdies in\b|\bgives up\b")  # what is expected of a scene that must fail
SECONDS = 60  # a scene that takes longer has no picture
CACHE = ROOT / "build/manual-cache"


class Album:
    """The runs of scenes. If `sus` is None, nothing is run, and only cached results are used."""

    def __init__(self, sus, makes, cache=CACHE):
        self.sus, self.makes, self.cache = sus, makes, pathlib.Path(cache)
        self.version = _version(sus)

    def report(self, scene):
        """The report of a scene, None if it was not run."""
        file = self._made(scene, ".json")
        return json.loads(file.read_text()) if file else None

    def picture(self, scene):
        """A picture: from a run, or the one next to the scene. None if there is neither."""
        beside = ROOT / scene.path.replace(".ups", ".png")
        return self._made(scene, ".png") or (beside if beside.exists() else None)

    def _made(self, scene, ending):
        stem = self.cache / (scene.path.removesuffix(".ups").replace("/", "-") + "-" + self._key(scene))
        if self.makes and not stem.with_suffix(".done").exists():
            self._make(scene, stem)
        file = stem.with_suffix(ending)
        return file if file.exists() else None

    def _key(self, scene):
        return hashlib.sha256("".join((self.version, scene.text, *scene.shown)).encode()).hexdigest()[:12]

    def _make(self, scene, stem):
        self.cache.mkdir(parents=True, exist_ok=True)
        print(f"runs {scene.path}", flush=True)
        with tempfile.TemporaryDirectory() as folder:
            report, picture = f"{folder}/report.json", f"{folder}/picture.png"
            run = [str(self.sus), str(ROOT / scene.path), "--quiet", "--output", folder, "--json", report]
            draw = [str(ROOT / "tools/plot"), f"{folder}/{scene.archive}", *scene.shown, "--out", picture]
            try:
                subprocess.run(run, capture_output=True, timeout=SECONDS, cwd=ROOT)
                done = subprocess.run(draw, capture_output=True, text=True, timeout=SECONDS,
                                      env={**os.environ, "MPLBACKEND": "Agg"})
                if done.returncode:
                    print(f"  no picture: {done.stderr.strip()}")
            except subprocess.TimeoutExpired:
                print(f"  it takes more than {SECONDS} s, so there is no picture")
            for file in filter(os.path.exists, (report, picture)):
                shutil.copyfile(file, stem.with_suffix(pathlib.Path(file).suffix))
        stem.with_suffix(".done").touch()


def _version(sus):
    """A text that changes whenever the program changes."""
    if sus is None:
        return ""
    said = subprocess.run([str(sus), "-V"], capture_output=True, text=True).stdout
    return said + str(os.path.getsize(sus))


def bound_of(scene):
    """(path in the report, upper bound) for a scene in the gallery of hard cases; None for others."""
    case = next((case for case in CASES if scene.path == f"ups/stability/{case.scene or case.name}.ups"), None)
    return (f"errors.{case.error}", case.most) if case and case.most is not None and not case.sets else None


def value_at(report, path):
    """The number at a path in a report, such as errors.density.cell.L1; None if it does not exist."""
    for key in path.split("."):
        report = report.get(key) if isinstance(report, dict) else None
    return report


def broken_bounds(scenes, album):
    """Messages on scenes whose values exceed their bounds."""
    for scene in scenes:
        report, bound = album.report(scene), bound_of(scene)
        if report and report.get("failure") and not DIES.search(scene.head.get("Expect", "")):
            yield f"{scene.path}: {report['failure']}"
        elif report and bound and not (value_at(report, bound[0]) or 0) <= bound[1]:
            yield f"{scene.path}: {bound[0]} is {value_at(report, bound[0]):g}, at most {bound[1]:g} is allowed"
