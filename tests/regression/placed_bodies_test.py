#!/usr/bin/env python3
"""Bodies with given particle positions: mass, momentum, expansion, and a restart on other patches."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import archive_of, columns, globals_of
from sus import bits_of, run
from uda import Folder

SCENE = "ups/solid/placed_bodies.ups"
RING, BLOCK = math.pi * (.2**2 - .08**2) * .05 * 1000, .2 * .1 * .05 * 1000  # kg
BOXES = "MaterialProperties/MPM/material/geom_object[2]/"
# Of the disc: particles of 1/2, 1/4 and 1/8 of a cell whose places a few lines of Python find.
DISC = 3.5234375


class PlacedBodies(unittest.TestCase):
    def test_mass_and_momentum_are_those_of_the_shapes_and_stay(self):
        values = globals_of(SCENE, "TotalMass", "TotalMomentum")
        for line in values["TotalMass"]:
            self.assertAlmostEqual(line[1], RING + BLOCK + DISC, delta=1e-9)
        for line in values["TotalMomentum"]:
            self.assertAlmostEqual(line[1], RING - DISC, delta=1e-9)
            self.assertAlmostEqual(line[2], 0, delta=1e-9)

    def test_the_block_starts_turned_with_its_edges(self):
        with tempfile.TemporaryDirectory() as folder:
            archive = archive_of(SCENE, folder, "Time/max_Timesteps=1", "DataArchiver/outputInitTimestep=true")
            edges = columns(archive, "p.scalefactor", time=1e-12)
        turned = [k for k, across in enumerate(edges["p.scalefactor.yx [m]"])
                  if abs(across - .6 * .025) < 1e-12 and abs(edges["p.scalefactor.xx [m]"][k] - .8 * .025) < 1e-12]
        self.assertEqual(len(turned), 8 * 4)

    def test_hot_bodies_expand_and_those_at_room_temperature_rest(self):
        hot = globals_of(SCENE, "StrainEnergy")["StrainEnergy"]
        cold = globals_of(SCENE, "StrainEnergy",
                          sets=("MaterialProperties/MPM/material/room_temp=400",))["StrainEnergy"]
        self.assertGreater(max(line[1] for line in hot), 1e2 * max(abs(line[1]) for line in cold[:5]))

    def test_a_restart_on_other_patches_gives_the_same_bits(self):
        expected = bits_of(run(SCENE).report)
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(SCENE, "DataArchiver/checkpoint/@timestepInterval=10", "Time/max_Timesteps=12",
                   "Grid/Level/Box/patches=[2,1,1]")
        code, errors, report = folder.restart("Time/max_Timesteps=100000", "Grid/Level/Box/patches=[3,2,1]", step=10)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(bits_of(report), expected)

    def test_what_cannot_be_is_refused(self):
        wide = run(SCENE, BOXES + "affineTransformation_A0=[3,0,0]", BOXES + "affineTransformation_A1=[0,1,0]",
                   "MPM/interpolator=gimp")
        self.assertEqual(wide.code, 3)
        self.assertIn("m is 1.5 cells wide along x, but with <interpolator> gimp at most one cell", wide.err)
        for change, sentence in ((BOXES + "affineTransformation_b=[1.1,0.2,0]", "outside the grid"),
                                 (BOXES + "affineTransformation_A0=[-0.8,0.6,0]", "determinant of A is not positive")):
            result = run(SCENE, change)
            self.assertEqual(result.code, 3)
            self.assertIn(sentence, result.err)


if __name__ == "__main__":
    unittest.main()
