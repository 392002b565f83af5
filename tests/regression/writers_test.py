#!/usr/bin/env python3
"""Ranks that write together: same bytes with any number of ranks and writers, little memory per rank, and one message
if a writer cannot write."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS
from uda import FolderTest

BOX = "Grid/Level/Box"
SOD, SINE = "ups/mpm/sod.ups", "ups/heat/sine.ups"
PLANE = (f"{BOX}/resolution=[150,60,1]", f"{BOX}/upper=[1,.4,1]")
EVERY = ("DataArchiver/outputInterval=0", "DataArchiver/outputTimestepInterval=2",
         "DataArchiver/checkpoint/@timestepInterval=2", "Time/max_Timesteps=4")
# Scene, overrides, layout: particles, nodes and cells of some megabytes; packed; with 4 bytes to a number; fields whose
# slabs are cut; boxes of several levels.
CASES = {
    "particles": (SOD, PLANE, "6x4x1"),
    "packed particles": (SOD, (*PLANE, "DataArchiver/compression=gzip"), "6x4x1"),
    "short particles": (SOD, (*PLANE, "DataArchiver/outputDoubleAsFloat=true"), "5x4x1"),
    "fields": (SINE, (f"{BOX}/resolution=[900,700,1]",), "5x3x1"),
    "packed fields": (SINE, (f"{BOX}/resolution=[900,700,1]", "DataArchiver/compression=gzip"), "3x4x1"),
    "levels": ("ups/heat/levels.ups", (), "1x1x1"),
    "packed levels": ("ups/heat/levels.ups", ("DataArchiver/compression=gzip",), "1x1x1"),
}
RANKS_AND_WRITERS = ((2, 1), (2, 2), (3, 2), (3, 3), (5, 1), (5, 4), (5, 5))
LITTLE = 64e6  # bytes that a rank may need beyond its state to write
OF_ALL = 100e6  # bytes that a rank may have in memory beyond its part of the state, the program included
PROGRAM = 500e3  # bytes that a rank reads for itself: libraries, the scene, the head of the checkpoint
PATIENCE = 200  # seconds after which a job hangs, even on a machine with much else to do


class Writers(FolderTest):
    def run_by(self, here, scene, sets, writers, layout, behind=2):
        words = [scene, "--output", here.path, "-layout", layout, "-behind", behind,
                 *(["-writers", writers] if here.ranks > 1 else [])]
        code, errors, report = here.finish(words, (*sets, *EVERY))
        self.assertEqual((code, errors), (0, ""))
        return report

    def files(self, here):
        uda = here.uda.resolve()
        names = [*uda.glob("t*.h5"), *uda.glob("checkpoints/*/*")]
        return {str(name.relative_to(uda)): name.read_bytes() for name in names}

    @staticmethod
    def packed(report):
        """Returns the bytes of the outputs' values without and with compression; empty if none is requested."""
        return [report["compression"][key] for key in ("bytes", "packed")] if "compression" in report else []

    def test_the_report_says_what_compression_took_and_saved(self):
        here = self.folder(1)
        report = self.run_by(here, *CASES["packed fields"][:2], 1, "3x4x1")
        use = report["compression"]
        size = sum(file.stat().st_size for file in here.uda.resolve().glob("t*.h5"))
        self.assertEqual(use["bytes"], 3 * 900 * 700 * 8)
        self.assertTrue(.5 * size < use["packed"] < size, use)
        self.assertEqual(use["saved_bytes"], use["bytes"] - use["packed"])
        self.assertTrue(use["packing"] > 0 and use["writing"] > 0, use)
        self.assertAlmostEqual(use["saved_seconds"],
                               use["writing"] * use["saved_bytes"] / use["packed"] - use["packing"], 6)
        short = self.run_by(self.folder(1), SINE, (*CASES["packed fields"][1], "DataArchiver/outputDoubleAsFloat=true"),
                            1, "3x4x1")
        self.assertEqual(short["compression"]["bytes"], use["bytes"] / 2)

    def test_the_same_bytes_by_any_ranks_and_writers(self):
        for name, (scene, sets, layout) in CASES.items():
            alone = self.folder(1)
            expected = self.run_by(alone, scene, sets, 1, layout, behind=0)
            self.assertEqual(expected["wall"]["output_wait"], 0)
            files = self.files(alone)
            self.assertEqual(len(files), 3 + 2 * 2)
            self.assertEqual(len(self.packed(expected)), 2 if name.startswith("packed") else 0)
            for ranks, writers in ((1, 1), *RANKS_AND_WRITERS):
                with self.subTest(name, ranks=ranks, writers=writers):
                    here = self.folder(ranks)
                    report = self.run_by(here, scene, sets, writers, layout, behind=(ranks + writers) % 3)
                    self.assertEqual(report["fingerprint"], expected["fingerprint"])
                    self.assertEqual(self.packed(report), self.packed(expected))
                    found = self.files(here)
                    self.assertEqual(found.keys(), files.keys())
                    for file, content in files.items():
                        self.assertTrue(found[file] == content, file)
                    here.cleanup()

    def test_a_run_goes_on_by_other_ranks_and_writers_to_the_same_bits(self):
        alone = self.folder(1)
        expected = self.run_by(alone, SOD, PLANE, 1, "6x4x1")
        for ranks, writers, again, others in ((1, 1, 3, 2), (3, 3, 1, 1), (2, 2, 5, 3)):
            here = self.folder(ranks)
            words = [SOD, "--output", here.path, "-writers", writers]
            self.assertEqual(here.finish(words, (*PLANE, *EVERY, "Time/max_Timesteps=2"))[:2], (0, ""))
            here.ranks = again
            words = ["-restart", here.uda, "-writers", others, "-layout", "3x5x1"]
            code, errors, report = here.finish(words, ("Time/max_Timesteps=4",))
            self.assertEqual((code, errors, report["fingerprint"]), (0, "", expected["fingerprint"]))

    def bytes_read(self, here, words, sets):
        """Returns the bytes that read calls of a job's ranks have returned, as the system counts them."""
        counted = ("sh", "-c", f'"$@" || exit; grep rchar /proc/$$/io > {here.path}/read.${{OMPI_COMM_WORLD_RANK:-0}}',
                   "sh")
        job = self.start(here, words, sets, counted)
        self.assertEqual((job.communicate()[1], job.returncode), ("", 0))
        files = list(here.path.glob("read.*"))
        self.assertEqual(len(files), here.ranks)
        return sum(int(file.read_text().split()[1]) for file in files)

    def test_a_restart_reads_each_byte_about_once(self):
        cells = (f"{BOX}/resolution=[1000,800,1]", f"{BOX}/upper=[1,.4,1]")
        for scene, sets, layout in ((SOD, (f"{BOX}/resolution=[300,200,1]", f"{BOX}/upper=[1,.4,1]"), "7x3x1"),
                                    (SINE, cells, "2x5x1"), ("ups/heat/levels.ups", (), "1x1x1")):
            for ranks, writers, again, patches in ((1, 1, 3, "8x3x1"), (3, 2, 2, "2x9x1"), (2, 2, 1, "3x4x1")):
                with self.subTest(scene, ranks=ranks, writers=writers, again=again):
                    here = self.folder(ranks)
                    words = [scene, "--output", here.path, "-writers", writers, "-layout", layout]
                    self.well(here.finish(words, (*sets, *EVERY, "Time/max_Timesteps=2")))
                    here.ranks = again
                    words = ["-restart", here.uda, "-layout", patches]
                    read = self.bytes_read(here, words, ("Time/max_Timesteps=2",))
                    size = (here.checkpoints[-1] / "state.h5").stat().st_size
                    self.assertLess(read, 1.2 * size + again * PROGRAM)

    def test_a_changed_byte_is_told_before_any_step_and_the_checkpoint_before_is_taken(self):
        here, alone = self.folder(2), self.folder(1)
        expected = self.run_by(alone, SOD, PLANE, 1, "6x4x1")
        self.run_by(here, SOD, PLANE, 2, "6x4x1")
        state = here.checkpoints[-1] / "state.h5"
        places = [line.split()[1] for line in (state.parent / "manifest").read_text().splitlines()[1:-1]]
        self.assertGreater(len(places), 6)  # whose sums are checked while they are read, and the rest of the file
        ranges = [tuple(map(int, place.split("-"))) if "-" in place else (0, int(place)) for place in places]
        saved = self.saved(here)
        for k, (first, last) in enumerate(ranges):
            for at in (first, (first + last) // 2, last - 1):
                with self.subTest(place=places[k], at=at):
                    here.ranks = 1 + (k + at) % 3
                    with state.open("r+b") as file:
                        file.seek(at)
                        byte = file.read(1)[0]
                        file.seek(at)
                        file.write(bytes([byte ^ (1 << at % 8)]))
                    code, errors, report = here.restart("Time/max_Timesteps=4", layout="[3,5,1]")
                    self.assertEqual((code, report["fingerprint"]), (0, expected["fingerprint"]), errors)
                    self.assertEqual(errors, f"sus: the checkpoint {state.parent.resolve()} is damaged: the content of "
                                             "state.h5 has changed [T502]\n"
                                             "sus: continues from the checkpoint of step 2\n")
                    self.put_back(here, saved)

    def saved(self, here):
        copy = here.path / "saved"
        shutil.copytree(here.uda, copy)
        return copy

    def put_back(self, here, saved):
        shutil.rmtree(here.uda.resolve())
        shutil.copytree(saved, here.uda.resolve())

    def start(self, here, words, sets, ranks_run=(), **environment):
        """Starts a job through `ranks_run`, the words of a command that starts the ranks."""
        command = here.command(words, sets)
        at = command.index(SUS)
        return subprocess.Popen([*command[:at], *ranks_run, *command[at:]], cwd=ROOT, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, **environment})

    def most_memory(self, here, words, sets, ranks_run=()):
        """Returns the largest address space and the largest resident memory [bytes] of a rank of a successful job, as
        the system counts them."""
        job, most = self.start(here, words, sets, ranks_run), {"VmPeak": 0, "VmHWM": 0}
        while job.poll() is None:
            for pid in subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True).stdout.split():
                try:
                    status = pathlib.Path(f"/proc/{pid}/status").read_text()
                except OSError:
                    continue
                for line in status.splitlines():
                    what, _, size = line.partition(":")
                    if what in most:
                        most[what] = max(most[what], 1024 * int(size.split()[0]))
            time.sleep(0.05)
        self.assertEqual((job.returncode, job.communicate()[1]), (0, ""))
        return most["VmPeak"], most["VmHWM"]

    def test_outputs_checkpoints_and_a_restart_need_little_memory_on_any_rank(self):
        large = (f"{BOX}/resolution=[4000,4000,1]", "Time/max_Timesteps=2")
        silent = (*large, "DataArchiver/outputInterval=0", "DataArchiver/outputInitTimestep=false")
        here = self.folder(8)
        words = [SINE, "--output", here.path, "-layout", "2x4x1"]
        limit = (self.most_memory(here, words, silent)[0] + LITTLE) // 1024
        part = 4000 * 4000 * 8 / here.ranks  # bytes of the temperature on a rank
        bounded = ("sh", "-c", f'ulimit -v {limit:.0f}; exec "$@"', "sh")
        saves = (*silent, "DataArchiver/outputInitTimestep=true", "DataArchiver/outputTimestepInterval=1",
                 "DataArchiver/checkpoint/@timestepInterval=1")
        for writers in (1, 3):
            self.assertLess(self.most_memory(here, [*words, "-writers", writers], saves, bounded)[1], part + OF_ALL)
            self.assertEqual(len(list(here.uda.glob("t*.h5"))), 3)
        again = ["-restart", here.uda, "-layout", "2x4x1"]
        self.assertLess(self.most_memory(here, again, ("Time/max_Timesteps=3",), bounded)[1], part + OF_ALL)
        here.ranks = 3
        # A slow disk lets a writer hold the share of a rank while the run continues; with -behind 0 it holds none.
        again = ["-restart", here.uda, "-layout", "1x3x1", "-behind", "0"]
        both = 2 * part * 8 / 3  # old and new values of a third of the grid
        self.assertLess(self.most_memory(here, again, ("Time/max_Timesteps=4",))[1], both + LITTLE)

    def end_of(self, here, sets, rank, limit, *words):
        """Returns the outcome of a job in which one rank may write only a limited number of bytes into a file."""
        bound = f'if [ "$OMPI_COMM_WORLD_RANK" = {rank} ]; then ulimit -f {limit // 512}; fi; exec "$@"'
        small = ("sh", "-c", bound, "sh")
        # Messages through sockets: those in memory need files, too.
        job = self.start(here, [*words, "-writers", here.ranks], sets, small, OMPI_MCA_btl="self,tcp")
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertEqual(job.returncode, 1, errors)
        self.assertEqual(errors.count("File too large"), 1, errors)

    def test_a_writer_that_cannot_write_is_told_once_and_the_checkpoint_before_stays(self):
        for rank, packed in ((0, "0"), (1, "0"), (2, "0"), (0, "gzip"), (2, "gzip")):
            with self.subTest(rank=rank, compression=packed):
                here = self.folder(3)
                sets = (*PLANE, *EVERY, f"DataArchiver/compression={packed}")
                self.run_by(here, SOD, sets, 3, "6x4x1")
                # Outputs are longer than this; of packed ones, which rank 0 writes alone, the last slab of checkpoints.
                limit = 1_100_000 if packed == "0" else 250_000 if rank == 0 else 2_900_000
                self.end_of(here, ("Time/max_Timesteps=8",), rank, limit, "-restart", here.uda)
                self.assertEqual([path.name for path in here.checkpoints], ["t00002", "t00004"])
                self.assertEqual(list(here.uda.resolve().rglob("*.tmp")), [])
                here.ranks = 1
                expected = self.folder(1)
                words = [SOD, "--output", expected.path]
                code, _, report = expected.finish(words, (*sets, "Time/max_Timesteps=8"))
                again = here.restart("Time/max_Timesteps=8")
                self.assertEqual((code, again[0], again[1]), (0, 0, ""))
                self.assertEqual(again[2]["fingerprint"], report["fingerprint"])

    def test_a_full_disk_is_told_once_by_several_writers(self):
        here = self.folder(3)
        small = self.small_disk(here.path, "14m")
        job = self.start(here, [SOD, "--output", small, "-writers", "3"],
                         (*PLANE, *EVERY, "DataArchiver/outputTimestepInterval=1", "Time/max_Timesteps=100"))
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertEqual(job.returncode, 1, errors)
        self.assertEqual(errors.count("No space left on device"), 1, errors)
        for output in small.glob("*.uda.000/t*.h5"):
            output.unlink()
        done = subprocess.run([SUS, "-restart", next(small.glob("*.uda")), "--quiet", "--set", "Time/max_Timesteps=1"],
                              cwd=ROOT, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_global_that_cannot_be_written_ends_all_when_the_output_on_its_way_is_whole(self):
        here, alone = self.folder(3), self.folder(1)
        sets = (*PLANE, *EVERY, "DataArchiver/compression=gzip")
        expected = alone.finish([SOD, "--output", alone.path], (*sets, "Time/max_Timesteps=8"))[2]
        lines = (alone.uda / "KineticEnergy.dat").read_text().splitlines(keepends=True)
        self.run_by(here, SOD, sets, 3, "6x4x1")
        energy = here.uda.resolve() / "KineticEnergy.dat"
        content = energy.read_text()
        self.assertEqual(content, "".join(lines[:6]))
        disk = self.small_disk(here.path, "4k")  # which has room for step 5 and 6, and for a byte of step 7
        pad = os.sysconf("SC_PAGE_SIZE") - len(content + lines[6] + lines[7]) - 1
        (disk / "energy").write_text("#" * (pad - 1) + "\n" + content)
        energy.unlink()
        energy.symlink_to(disk / "energy")
        job = self.start(here, ["-restart", here.uda, "-writers", "3", "-behind", "32"],
                         ("Time/max_Timesteps=8", "DataArchiver/checkpoint/@timestepInterval=100"))
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertEqual(job.returncode, 1, errors)
        self.assertEqual(errors.count("No space left on device"), 1, errors)
        self.assertNotIn("(rank", errors)
        self.assertTrue((here.uda / "t00006.h5").read_bytes() == (alone.uda / "t00006.h5").read_bytes())
        self.assertEqual(list(here.uda.resolve().rglob("*.tmp")), [])
        code, errors, report = here.restart("Time/max_Timesteps=8")
        self.assertEqual((code, errors, report["fingerprint"]), (0, "", expected["fingerprint"]))

    def test_a_folder_that_vanishes_is_told_once(self):
        here = self.folder(3)
        job = self.start(here, [SOD, "--output", here.path, "-writers", "3"],
                         (*PLANE, *EVERY, "Time/max_Timesteps=100000"))
        while not list(here.path.glob("*.uda/checkpoints/LATEST")):
            time.sleep(0.01)
        here.uda.resolve().rename(here.path / "elsewhere")
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertEqual(job.returncode, 1, errors)
        self.assertEqual(errors.count("No such file or directory"), 1, errors)
        done = subprocess.run([SUS, "-restart", here.path / "elsewhere", "--quiet", "--set", "Time/max_Timesteps=1"],
                              cwd=ROOT, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_writer_that_is_killed_while_it_writes_ends_the_job_and_the_checkpoint_before_restarts(self):
        here = self.folder(3, on_disk=True)
        sets = (*PLANE, *EVERY, "DataArchiver/outputTimestepInterval=1", "DataArchiver/checkpoint/@timestepInterval=1",
                "Time/max_Timesteps=100000")
        job = self.start(here, [SOD, "--output", here.path, "-writers", "3", "-layout", "6x4x1"], sets)
        while not (list(here.path.glob("*.uda/checkpoints/LATEST")) and list(here.path.glob("*.uda.000/**/*.tmp"))):
            time.sleep(0.0005)
        rank = subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True).stdout.split()[-1]
        os.kill(int(rank), signal.SIGKILL)
        errors = job.communicate(timeout=PATIENCE)[1]
        self.assertNotEqual(job.returncode, 0)
        self.assertEqual(errors.count("signal 9 (Killed)"), 1, errors)
        end = f"Time/max_Timesteps={int(here.checkpoints[-1].name[1:]) + 2}"
        here.ranks = 2
        code, errors, report = here.restart(end)
        self.assertEqual((code, errors), (0, ""))
        uncut = self.folder(1)
        expected = uncut.finish([SOD, "--output", uncut.path], (*sets, end))[2]
        self.assertEqual(report["fingerprint"], expected["fingerprint"])


if __name__ == "__main__":
    unittest.main()
