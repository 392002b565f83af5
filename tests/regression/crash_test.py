#!/usr/bin/env python3
"""A run that was cut off, or whose checkpoints are damaged, continues from the last intact one."""
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT
from uda import Folder

SOD = "ups/mpm/sod.ups"


def every(steps, cycle=2):
    return f"DataArchiver/checkpoint/@timestepInterval={steps}", f"DataArchiver/checkpoint/@cycle={cycle}"


class Crash(unittest.TestCase):
    def setUp(self):
        self.here = Folder()
        self.addCleanup(self.here.cleanup)

    def uncut(self):
        with_none = Folder()
        self.addCleanup(with_none.cleanup)
        code, errors, report = with_none.run(SOD)
        self.assertEqual((code, errors), (0, ""))
        return report["fingerprint"], with_none

    def files(self):
        return {path: path.read_bytes() for path in self.here.uda.rglob("*") if path.is_file()}

    def damaged(self, harm):
        """Returns errors and report of a restart whose newest checkpoint was damaged."""
        last = self.here.checkpoints[-1]
        saved = self.here.path / "saved"
        shutil.copytree(self.here.uda / "checkpoints", saved)
        harm(last)
        code, errors, report = self.here.restart()
        self.assertEqual(code, 0, errors)
        shutil.rmtree(self.here.uda / "checkpoints")
        shutil.move(saved, self.here.uda / "checkpoints")
        return errors, report

    def test_a_damaged_checkpoint_is_named_and_the_one_before_is_used(self):
        fingerprint, _ = self.uncut()
        self.here.run(SOD, *every(50))
        last = self.here.checkpoints[-1]
        size = (last / "state.h5").stat().st_size

        def flip(folder):
            data = bytearray((folder / "state.h5").read_bytes())
            data[size // 2] ^= 64
            (folder / "state.h5").write_bytes(data)

        def truncate(folder):
            (folder / "state.h5").write_bytes((folder / "state.h5").read_bytes()[:4096])

        for harm, sentence in ((flip, "the content of state.h5 has changed"),
                               (truncate, f"state.h5 has 4096 bytes instead of {size}"),
                               (lambda folder: (folder / "state.h5").unlink(), "state.h5 is missing"),
                               (lambda folder: (folder / "manifest").unlink(), "manifest is missing"),
                               (lambda folder: (folder / "manifest").write_text(""),
                                "the content of manifest has changed")):
            errors, report = self.damaged(harm)
            self.assertEqual(errors, f"sus: the checkpoint {last.resolve()} is damaged: {sentence} [T502]\n"
                                     "sus: continues from the checkpoint of step 200\n")
            self.assertEqual(report["fingerprint"], fingerprint)
        self.assertEqual(self.damaged(shutil.rmtree)[0], "")
        self.assertEqual(self.damaged(lambda folder: (folder.parent / "LATEST").write_text("t0002"))[0], "")

    def test_with_no_whole_checkpoint_nothing_is_touched(self):
        self.here.run(SOD, *every(50))
        for checkpoint in self.here.checkpoints:
            (checkpoint / "manifest").unlink()
        before = self.files()
        code, errors, _ = self.here.restart()
        self.assertEqual(code, 3)
        self.assertEqual(errors.count("manifest is missing"), 2)
        self.assertIn("no earlier checkpoint is intact; start the run again from its scene", errors)
        self.assertEqual(self.files(), before)

    def test_the_scene_is_taken_from_the_checkpoint_where_it_is_lost(self):
        fingerprint, _ = self.uncut()
        self.here.run(SOD, *every(50))
        text = (self.here.uda / "input.xml").read_text()
        (self.here.uda / "input.xml").unlink()
        code, errors, report = self.here.restart(step=200)
        self.assertEqual((code, report["fingerprint"]), (0, fingerprint))
        self.assertIn("input.xml was missing; it was restored from the checkpoint", errors)
        self.assertEqual((self.here.uda / "input.xml").read_text(), text)

    def test_what_cannot_be_restarted_is_refused_in_a_sentence(self):
        here = self.here
        here.run(SOD, *every(100, cycle=9))
        bare = Folder()
        self.addCleanup(bare.cleanup)
        bare.run(SOD)

        def assert_refused(path, sentence, *sets, code=3, options=()):
            found, errors, _ = here.finish(["-restart", path, *options], sets)
            self.assertIn(sentence, errors)
            self.assertEqual((found, len(errors.strip().splitlines())), (code, 1), errors)

        assert_refused(here.path / "none.uda", "there is no such folder; --restart takes the .uda folder of a run")
        assert_refused(SOD, "this is not a folder; --restart takes the .uda folder of a run (without --restart, "
                            "sus runs a scene)")
        assert_refused(here.path, "this is not a .uda folder: it has neither index.xml nor checkpoints")
        assert_refused(bare.uda, "there are no checkpoints; <checkpoint .../> in <DataArchiver> requests them")
        assert_refused(here.uda, "there is no checkpoint of step 50; available: steps 0, 100, 200, 218",
                       options=("-t", "50"))
        assert_refused(here.uda, "the checkpoint has a different grid from the scene; a restart may change patches, "
                                 "but not cells",
                       "Grid/Level/Box/resolution=[50,1,1]")
        assert_refused(here.uda, "--output cannot be used with --restart", options=("--output", here.path), code=2)
        found, errors, _ = here.finish([SOD, "-t", "50"], ())
        self.assertEqual(found, 2, errors)
        scene = (here.uda / "input.xml").read_text()
        (here.uda / "input.xml").write_text((ROOT / "ups/heat/sine.ups").read_text())
        assert_refused(here.uda, "the checkpoint is of component 'mpm', but the scene has 'heat'")
        (here.uda / "input.xml").write_text(scene)
        (here.uda / "checkpoints/t00200").rename(here.uda / "checkpoints/t00150")
        assert_refused(here.uda, "the checkpoint is of step 200; rename its folder to t00200",
                       options=("-t", "150"))

    def test_two_runs_never_write_to_one_folder(self):
        run = subprocess.Popen(self.here.command([SOD, "--output", self.here.path],
                                                 [*every(1000), "Grid/Level/Box/resolution=[5000,1,1]"]), cwd=ROOT)
        while not list(self.here.path.glob("*.uda/checkpoints/LATEST")):
            time.sleep(0.01)
        code, errors, _ = self.here.restart()
        run.kill()
        run.wait()
        self.assertEqual((code, errors), (1, f"sus: another run is writing to '{self.here.uda.resolve()}'; wait "
                                             "until it ends, or stop it [T403]\n"))
        self.assertEqual(self.here.restart("Time/max_Timesteps=1")[0], 0)

    def test_an_earlier_checkpoint_can_be_chosen_and_later_ones_are_forgotten(self):
        fingerprint, _ = self.uncut()
        self.here.run(SOD, *every(100, cycle=9))
        code, _, report = self.here.restart("Time/max_Timesteps=120", step=100)
        self.assertEqual((code, report["steps"]), (0, 120))
        self.assertEqual([path.name for path in self.here.checkpoints], ["t00000", "t00100", "t00120"])
        self.assertFalse((self.here.uda / "t00218.h5").exists())
        code, _, report = self.here.restart("Time/max_Timesteps=1000")
        self.assertEqual((code, report["fingerprint"]), (0, fingerprint))

    def test_a_full_disk_leaves_the_last_checkpoint_whole(self):
        fingerprint, _ = self.uncut()
        self.here.run(SOD, *every(60), "Time/max_Timesteps=100", "DataArchiver/outputInterval=0")
        files = [path.name for path in self.here.checkpoints]
        size = (self.here.checkpoints[-1] / "state.h5").stat().st_size
        restart = " ".join(self.here.command(["-restart", self.here.uda], ["Time/max_Timesteps=1000"]))
        limited = f"ulimit -f {size // 1024 - 1}; exec {restart}"
        done = subprocess.run(["bash", "-c", limited], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), done.stderr)
        self.assertRegex(done.stderr, r"sus: cannot write .*t00120.tmp/state.h5': File too large")
        self.assertEqual([path.name for path in self.here.checkpoints], files)
        code, errors, report = self.here.restart("Time/max_Timesteps=1000")
        self.assertEqual((code, errors, report["fingerprint"]), (0, "", fingerprint))

    def test_the_time_between_checkpoints(self):
        wall = Folder()
        self.addCleanup(wall.cleanup)
        wall.run(SOD, "DataArchiver/checkpoint/@walltimeInterval=1e-9", "DataArchiver/checkpoint/@cycle=1000")
        self.assertEqual(len(wall.checkpoints), 219)
        self.here.run(SOD, "DataArchiver/checkpoint/@interval=0.05", "DataArchiver/checkpoint/@cycle=1000")
        self.assertEqual([path.name for path in self.here.checkpoints],
                         [path.stem for path in sorted(self.here.uda.glob("t*.h5"))])


if __name__ == "__main__":
    unittest.main()
