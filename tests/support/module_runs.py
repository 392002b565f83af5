"""Runs scenes with analysis modules that write files: their content on any layout, after a restart and a kill."""
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

from sus import ROOT, SUS, on_ranks

sys.path.insert(0, str(ROOT / "tools/python"))
from tushar.interpreter import ensure

MISSING = None
try:
    ensure("h5py", "numpy")
    import numpy as np
    import tushar
except SystemExit:
    np = tushar = None
    MISSING = "no Python here has h5py and numpy"

VORTEX = ROOT / "ups/euler/vortex_3d.ups"
SMALL = ["--set", "Grid/Level/Box/resolution=[12,12,6]", "--set", "Time/max_Timesteps=10", "--set",
         "DataArchiver/outputInterval=0", "--set", "DataArchiver/outputTimestepInterval=1", "--set",
         "DataArchiver/checkpoint/@timestepInterval=4"]


def sus(*arguments, ranks=1, options=("--quiet",)):
    command = [*on_ranks(ranks), SUS, *options, *map(str, arguments)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)


@unittest.skipIf(MISSING, MISSING)
class ModuleTest(unittest.TestCase):
    """A test of modules; `files_of(archive)` returns the files they have written, by name."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def with_modules(self, of, modules, save=""):
        """Returns a copy of a scene with these modules in place of its own."""
        text = of.read_text()
        if "</DataAnalysis>" in text:
            text = text[:text.index("<DataAnalysis>")] + "</Uintah_specification>"
        text = text.replace("</DataArchiver>", save + "</DataArchiver>")
        path = self.folder / of.name
        path.write_text(text.replace("</Uintah_specification>",
                                     f"<DataAnalysis>{modules}</DataAnalysis></Uintah_specification>"))
        return path

    def well(self, ended):
        """Returns the standard output of a run that must succeed."""
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return ended.stdout

    def run_in(self, name, scene, *options, ranks=1):
        """Runs a scene and returns its archive, in a folder of that name."""
        self.well(sus(scene, "--output", self.folder / name, *options, ranks=ranks))
        return next((self.folder / name).glob("*.uda.000"))

    def assert_same_bytes_on_any_layout(self, scene, is_whole):
        """Asserts that the vortex's files do not depend on layout or restarts; `is_whole` checks those of one patch."""
        expected = self.files_of(self.run_in("one", scene, *SMALL, "-nthreads", "1"))
        is_whole(expected)
        for name, (ranks, patches) in {"patches": (1, "[2,3,1]"), "ranks": (3, "[2,2,2]")}.items():
            archive = self.run_in(name, scene, *SMALL, "--set", f"Grid/Level/Box/patches={patches}", ranks=ranks)
            self.assertEqual(self.files_of(archive), expected, name)
        cut = self.run_in("cut", scene, *SMALL, "--set", "Time/max_Timesteps=7")
        self.well(sus("-restart", cut, "-t", "4", "--set", "Time/max_Timesteps=10"))
        self.assertEqual(self.files_of(cut), expected, "after a restart")

    def assert_same_bytes_after_a_kill(self, scene, steps, step):
        """Asserts that a run killed after a step's checkpoint and restarted leaves the files of an uninterrupted
        one."""
        many = [*SMALL, "--set", f"Time/max_Timesteps={steps}", "--set", "Time/maxTime=1000", "--set",
                "DataArchiver/outputTimestepInterval=1000", "--set",
                f"DataArchiver/checkpoint/@timestepInterval={step}"]
        expected = self.files_of(self.run_in("uncut", scene, *many))
        job = subprocess.Popen([SUS, "--quiet", scene, "--output", self.folder / "cut", *many], cwd=ROOT)
        latest = self.folder / "cut/vortex_3d.uda/checkpoints/LATEST"
        while job.poll() is None and not (latest.exists() and latest.read_text().strip() >= f"t{step:05}"):
            time.sleep(.001)
        job.kill()
        self.assertNotEqual(job.wait(timeout=300), 0, "the run ended before it was killed")
        cut = next((self.folder / "cut").glob("*.uda.000"))
        self.well(sus("-restart", cut))
        self.assertEqual(self.files_of(cut), expected)
