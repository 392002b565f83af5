#!/usr/bin/env python3
"""The module slice: same values as the full outputs on its planes, same bytes on any layout and after a restart."""
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from module_runs import SMALL, VORTEX, ModuleTest, np, sus, tushar
from sus import ROOT

DISCS = ROOT / "ups/solid/two_discs.ups"
STEPS = "<outputTimestepInterval>3</outputTimestepInterval>"
PLANES = "<plane>z = 0</plane><plane>x=1.3</plane>"
LABELS = "<label>c.density</label><label>c.velocity</label>"


class Slice(ModuleTest):
    def scene(self, of, tags):
        """Returns a copy of a scene with the module."""
        return self.with_modules(of, f'<Module name="slice">{tags}</Module>')

    def files_of(self, archive):
        files = [file for file in (archive / "slice").rglob("*") if file.is_file() and file.name != "input.xml"]
        return {str(file.relative_to(archive)): file.read_bytes() for file in files}

    def test_a_plane_has_the_values_of_the_full_output(self):
        archive = self.run_in("whole", self.scene(VORTEX, PLANES + LABELS + STEPS), *SMALL)
        whole = tushar.open(archive)
        for plane, axis, row in (("z=0", 0, 2), ("x=1.3", 2, 7)):
            part = tushar.open(archive / "slice" / plane)
            self.assertEqual(part.steps, [0, 3, 6, 9])
            for k, step in enumerate(part.steps):
                all_of = whole[whole.steps.index(step)]
                self.assertEqual(part.times[k], whole.times[whole.steps.index(step)])
                for label in ("c.density", "c.velocity"):
                    expected = np.take(all_of[label][:], [row], axis=axis)
                    np.testing.assert_array_equal(part[k][label][:], expected, err_msg=f"{plane} {label}")
            grid = part.grid
            self.assertEqual((grid.dimension, int(grid.cells[2 - axis])), (2, 1))
            place = float(plane[2:])
            self.assertLessEqual(grid.lower[2 - axis], place)
            self.assertGreaterEqual(grid.lower[2 - axis] + grid.spacing[2 - axis] + 1e-12, place)

    def test_the_nodes_of_a_material(self):
        tags = "<plane>y = .52</plane><label>g.mass</label><material>lower</material>" + STEPS
        scene = self.scene(DISCS, tags)
        scene.write_text(scene.read_text().replace("</DataArchiver>", '<save label="g.mass"/></DataArchiver>'))
        archive = self.run_in("discs", scene, "--set", "Time/max_Timesteps=6", "--set", "DataArchiver/outputInterval=0",
                              "--set", "DataArchiver/outputTimestepInterval=3")
        whole, part = tushar.open(archive)[-1], tushar.open(archive / "slice/y=0.52")[-1]
        row = whole.grid.nearest("node", 1, .52)
        expected = whole["g.mass", "lower"][:][:, [row]]
        self.assertGreater(np.max(expected), 0)
        np.testing.assert_array_equal(part["g.mass", "lower"][:], expected)
        self.assertEqual(part.grid.dimension, whole.grid.dimension - 1)

    def test_any_layout_and_a_restart_leave_the_same_bytes(self):
        self.assert_same_bytes_on_any_layout(
            self.scene(VORTEX, PLANES + LABELS + STEPS),
            lambda files: self.assertEqual(sum(name.endswith(".h5") for name in files), 8))

    def test_a_run_that_is_killed_after_a_checkpoint_keeps_its_slices(self):
        self.assert_same_bytes_after_a_kill(self.scene(VORTEX, PLANES + LABELS + STEPS), steps=400, step=20)

    def test_slices_by_time_and_after_a_restart(self):
        scene = self.scene(VORTEX, "<plane>z=0</plane><label>c.density</label><outputInterval>.5</outputInterval>")
        archive = self.run_in("time", scene, *SMALL)
        part, whole = tushar.open(archive / "slice/z=0"), tushar.open(archive)
        expected = [0] + [step for step, before, now in zip(whole.steps[1:], whole.times, whole.times[1:])
                          if now // .5 > before // .5]
        self.assertEqual(part.steps, expected)
        self.assertLess(len(expected), len(whole))
        cut = self.run_in("cut", scene, *SMALL, "--set", "Time/max_Timesteps=7")
        self.assertEqual(sus("-restart", cut, "-t", "4", "--set", "Time/max_Timesteps=10").returncode, 0)
        self.assertEqual(self.files_of(cut), self.files_of(archive))

    def test_what_a_module_cannot_show_is_refused(self):
        wrong = {
            "<plane>z</plane>" + LABELS + STEPS:
                "plane: found 'z', expected an axis and a coordinate in m, such as z = 0.5",
            "<plane>z=0</plane><plane>z = 0.0</plane>" + LABELS + STEPS: "plane: the plane z = 0.0 is given twice",
            "<plane>z=2</plane>" + LABELS + STEPS: "plane: found z = 2 m, expected a position on the grid, from "
                                                   "-1.25 to",
            PLANES + "<label>p.x</label>" + STEPS: "found 'p.x', expected a cell variable (c.) or a node variable (g.)",
            PLANES + "<label>c.densty</label>" + STEPS: "computes 'c.densty' (did you mean 'c.density'?)",
            PLANES + LABELS: "a slice needs one of outputInterval and outputTimestepInterval: there is no default",
            PLANES + LABELS + STEPS + "<outputInterval>1</outputInterval>":
                "gives both outputInterval and outputTimestepInterval; keep one",
            PLANES + LABELS + "<outputInterval>0</outputInterval>": "found '0', expected a value greater than 0 s",
            PLANES + LABELS + "<outputInterval>5e-12</outputInterval>":
                "outputInterval: found 5e-12 s, expected more than 1e-11 s, which is the resolution of times up to "
                "maxTime",
            PLANES + LABELS + "<outputTimestepInterval>0</outputTimestepInterval>":
                "found '0', expected a value greater than 0",
            PLANES + STEPS: "label",
            LABELS + STEPS: "plane",
        }
        for tags, sentence in wrong.items():
            ended = sus(self.scene(VORTEX, tags), "-check")
            self.assertEqual(ended.returncode, 3, tags)
            self.assertIn(sentence, ended.stderr)
        flat = self.scene(ROOT / "ups/euler/vortex.ups", PLANES + LABELS + STEPS)
        self.assertIn("the grid has only one cell along z", sus(flat, "-check").stderr)
        line = self.scene(ROOT / "ups/euler/sod.ups", "<plane>x=0.5</plane>" + LABELS + STEPS)
        self.assertIn("would be a point", sus(line, "-check").stderr)

    def test_labels_are_checked_where_a_plane_needs_the_grid_of_the_run(self):
        scene = self.scene(VORTEX, "<plane>x=1.3</plane><label>c.densty</label>" + STEPS)
        ended = sus(scene, "-check", "--set", "DataArchiver/save[1]/@label=c.presure")
        self.assertEqual(ended.returncode, 3)
        self.assertIn("DataArchiver/save: no task of this component computes 'c.presure' (did you mean 'c.pressure'?)",
                      ended.stderr)
        self.assertIn("DataAnalysis/Module: no task of this component computes 'c.densty' (did you mean 'c.density'?)",
                      ended.stderr)
        discs = self.scene(DISCS, "<plane>y=.52</plane><label>g.mass</label>" + STEPS)
        ended = sus(discs, "-check", "--set", "DataArchiver/save[1]/@label=AccStrainEnergy", options=())
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("'AccStrainEnergy' is not saved, since no task computes it in this scene", ended.stderr)

    def test_a_film_of_slices(self):
        archive = self.run_in("film", self.scene(VORTEX, PLANES + LABELS + STEPS), *SMALL)
        film = self.folder / "film.gif"
        made = subprocess.run([ROOT / "tools/plot", archive / "slice/z=0", "c.density", "--movie", film],
                              capture_output=True, text=True)
        if "needs the Python" in made.stderr:
            self.skipTest(made.stderr)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(film.read_bytes()[:3], b"GIF")


if __name__ == "__main__":
    unittest.main()
