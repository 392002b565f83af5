"""What scenes of solids leave behind in their global quantities."""
import pathlib
import subprocess
import tempfile

from sus import ROOT, SUS


def globals_of(scene, *names, sets=(), until=None):
    """Name -> the lines of its .dat file, as numbers: time, value or values."""
    with tempfile.TemporaryDirectory() as folder:
        command = [SUS, scene, "--quiet", "--output", folder, "--set", "DataArchiver/outputInterval=0"]
        for override in (*sets, *([f"Time/maxTime={until}"] if until else [])):
            command += ["--set", override]
        subprocess.run(command, cwd=ROOT, check=True)
        archive = next(pathlib.Path(folder).glob("*.uda.*"))
        return {name: [[float(word) for word in line.split()] for line in (archive / f"{name}.dat").read_text().splitlines()
                       if not line.startswith("#")] for name in names}


def relative_drift(lines):
    """The greatest change of a vector over a run, over its length at the start."""
    start = lines[0][1:]
    length = sum(v * v for v in start) ** .5
    return max(sum((v - w) ** 2 for v, w in zip(line[1:], start)) ** .5 for line in lines) / length
