"""The simulator that the tools run: the release build of this repository."""
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[3]
SUS = str(ROOT / "build/release/sus")


def scene_path(scene):
    """A scene as the caller or, failing that, the root of the repository knows it."""
    return pathlib.Path(scene).resolve() if os.path.exists(scene) else ROOT / scene


def ensure_built(sus):
    """Installs what is missing and builds the release preset, if that is the program and it is not there."""
    if sus == SUS and not os.path.exists(sus):
        subprocess.run(["bash", "-euc", '. tools/lib/build.sh; install_missing "${packages[@]}"; build release sus'],
                       cwd=ROOT, check=True)
