#!/usr/bin/env python3
"""The README, the notebook and the examples of tools/python run: python3 tests/python/examples_test.py"""
import contextlib
import importlib.util
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import support

support.ensure("h5py", "matplotlib")
WITHOUT = {name: support.missing(name) for name in ("scipy", "nbclient")}

import matplotlib

matplotlib.use("Agg")

import numpy as np

with contextlib.suppress(ImportError):
    import yt
    yt.set_log_level("error")

import tushar
from support import LIBRARY, ROOT


class InAFolder(unittest.TestCase):
    """Base of tests, each in a folder of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def run_blocks(self, blocks):
        """Runs pieces of Python one after the other in one namespace: what they print. Pieces that need a library which
        is not there are left out."""
        names, printed, left_out = {}, io.StringIO(), []
        with contextlib.redirect_stdout(printed):
            for block in blocks:
                try:
                    exec(compile(block, "<example>", "exec"), names)
                except tushar.MissingLibrary as error:
                    left_out.append(str(error))
        return printed.getvalue(), left_out


class Readme(InAFolder):
    def test_all_its_examples_run(self):
        blocks = re.findall(r"```python\n(.*?)```", (LIBRARY / "README.md").read_text(), re.DOTALL)
        self.assertEqual(len(blocks), 10)
        printed, left_out = self.run_blocks(blocks)
        self.assertLessEqual(len(left_out), 4)
        for words in ("expected a value greater than 0 s", "['gas']", "kg/m^3", "(5, 2, 3)",
                      "{'MPM/gas_dynamics/cfl': -1}"):
            self.assertIn(words, printed)


class Notebook(InAFolder):
    PATH = LIBRARY / "examples/first_look.ipynb"

    def cells(self):
        cells = json.loads(self.PATH.read_text())["cells"]
        return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]

    def test_its_cells_run_one_after_the_other(self):
        printed, left_out = self.run_blocks(self.cells())
        self.assertEqual(left_out, [])
        self.assertIn("did you mean 'cfl'?", printed)
        self.assertEqual(len(re.findall(r"^(?:50|100|200) 0\.[12] ", printed, re.MULTILINE)), 6)

    @unittest.skipIf(WITHOUT["nbclient"], WITHOUT["nbclient"])
    def test_jupyter_runs_it(self):
        import nbclient
        import nbformat
        book = nbformat.read(self.PATH, as_version=4)
        with_package = {**os.environ, "PYTHONPATH": str(LIBRARY)}
        client = nbclient.NotebookClient(book, timeout=300, kernel_name="python3",
                                         resources={"metadata": {"path": "."}})
        client.execute(env=with_package, cwd=str(ROOT))
        results = [output for cell in book.cells for output in cell.get("outputs", [])]
        pictures = [output for output in results if "image/png" in output.get("data", {})]
        self.assertEqual(len(pictures), 3)

    def test_it_is_kept_without_results(self):
        for cell in json.loads(self.PATH.read_text())["cells"]:
            self.assertFalse(cell.get("outputs"))


def example_of(name):
    """Imports an example as a module."""
    spec = importlib.util.spec_from_file_location(name, LIBRARY / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class StressPath(InAFolder):
    def test_goes_and_is_drawn_from_the_outputs_of_a_run(self):
        example = example_of("stress_path")
        archive = tushar.run("ups/solid/crushed_sandstone.ups", {"Time/maxTime": 0.01}).archive
        times, pressure, mises = example.stress_path(archive)
        self.assertEqual(len(times), len(archive))
        self.assertAlmostEqual(pressure[-1] / 156.5e6, 1, delta=0.03)  # at the last output, within 1 % of the time
        self.assertLess(max(mises), 1e3, "pressed all around")
        example.draw(archive, "path.png")
        self.assertGreater(pathlib.Path("path.png").stat().st_size, 1000)


class TractionSeparation(InAFolder):
    def test_is_that_of_the_law_and_is_drawn(self):
        example = example_of("traction_separation")
        archive = tushar.run("ups/solid/glued_blocks.ups", {"Time/maxTime": 0.02}).archive
        opening, sliding, pull, drag = example.tractions(archive)
        self.assertGreater(opening.max(), 3e-3)
        self.assertLess(np.abs(pull - example.law(archive)[0](opening)).max(), 1e-6)
        self.assertLess(max(sliding.max(), drag.max()), 1e-6, "mode I")
        example.draw([archive], "law.png")
        self.assertGreater(pathlib.Path("law.png").stat().st_size, 1000)


class ParticlesOfImage(InAFolder):
    EXAMPLE = LIBRARY / "examples/particles_of_image.py"

    def written(self, *words):
        subprocess.run([sys.executable, self.EXAMPLE, "particles.pts", *words], capture_output=True, check=True)
        return pathlib.Path("particles.pts").read_text()

    def test_of_the_scene_are_written_by_it(self):
        self.assertEqual(self.written(), (LIBRARY.parents[1] / "ups/solid/crushed_foam.pts").read_text())

    def test_are_the_bright_voxels_with_their_gray(self):
        np.save("scan.npy", np.arange(8.).reshape(2, 2, 2))
        words = self.written("--image", "scan.npy", "--voxel", "2", "--threshold", "5", "--gray")
        self.assertEqual(words, "3 3 1 6\n3 3 3 7\n")


@unittest.skipIf(WITHOUT["scipy"], WITHOUT["scipy"])
class Calibration(InAFolder):
    def test_finds_the_yield_stress_that_a_length_was_made_with(self):
        example = example_of("calibrate_yield_stress")
        cells = [6, 21]
        length = example.final_length(400e6, cells)
        with contextlib.redirect_stdout(io.StringIO()):
            found = example.calibrate(length, cells)
        self.assertAlmostEqual(found / 400e6, 1, delta=0.01)

    def test_runs_as_a_program(self):
        command = [sys.executable, LIBRARY / "examples/calibrate_yield_stress.py", "--cells", "6,21"]
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(LIBRARY)})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"yield stress: 33\d MPa\n$")


class Package(InAFolder):
    def test_it_can_be_installed(self):
        python = pathlib.Path("venv/bin/python3").absolute()
        made = subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "venv"],
                              capture_output=True, text=True)
        if made.returncode:
            self.skipTest("this Python makes no virtual environments: apt install python3-venv")
        if subprocess.run([python, "-c", "import setuptools, wheel"], capture_output=True).returncode:
            self.skipTest("this Python has no setuptools and wheel, and fetching them takes a network")
        subprocess.run(["cp", "-r", LIBRARY, "python"], check=True)
        done = subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps",
                               "--no-build-isolation", "./python"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        look = "import tushar, pathlib; print(sorted(p.name for p in pathlib.Path(tushar.__file__).parent.iterdir()))"
        clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
        found = subprocess.run([python, "-c", look], capture_output=True, text=True, check=True, env=clean).stdout
        self.assertIn("py.typed", found)
        self.assertIn("archive.py", found)
        self.assertNotIn("studies", found)

    def test_names_that_it_promises_are_there(self):
        for name in tushar.__all__:
            self.assertIsNotNone(getattr(tushar, name))
        with self.assertRaisesRegex(AttributeError, "module 'tushar' has no 'opn'; it has open, "):
            tushar.opn

    def test_its_types_are_right(self):
        folders = os.environ["PATH"].split(os.pathsep) + [os.path.dirname(sys.executable)]
        programs = [pathlib.Path(folder, "mypy") for folder in folders if pathlib.Path(folder, "mypy").exists()]
        if not programs:
            self.skipTest("mypy is not installed")
        command = [programs[0], "--config-file", LIBRARY / "pyproject.toml", "--cache-dir", os.path.abspath("cache")]
        done = subprocess.run(command, cwd=LIBRARY, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
