#!/usr/bin/env python3
"""Cohesive zones: traction, energies and motion against closed forms, conservation, failure, bits, and messages."""
import math
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
import tushar
from solids import RefusedSceneTest, SceneTest, archive_of, globals_of, relative_drift
from sus import ROOT, bits_of, run
from uda import Folder

SCENE = "ups/solid/glued_blocks.ups"
TEXT = (ROOT / SCENE).read_text()
ZONES = (ROOT / "ups/solid/glued_blocks.txt").read_text()
# Of the scene: strengths [Pa], lengths [m], area of the glue [m^2], half of the mass of a block per area of glue
# [kg/m^2] (the reduced mass of both), relative velocity at the start [m/s].
SIGMA, TAU, DELTA, AREA, MASS, SPEED = 400, 500, 1e-3, .04, 150, .2
OPENS = ()
BODY = "MaterialProperties/MPM/material[{}]/geom_object/velocity={}"
SLIDES = (BODY.format(1, "[-0.1,0,0]"), BODY.format(2, "[0.1,0,0]"))
BOTH = (BODY.format(1, "[-0.06,-0.08,0]"), BODY.format(2, "[0.06,0.08,0]"))
ENERGY_N, ENERGY_T = math.e * SIGMA * DELTA, math.sqrt(math.e / 2) * TAU * DELTA


def energy(normal, tangential):
    """The energy per area that a zone has taken at a separation: Xu & Needleman 1994, r = 0."""
    x, y = normal / DELTA, tangential / DELTA
    return ENERGY_N - (1 + x) * np.exp(-x) * (ENERGY_N - ENERGY_T * (1 - np.exp(-y * y)))


def traction(normal, tangential):
    """Its derivatives."""
    x, y = normal / DELTA, tangential / DELTA
    return (np.exp(-x) * x / DELTA * (ENERGY_N - ENERGY_T * (1 - np.exp(-y * y))),
            2 * y / DELTA * (1 + x) * np.exp(-x - y * y) * ENERGY_T)


def separation_at(time, direction):
    """The separation along a straight path of two rigid bodies: MASS / 2 u^2 + energy = MASS / 2 SPEED^2."""
    d = np.linspace(0, 1.2 * SPEED * time + 1e-9, 200001)
    rate = np.sqrt(SPEED**2 - 2 / MASS * energy(d * direction[0], d * direction[1]))
    times = np.concatenate([[0], np.cumsum(np.diff(d) * .5 * (1 / rate[1:] + 1 / rate[:-1]))])
    return np.interp(time, times, d)


