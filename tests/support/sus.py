"""Runs sus for tests: the program in $SUS, from the root of the repository, with output in a temporary folder."""
import json
import os
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUS = str(pathlib.Path(os.environ.get("SUS", ROOT / "build/dev/sus")).resolve())
FAULTY_SUS = str(pathlib.Path(os.environ.get("FAULTY_SUS", ROOT / "build/dev/tests/faulty_sus")).resolve())
# Open MPI refuses root and more ranks than cores unless told otherwise. Ranks that wait leave their core to others:
# tests share the machine.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")


def on_ranks(count):
    """Returns the words in front of the program that start it on several ranks; none for one rank."""
    return [] if count == 1 else ["mpirun", "--oversubscribe", "-n", str(count)]


def bits_of(report):
    """Returns the fingerprints of the state and of what else is saved, in one string."""
    return " ".join(report[key] for key in ("fingerprint", "fingerprint_of_others") if key in report)


class Result:
    """Exit code, printed text, report if there is one, and names of the files left behind."""

    def __init__(self, done, report, files):
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
        self.report, self.files = report, files


def run(scene, *sets, options=("--quiet",), outputs=False, ranks=1):
    """Runs a scene with overrides; without `outputs` only the totals are saved."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "report.json")
        command = [*on_ranks(ranks), SUS, str(scene), *options, "--output", folder, "--json", str(path)]
        for override in sets if outputs else ("DataArchiver/outputInterval=0", *sets):
            command += ["--set", override]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=300)
        report = json.loads(path.read_text()) if path.exists() else None
        files = sorted(str(file.relative_to(folder)) for file in pathlib.Path(folder).rglob("*"))
        return Result(done, report, files)
