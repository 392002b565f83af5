#!/usr/bin/env python3
"""Tests of tools/plot with a scene, which it runs first, in place of an archive."""
import os
import pathlib
import subprocess
import sys
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = str(pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve())
sys.path[:0] = [str(ROOT / "tools/python"), str(ROOT / "tests/tools")]
from tushar.interpreter import ensure

ensure("h5py", "matplotlib", "PIL")

from PIL import Image

from in_folder import InFolder
from tushar import Archive, SusError
from tushar.shown_run import film_interval, run_shown

SOD = str(ROOT / "ups/mpm/sod.ups")
SMALL = ("--set", "Grid/Level/Box/resolution=[20,1,1]")
# Takes the words of sus, keeps them, writes a report where it is asked to, and dies of a value.
DYING = """#!/bin/sh
echo "$@" > words
while [ "$1" != --json ]; do shift; done
echo '{"archive": "sod.uda.000"}' > "$2"
echo 'step 7: the density is not finite' >&2
exit 4
"""


class Scenes(InFolder):
    def plot(self, *words, sus=SUS):
        """Returns exit code, standard output and standard error of tools/plot, run in a folder of its own."""
        done = subprocess.run([sys.executable, ROOT / "tools/plot", *words], capture_output=True, text=True,
                              cwd=self.folder, env={**os.environ, "SUS": sus})
        self.assertNotIn("Traceback", done.stderr)
        return done.returncode, done.stdout, done.stderr

    def dying(self):
        program = self.folder / "dying_sus"
        program.write_text(DYING)
        program.chmod(0o755)
        (self.folder / "words").unlink(missing_ok=True)
        return str(program)

    def test_is_run_and_drawn(self):
        code, out, err = self.plot(SOD, "p.density", *SMALL, "--out", "density.png")
        self.assertEqual((code, out), (0, "density.png\n"), err)
        with Image.open(self.folder / "density.png") as picture:
            self.assertGreater(min(picture.size), 100)
        self.assertIn(f"plot: runs {SOD}\n", err)
        self.assertIn("fingerprint", err)
        self.assertIn("plot: draws sod.uda.", err)
        self.assertEqual(Archive(self.folder / "sod.uda")[-1].grid.cells[0], 20)

    def test_becomes_a_film(self):
        code, out, err = self.plot(SOD, "p.density", *SMALL, "--set", "Time/maxTime=0.05", "--movie", "sod.gif")
        self.assertEqual((code, out), (0, "sod.gif\n"), err)
        self.assertIn("with --set DataArchiver/outputInterval=0.0005, for the film", err)
        with Image.open(self.folder / "sod.gif") as moving:
            self.assertEqual(moving.n_frames, len(Archive(self.folder / "sod.uda")))
            self.assertGreater(moving.n_frames, 5)

    def test_that_is_wrong_is_told_by_sus_with_its_exit_code(self):
        code, out, err = self.plot(SOD, "--set", "Time/maxTime=-1", "--movie", "wrong.gif")
        self.assertEqual((code, out), (3, ""))
        self.assertIn("Time/maxTime: found '-1', expected a value greater than 0 s", err)
        self.assertIn("ended with exit code 3, so nothing is drawn\n", err)
        self.assertFalse((self.folder / "wrong.gif").exists())
        self.assertIn("no/such.ups: there is no such file", self.plot("no/such.ups")[2])

    def test_that_dies_on_the_way_leaves_an_archive(self):
        code, out, err = self.plot(SOD, sus=self.dying())
        self.assertEqual((code, out), (4, ""))
        self.assertIn("step 7: the density is not finite\n", err)
        self.assertIn("exit code 4, so nothing is drawn; its outputs are in sod.uda.000\n", err)

    def test_is_not_run_where_the_picture_cannot_be(self):
        for words, code, sentence in ((("--movie", "film.avi"), 1, "must end in .mp4 or .gif"),
                                      (("--movie", "no/film.gif"), 1, "there is no folder 'no'"),
                                      (("--cmap", "virdis"), 1, "did you mean 'viridis'?"),
                                      (("--follow",), 2, "--follow draws the archive of a run in progress")):
            found, _, err = self.plot(SOD, *words, sus=self.dying())
            self.assertEqual(found, code, err)
            self.assertIn(sentence, err)
            self.assertFalse((self.folder / "words").exists())

    def test_is_what_values_are_overridden_of(self):
        code, _, err = self.plot("sod.uda", *SMALL)
        self.assertEqual(code, 2)
        self.assertIn("--set overrides a value of a scene (.ups), but 'sod.uda' is not a scene", err)

    def test_is_run_by_tools_run_unless_a_program_is_named(self):
        with mock.patch("subprocess.Popen") as started, mock.patch.dict(os.environ):
            started.return_value.wait.side_effect = [KeyboardInterrupt, 5]  # the run is waited for after Ctrl-C
            os.environ.pop("SUS", None)
            with self.assertRaises(SusError) as caught:
                run_shown(SOD, ["a=1"])
        words = started.call_args.args[0]
        self.assertEqual((words[:3], words[-2:]), (["bash", str(ROOT / "tools/run"), SOD], ["--set", "a=1"]))
        self.assertEqual(caught.exception.code, 5)


class Outputs(unittest.TestCase):
    def test_of_a_film_are_a_hundred(self):
        discs = str(ROOT / "ups/solid/two_discs.ups")  # an output each 0.05 s of 0.2 s
        self.assertAlmostEqual(film_interval(discs, []), 0.002)
        self.assertAlmostEqual(film_interval(discs, ["Time/maxTime=0.1"]), 0.001)
        self.assertAlmostEqual(film_interval(str(ROOT / "ups/solid/driven_disc.ups"), ["Time/maxTime=2"]), 0.02)

    def test_are_those_of_the_scene_where_it_has_many_or_is_told(self):
        for override in ("DataArchiver/outputInterval=0.1", "DataArchiver/outputTimestepInterval=3", "Time/maxTime=x"):
            self.assertIsNone(film_interval(SOD, [override]))
        self.assertIsNone(film_interval(str(ROOT / "ups/heat/implicit.ups"), []))  # counts steps
        self.assertIsNone(film_interval("no/such.ups", []))


if __name__ == "__main__":
    unittest.main()