class TwoBlocks(unittest.TestCase):
    """Two stiff blocks that tear the glue between them."""

    def outputs_of(self, *sets):
        """For each output: time, normal and tangential jump and traction of all zones, and failure."""
        found = []
        with tempfile.TemporaryDirectory() as folder:
            archive = tushar.open(archive_of(SCENE, folder, *sets))
            for output in archive[:]:
                jump, force, area, normal = (output[f"p.cz{name}"][:]
                                             for name in ("Separation", "Force", "Area", "Norm"))
                stress = force / area[:, None]
                parts = []
                for vector in (jump, stress):
                    along = (vector * normal).sum(axis=1)
                    parts += [along, np.linalg.norm(vector - along[:, None] * normal, axis=1)]
                found.append((output.time, *parts, output["p.czFailed"][:], output["p.czMode"][:]))
        return found

    def test_the_traction_is_that_of_the_law_at_each_separation(self):
        for sets, strengths in ((OPENS, (SIGMA, 0)), (SLIDES, (0, TAU)), (BOTH, (SIGMA / 2, TAU / 2))):
            with self.subTest(sets):
                outputs = self.outputs_of(*sets, "DataArchiver/outputInterval=0.0005")
                for _, normal, tangential, along, across, failed, mode in outputs:
                    expected = traction(normal, tangential)
                    np.testing.assert_allclose(along, expected[0], atol=1e-9 * SIGMA)
                    np.testing.assert_allclose(across, expected[1], atol=1e-9 * TAU)
                    self.assertEqual((failed.max(), mode.max()), (0, 0))
                greatest = [max(output[k].max() for output in outputs) for k in (3, 4)]
                for part, strength in zip(greatest, strengths):
                    self.assertGreaterEqual(part, .97 * strength)  # of those at outputs, each .1 lengths
                    self.assertLessEqual(part, max(SIGMA, TAU))

    def test_the_blocks_move_like_rigid_bodies_that_store_the_energy_of_the_law(self):
        for sets, direction in ((OPENS, (1, 0)), (SLIDES, (0, 1))):
            with self.subTest(sets):
                for time, normal, tangential, *_ in self.outputs_of(*sets):
                    for jump, part in ((normal, direction[0]), (tangential, direction[1])):
                        # The glue strains the blocks by less than 1e-6; 6e-7 m was measured.
                        np.testing.assert_allclose(jump, part * separation_at(time, direction), atol=1.2e-6)

    def test_the_blocks_lose_the_fracture_energy_of_their_mode(self):
        for sets, fracture in ((OPENS, ENERGY_N), (SLIDES, ENERGY_T), (BOTH, ENERGY_N)):
            with self.subTest(sets):
                lines = globals_of(SCENE, "KineticEnergy", "CohesiveWork", sets=sets)
                lost = lines["KineticEnergy"][0][1] - lines["KineticEnergy"][-1][1]
                taken = lines["CohesiveWork"][-1][1]
                # The last output is at 8 to 11 lengths, where the law has taken all but 3e-3 of its energy.
                self.assertAlmostEqual(taken / (AREA * fracture), 1, delta=4e-3)
                self.assertAlmostEqual(lost / taken, 1, delta=2e-3)

    def test_momentum_does_not_change(self):
        for interpolator in ("linear", "gimp"):
            with self.subTest(interpolator):
                sets = (f"MPM/interpolator={interpolator}", BODY.format(2, "[0.3,0.1,0]"))
                drift = relative_drift(globals_of(SCENE, "TotalMomentum", sets=sets)["TotalMomentum"])
                self.assertLess(drift, 1e-13)

    def test_zones_fail_by_mode_and_lose_a_thousandth_of_their_strength_per_step(self):
        law = "MaterialProperties/MPM/cohesive_zone/delta_{}_fail=0.002"
        for sets, mode, limit in ((OPENS, 1, "n"), (SLIDES, 2, "t")):
            with self.subTest(mode):
                before = False
                for _, normal, tangential, along, across, failed, modes in self.outputs_of(*sets, law.format(limit)):
                    self.assertEqual(len({*failed}), 1)
                    if failed[0] == 0:
                        self.assertLessEqual(max(normal.max(), tangential.max()), .002)
                        self.assertEqual({*modes}, {0})
                    else:
                        before = before or failed[0] < 1000
                        self.assertEqual({*modes}, {mode})
                        left = 1 - failed / 1000
                        expected = traction(normal, tangential)
                        np.testing.assert_allclose(along, left * expected[0], atol=1e-9 * SIGMA)
                        np.testing.assert_allclose(across, left * expected[1], atol=1e-9 * TAU)
                self.assertTrue(before)
                self.assertEqual({*failed}, {1000})

    def test_zones_that_lose_a_body_exert_no_force(self):
        outputs = self.outputs_of(BODY.format(2, "[0,5,0]"), "Grid/Level/Box/upper=[0.4,2,0.1]",
                                  "Grid/Level/Box/resolution=[4,20,1]")
        self.assertEqual({*outputs[-1][6]}, {4})
        self.assertEqual({*outputs[-1][5]}, {1000})
        self.assertEqual(np.abs(outputs[-1][3]).max(), 0)

    def test_the_energy_budget_closes(self):
        energies = run(SCENE, "DataAnalysis/Module/@name=energyBudget").report["energies"]
        self.assertAlmostEqual(energies["went"]["cohesive zones"] / (AREA * ENERGY_N), 1, delta=4e-3)
        self.assertLess(abs(energies["unaccounted"]), 1e-4 * energies["went"]["cohesive zones"])

    def test_one_and_three_dimensions_agree_with_two(self):
        fine = "".join(f"{x} 0.4 {z} 0.0025 0 1 0 1 0 0 0 1\n" for x in (.025, .075, .125, .175, .225, .275, .325, .375)
                       for z in (.025, .075))
        expected = globals_of(SCENE, "CohesiveWork")["CohesiveWork"][-1]
        sides = "".join(f'<Face side="x{s}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>' for s in "-+")
        line = TEXT.replace("<periodic>[1,0,0]", "<periodic>[0,0,0]").replace("[4,8,1]", "[1,8,1]").replace(
            '<Face side="z-">', sides + '<Face side="z-">')
        for text, zones in ((line, ZONES), (TEXT.replace("[4,8,1]", "[4,8,2]").replace("[2,2,1]", "[2,2,2]"), fine)):
            with tempfile.TemporaryDirectory() as folder:
                pathlib.Path(folder, "glued_blocks.txt").write_text(zones)
                scene = pathlib.Path(folder, "scene.ups")
                scene.write_text(text)
                found = globals_of(str(scene), "CohesiveWork")["CohesiveWork"][-1]
                self.assertAlmostEqual(found[0], expected[0], delta=1e-4)
                self.assertAlmostEqual(found[1] / expected[1], 1, delta=1e-4)


