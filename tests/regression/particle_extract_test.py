#!/usr/bin/env python3
"""The module particleExtract writes a file for each chosen particle, without duplicate lines after a restart."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, SUS

MODULE = """<DataAnalysis><Module name="particleExtract"><material>lower</material>
  <samplingFrequency>1e10</samplingFrequency><timeStart>0</timeStart><timeStop>100</timeStop>
  <colorThreshold>0</colorThreshold>
  <Variables><analyze label="p.stress"/><analyze label="p.velocity"/></Variables></Module></DataAnalysis>
</Uintah_specification>"""


def scene(folder, module=MODULE):
    """Two discs, the first with a colour, and the module."""
    text = (ROOT / "ups/solid/two_discs.ups").read_text().replace("</Uintah_specification>", module)
    text = text.replace("<temperature>12</temperature>", "<temperature>12</temperature><color>1</color>", 1)
    text = text.replace("</DataArchiver>", '<checkpoint timestepInterval="5" cycle="3"/></DataArchiver>')
    path = pathlib.Path(folder) / "extract.ups"
    path.write_text(text)
    return path


def sus(*arguments):
    return subprocess.run([SUS, "--quiet", *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)


def extracted(folder):
    archive = next(pathlib.Path(folder).glob("*.uda.*"))
    return {file.name: file.read_text().splitlines() for file in (archive / "particleExtract/L-0").iterdir()}


class ParticleExtract(unittest.TestCase):
    def test_every_step_of_every_chosen_particle_is_there(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(sus(scene(folder), "--output", folder, "--set", "Time/max_Timesteps=10").returncode, 0)
            files = extracted(folder)
        self.assertEqual(len(files), 416, "half of 13 kg in particles of 1000 kg/m^3 (.025 m)^3")
        for lines in files.values():
            self.assertTrue(lines[0].startswith("# Time    X      Y      Z          p.velocity.x"), lines[0])
            self.assertEqual([len(line.split()) for line in lines[1:]], [1 + 3 + 3 + 9] * 10)
            x, v = [float(line.split()[1]) for line in lines[1:3]], float(lines[1].split()[4])
            self.assertAlmostEqual(v, 2, delta=1e-6, msg="in free flight")
            self.assertGreater(x[1], x[0])

    def test_the_first_sample_is_that_of_the_first_step_from_the_start_on(self):
        """As in Uintah's module: then a sample every 1/samplingFrequency."""
        module = MODULE.replace("1e10", "1e3").replace("<timeStart>0<", "<timeStart>.001<")
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as each:
            for place, text in ((folder, module), (each, MODULE)):
                self.assertEqual(sus(scene(place, text), "--output", place, "--set",
                                     "Time/max_Timesteps=40").returncode, 0)
            rare, every = ([float(line.split()[0]) for line in next(iter(extracted(place).values()))[1:]]
                           for place in (folder, each))
        self.assertEqual(rare[0], next(time for time in every if time >= .001))
        self.assertEqual([int(time * 1e3) for time in rare], list(range(1, int(every[-1] * 1e3) + 1)))

    def test_a_restart_leaves_the_same_lines(self):
        with tempfile.TemporaryDirectory() as whole, tempfile.TemporaryDirectory() as cut:
            sus(scene(whole), "--output", whole, "--set", "Time/max_Timesteps=20")
            sus(scene(cut), "--output", cut, "--set", "Time/max_Timesteps=12")
            archive = next(pathlib.Path(cut).glob("*.uda.*"))
            run = sus("-restart", archive, "-t", "10", "--set", "Time/max_Timesteps=20")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertEqual(extracted(whole), extracted(cut))

    def test_a_variable_that_nothing_computes_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            run = sus(scene(folder, MODULE.replace("p.stress", "p.strss")), "--output", folder)
        self.assertEqual(run.returncode, 3)
        self.assertIn("computes 'p.strss' (did you mean 'p.stress'?)", run.stderr)


if __name__ == "__main__":
    unittest.main()
