"""Runs scenes of solids and reads their global quantities."""
import pathlib
import subprocess
import tempfile
import unittest

from sus import ROOT, SUS, run


class SceneTest(unittest.TestCase):
    """A test that runs scenes which it writes itself."""

    def scene(self, text):
        """Writes the scene into a file that exists during the test."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name, "scene.ups")
        path.write_text(text)
        return path


class RefusedSceneTest(SceneTest):
    """A test of scenes that sus refuses."""

    def assert_refused(self, text, sentence):
        """Asserts that a scene with this text ends with exit code 3, and with the message at its place."""
        done = run(self.scene(text), "Time/max_Timesteps=1")
        self.assertEqual(done.code, 3, done.err)
        self.assertIn(sentence, done.err)
        self.assertRegex(done.err, r"scene\.ups:\d+:\d+: ")


def globals_of(scene, *names, sets=(), until=None):
    """Returns the lines of each .dat file as numbers (time, value or values), by name."""
    with tempfile.TemporaryDirectory() as folder:
        command = [SUS, scene, "--quiet", "--output", folder, "--set", "DataArchiver/outputInterval=0"]
        for override in (*sets, *([f"Time/maxTime={until}"] if until else [])):
            command += ["--set", override]
        subprocess.run(command, cwd=ROOT, check=True)
        archive = next(pathlib.Path(folder).glob("*.uda.*"))
        return {name: [[float(word) for word in line.split()]
                       for line in (archive / f"{name}.dat").read_text().splitlines()
                       if not line.startswith("#")] for name in names}


def archive_of(scene, folder, *sets):
    """Runs a scene and returns the path of its archive."""
    command = [SUS, scene, "--quiet", "--output", folder]
    for override in sets:
        command += ["--set", override]
    subprocess.run(command, cwd=ROOT, check=True)
    return next(pathlib.Path(folder).glob("*.uda.*"))


def columns(archive, *names, material=None, time=None):
    """Returns the values by column in the output nearest to a time, or in the last output."""
    command = [ROOT / "tools/uda", archive, *names, "--csv", "-"]
    command += ["--material", material] if material else []
    command += ["--time", str(time)] if time else []
    text = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [[float(word) for word in line.split(",")] for line in text[1:]]
    return dict(zip(text[0].split(","), zip(*rows)))


def last_state(scene, *names, material=None, sets=()):
    """Returns the values by column at the end of a scene."""
    with tempfile.TemporaryDirectory() as folder:
        return columns(archive_of(scene, folder, *sets), *names, material=material)


def relative_drift(lines):
    """Returns the largest change of a vector during a run, relative to its initial length."""
    start = lines[0][1:]
    length = sum(v * v for v in start) ** .5
    return max(sum((v - w) ** 2 for v, w in zip(line[1:], start)) ** .5 for line in lines) / length