class Halves(SceneTest):
    """Glued blocks in front of symmetry planes move like that part of the whole."""
    IMAGES = "</interpolator><mirror_images>true</mirror_images>"

    def particles(self, lower, cells, interpolator):
        """Positions, velocities, stresses and forces of zones after 60 steps, by name, in the order of positions."""
        places = [np.arange(low + .025, .4 if axis == 0 else .2, .05) for axis, low in enumerate(lower)]
        area = .05**2
        zones = "".join(f"{x:.3f} 0.4 {z:.3f} {area} 0 1 0 1 0 0 0 1\n" for x in places[0] for z in places[1])
        sides = "".join(f'<Face side="{side}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                        for side in ("x-", "x+"))
        text = TEXT.replace("<periodic>[1,0,0]</periodic>", "").replace('<Face side="z-">',
                                                                        sides + '<Face side="z-">', 1)
        x, z = lower
        for before, after in (("<lower>[0,0,0]", f"<lower>[{x},0,{z}]"),
                              ("[0.4,0.8,0.1]</upper>", "[0.4,0.8,0.2]</upper>"),
                              ("[4,8,1]", f"[{cells[0]},8,{cells[1]}]"),
                              ("<min>[0,0.1,0]", f"<min>[{x},0.1,{z}]"), ("0.4,0.1]</max>", "0.4,0.2]</max>"),
                              ("<min>[0,0.4,0]", f"<min>[{x},0.4,{z}]"), ("0.7,0.1]</max>", "0.7,0.2]</max>"),
                              ("[2,2,1]", "[2,2,2]"), ("<velocity>[0,-0.1,0]", "<velocity>[x,-0.1-x*x,-z]"),
                              ("<velocity>[0,0.1,0]", "<velocity>[-x,0.1+z*z,2*z]"),
                              ("gimp</interpolator>", interpolator)):
            self.assertIn(before, text)
            text = text.replace(before, after)
        scene = self.scene(text)
        (scene.parent / "glued_blocks.txt").write_text(zones)
        sets = ("Time/max_Timesteps=60", "DataArchiver/outputInterval=1", "DataArchiver/save[6]/@label=p.stress")
        found = {}
        with tempfile.TemporaryDirectory() as folder:
            with tushar.open(archive_of(scene, folder, *sets))[-1] as last:
                for material in ("lower", "upper", "glue"):
                    one = last.particles(material)
                    x = one["p.x"][:]
                    order = np.lexsort(np.round(x, 3).T)
                    for name in ("p.czForce",) if material == "glue" else ("p.velocity", "p.stress"):
                        found[material, name] = (x[order], one[name][:][order].reshape(len(x), -1))
        return found

    def test_move_like_those_of_the_whole(self):
        for interpolator in ("linear</interpolator>", "gimp" + self.IMAGES, "3rdorderBS</interpolator>"):
            whole = self.particles((-.4, -.2), (8, 4), interpolator)
            part = self.particles((0, 0), (4, 2), interpolator)
            for key, (x, values) in part.items():
                with self.subTest(interpolator=interpolator, of=key):
                    there, expected = whole[key]
                    expected = expected[(there[:, [0, 2]] > 0).all(axis=1)]
                    self.assertEqual(expected.shape, values.shape)
                    self.assertLess(np.abs(values - expected).max() / np.abs(expected).max(), 1e-10)


class Bits(unittest.TestCase):
    SETS = (*BOTH, "MaterialProperties/MPM/cohesive_zone/delta_n_fail=0.003", "Time/max_Timesteps=1200")

    def test_are_the_same_on_any_patches_threads_and_ranks(self):
        prints = set()
        for layout, threads, ranks in (("1x1x1", 1, 1), ("4x3x1", 2, 1), ("2x4x1", 1, 2), ("4x2x1", 1, 4)):
            options = ("--quiet", "-layout", layout, "-nthreads", str(threads))
            done = run(SCENE, *self.SETS, options=options, ranks=ranks)
            self.assertEqual(done.code, 0, done.err)
            prints.add((bits_of(done.report), done.report["steps"]))
        self.assertEqual(len(prints), 1)

    def test_are_the_same_after_a_restart(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        expected = run(SCENE, *self.SETS).report
        folder.run(SCENE, *self.SETS[:-1], "DataArchiver/checkpoint/@timestepInterval=700", "Time/max_Timesteps=700")
        code, errors, report = folder.restart("Time/max_Timesteps=1200", step=700)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(bits_of(report), bits_of(expected))


class Messages(RefusedSceneTest):
    def scene(self, text):
        path = super().scene(text)
        (path.parent / "glued_blocks.txt").write_text(getattr(self, "zones", ZONES))
        return path

    def test_say_what_a_scene_lacks(self):
        for before, after, sentence in (
                ("<cz_filename>glued_blocks.txt", "<cz_filename>none.txt",
                 "none.txt' cannot be read: there is no such file"),
                ("<sig_max>400</sig_max>", "", "missing tag <sig_max> in <cohesive_zone>"),
                ("<delta_t>0.001", "<delta_t>0", "delta_t: found '0'"),
                ("<delta_n>", "<do_rotation>true</do_rotation><delta_n>", "zones keep their normals"),
                ("<interpolator>", "<axisymmetric>true</axisymmetric><interpolator>",
                 "is not available with <axisymmetric>"),
                (TEXT[TEXT.index("      <cohesive_zone"):TEXT.index("      <contact>")], "",
                 "missing tag <cohesive_zone> in <MPM>: needed with <use_cohesive_zones>")):
            with self.subTest(after):
                self.assertIn(before, TEXT)
                self.assert_refused(TEXT.replace(before, after), sentence)

    def test_need_a_grid_of_one_box(self):
        beside = "<Box><lower>[0.4,0,0]</lower><upper>[0.8,0.4,0.1]</upper><resolution>[4,4,1]</resolution></Box>"
        text = TEXT.replace("</Box>", "</Box>" + beside, 1).replace("<periodic>[1,0,0]</periodic>", "")
        self.assert_refused(text, "needs a grid of one box: cohesive zones would glue bodies through walls")

    def test_name_the_line_of_the_file(self):
        for zones, sentence in ((ZONES + "1 2\n", "glued_blocks.txt:9: found 2 numbers, expected 12"),
                                (ZONES.replace("0 1 0 1 0 0 0 1\n", "0 0 1 1 0 0 0 1\n", 1),
                                 "glued_blocks.txt:1: the normal has a component along z")):
            self.zones = zones
            done = run(self.scene(TEXT))
            self.assertEqual(done.code, 3, done.err)
            self.assertIn(sentence, done.err)

    def test_note_what_has_no_effect_or_the_wrong_one(self):
        done = run(self.scene(TEXT.replace("<use_cohesive_zones>true", "<use_cohesive_zones>false")),
                   *(f"DataArchiver/save[{k}]/@label=p.x" for k in (2, 6, 7, 8, 9, 10, 11)), "Time/max_Timesteps=1",
                   options=())
        self.assertIn("does nothing without <use_cohesive_zones> true", done.err)
        self.zones = ZONES.replace("0 1\n", "1 0\n") + "0.5 0.4 0.05 0.005 0 1 0 1 0 0 1 0\n"
        done = run(self.scene(TEXT), "Time/max_Timesteps=1", options=())
        self.assertEqual(done.code, 0, done.err)
        self.assertIn("1 of 9 zones are outside the grid", done.err)
        self.assertIn("the normals of 8 zones point from the top material to the bottom material, so the two materials "
                      "of these zones are exchanged", done.err)


if __name__ == "__main__":
    unittest.main()
