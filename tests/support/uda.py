"""Runs sus in a folder of its own that keeps its .uda from one run to the next."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from sus import ROOT, SUS, bits_of, on_ranks


PATIENCE = 1200  # seconds after which a run hangs, even on a machine with much else to do
MEMORY = next((path for path in ("/dev/shm",) if os.access(path, os.W_OK)), None)


def words_of(layout):
    """Returns [2,3,1] in the form that -layout expects."""
    return "x".join(layout.strip("[]").split(","))


class Folder:
    """A temporary folder for the .uda of a scene; `folder.cleanup()` removes it. It is in memory, where waiting for the
    disk takes no time, unless it is wanted on the disk."""

    def __init__(self, on_disk=False, ranks=1):
        self.ranks = ranks
        self.temporary = tempfile.TemporaryDirectory(dir=None if on_disk else MEMORY)
        self.path = pathlib.Path(self.temporary.name)
        self.cleanup = self.temporary.cleanup

    def command(self, words, sets):
        command = [*on_ranks(self.ranks), SUS, *map(str, words), "--quiet", "--json", str(self.path / "report.json")]
        for override in sets:
            command += ["--set", override]
        return command

    def finish(self, words, sets):
        """Returns exit code, errors and (for a successful run) the report."""
        (self.path / "report.json").unlink(missing_ok=True)
        done = subprocess.run(self.command(words, sets), cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
        report = self.path / "report.json"
        return done.returncode, done.stderr, json.loads(report.read_text()) if report.exists() else None

    def run(self, scene, *sets, layout=None):
        return self.finish([scene, "--output", self.path, *self._laid_out(layout)], sets)

    def restart(self, *sets, step=None, layout=None):
        steps = [] if step is None else ["-t", step]
        return self.finish(["-restart", self.uda, *steps, *self._laid_out(layout)], sets)

    @staticmethod
    def _laid_out(layout):
        return [] if layout is None else ["-layout", words_of(layout)]

    @property
    def uda(self):
        """Returns the link to the newest .uda."""
        return next(path for path in self.path.iterdir() if path.suffix == ".uda")

    @property
    def checkpoints(self):
        """Returns the checkpoint folders by step; unfinished ones of a killed run, which end in .tmp, do not count."""
        return sorted(path for path in (self.uda / "checkpoints").iterdir() if path.is_dir() and path.suffix != ".tmp")


class FolderTest(unittest.TestCase):
    """A test that runs scenes in folders of its own."""

    def folder(self, ranks=1, on_disk=False):
        """Returns a folder that exists during the test."""
        folder = Folder(on_disk, ranks)
        self.addCleanup(folder.cleanup)
        return folder

    def small_disk(self, folder, size):
        """Mounts a disk of that size below a folder; skips the test where this is impossible."""
        disk = folder / "small"
        disk.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "none", disk], capture_output=True).returncode:
            self.skipTest("only root may make a small disk")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        return disk

    def well(self, result):
        """Returns the report of a run that must succeed."""
        code, errors, report = result
        self.assertEqual((code, errors), (0, ""))
        return report

    def fingerprint_of_two_parts(self, scene, steps, *sets):
        """Returns the fingerprint of a run that is restarted from a checkpoint in its middle."""
        return self.in_two_parts(scene, steps, *sets)["fingerprint"]

    def bits_of_two_parts(self, scene, steps, *sets):
        """Returns all fingerprints of such a run."""
        return bits_of(self.in_two_parts(scene, steps, *sets))

    def in_two_parts(self, scene, steps, *sets):
        """Returns the report of a run that is restarted from a checkpoint in its middle."""
        folder, half = self.folder(), steps // 2
        folder.run(scene, *sets, f"DataArchiver/checkpoint/@timestepInterval={half}", f"Time/max_Timesteps={half + 1}")
        return self.well(folder.restart(f"Time/max_Timesteps={steps}", step=half))
