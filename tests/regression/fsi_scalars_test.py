#!/usr/bin/env python3
"""Scalars that a gas beside bodies carries: they stay within their range, their total stays, on any layout alike."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_implicit_test import implicit
from fsi_test import CONTACT, DISC, PLUG, also, changed
from solids import RefusedSceneTest, SceneTest, archive_of, columns, globals_of
from sus import run

F, TOTAL = "c.scalar-f [1]", "totalSum_scalar-f"
TRACE = 1e-9  # kg/m³
END = "</Uintah_specification>"


def region(value, start="[-9,-9,-9]", end="[9,9,9]", label="all of it"):
    return (f'<geom_object><box label="{label}"><min>{start}</min><max>{end}</max></box><scalar>{value}</scalar>'
            "</geom_object>")


def carrying(text, regions, sources="", diffusivity=0):
    """The scene with a scalar f that its gas carries."""
    constants = f"<constants><diffusivity>{diffusivity}</diffusivity></constants>"
    scalar = f'<scalar name="f">{constants}<initialization>{regions}</initialization>{sources}</scalar>'
    model = f'<Models><Model type="PassiveScalar"><PassiveScalar>{scalar}</PassiveScalar></Model></Models>'
    return changed(also(text, "c.scalar-f", "c.density"), (END, model + END))


class Scalars(SceneTest):
    def values(self, text, *sets):
        """The scalar in all cells with gas, and the masses of these; pores of bodies hold traces."""
        scene = self.scene(text)
        found = columns(archive_of(scene, scene.parent, *sets), "c.scalar-f", "c.density")
        return [(f, mass) for f, mass in zip(found[F], found["c.density [kg/m^3]"]) if mass > TRACE]

    def test_that_are_uniform_stay_so(self):
        disc = fsi.resolution("carried_disc", 25)
        for text, sets in ((PLUG, ()), (CONTACT, ()), (DISC, disc), (implicit(DISC), disc)):
            found = self.values(carrying(text, region("0.7")), *sets)
            self.assertGreater(len(found), 20)
            self.assertLess(max(abs(f - .7) for f, _ in found), 1e-12)

    def test_stay_within_their_range_and_keep_their_total(self):
        parts = region("0") + region("1", "[0.6,-1,-1]", "[0.97,2,2]", "left") + region(
            "0.5", "[1.02,-1,-1]", "[1.3,2,2]", "right")
        for text in (PLUG, implicit(PLUG)):
            text = carrying(text, parts)
            found = self.values(text)
            self.assertGreater(min(f for f, _ in found), -1e-9)
            self.assertLess(max(f for f, _ in found), 1 + 1e-9)
            totals = globals_of(self.scene(also(text, TOTAL)), TOTAL)[TOTAL]
            self.assertGreater(totals[0][1], .5)
            self.assertLess(max(abs(line[1] / totals[0][1] - 1) for line in totals), 1e-13)

    def test_go_with_the_gas_that_follows_a_wall(self):
        # The gas left of a plug has 1, the gas right of it 0: none gets through.
        text = carrying(PLUG, region("0") + region("1", "[-1,-1,-1]", "[1,2,2]", "left"))
        scene = self.scene(text)
        found = columns(archive_of(scene, scene.parent), "c.scalar-f", "c.density")
        body = [k for k, mass in enumerate(found["c.density [kg/m^3]"]) if mass < TRACE]
        for k, (f, mass) in enumerate(zip(found[F], found["c.density [kg/m^3]"])):
            if mass > TRACE:
                self.assertAlmostEqual(f, 1 if k < body[0] else 0, delta=1e-12)

    def test_have_sources(self):
        source = ("<interiorSources>" + region("0.01", "[0.2,-1,-1]", "[0.4,2,2]", "source").replace(
            "</scalar>", "</scalar><maxScalar>0.5</maxScalar>") + "</interiorSources>")
        found = self.values(carrying(PLUG, region("0"), source))
        self.assertGreater(max(f for f, _ in found), .3)
        self.assertLess(max(f for f, _ in found), .5 + 1e-9)

    def test_are_the_same_on_any_patches(self):
        text = carrying(fsi.scene("ball").read_text(), region("0") + region("1", "[0,0,0]", "[0.5,9,9]", "part"))
        scene = self.scene(text)
        found = set()
        for place, layout in enumerate(("[1,1,1]", "[3,2,2]", "[2,1,4]")):
            folder = scene.parent / str(place)
            folder.mkdir()
            archive = archive_of(scene, folder, "Time/max_Timesteps=15", "Grid/Level/Box/resolution=[20,12,12]",
                                 f"Grid/Level/Box/patches={layout}")
            found.add(columns(archive, "c.scalar-f")[F])
        self.assertEqual(len(found), 1)

    def test_do_not_change_the_flow(self):
        prints = {run(self.scene(text), "Time/max_Timesteps=50").report["fingerprint"]
                  for text in (PLUG, carrying(PLUG, region("x")))}
        self.assertEqual(len(prints), 1)


class WrongScenes(RefusedSceneTest):
    def test_scalars_do_not_diffuse_beside_bodies(self):
        self.assert_refused(carrying(PLUG, region("0"), diffusivity=.1), "0.1 m^2/s is not available with bodies")


if __name__ == "__main__":
    unittest.main()
