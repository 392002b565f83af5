"""The simulator that the tools run: the release build of this repository."""
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
SUS = str(ROOT / "build/release/sus")


def scene_path(scene):
    """A scene as the caller or, failing that, the root of the repository knows it."""
    return pathlib.Path(scene).resolve() if os.path.exists(scene) else ROOT / scene


class SceneError(Exception):
    """What sus says of a scene that it does not run."""


def run_scene(sus, scene, sets, folder):
    """Runs a scene with overrides, its files in `folder`: the report. `failure` is a sentence for one that died, else
    empty."""
    path = pathlib.Path(folder, "report.json")
    command = [str(sus), str(scene_path(scene)), "--quiet", "--json", str(path), "--output", str(folder)]
    for override in sets:
        command += ["--set", override]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SceneError(f"{scene}: {done.stderr.strip() or 'sus failed'}")
    if done.returncode == 0 and not path.exists():
        raise SceneError(f"{sus} wrote no report: is it sus?")
    return json.loads(path.read_text()) if path.exists() else {"failure": done.stderr.strip()}


def ensure_built(sus):
    """Installs what is missing and builds the release preset, if that is the program and it is not there."""
    if sus == SUS and not os.path.exists(sus):
        subprocess.run(["bash", "-euc", '. tools/lib/build.sh; install_missing "${packages[@]}"; build release sus'],
                       cwd=ROOT, check=True)
