#!/usr/bin/env python3
"""Gases on several levels: uniform pressure and velocity of several gases remain uniform, their volume fractions add up
to 1, and a scalar keeps its range; the same bits on any patches and ranks, after a restart, and for mirror images."""
import pathlib
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[up] / part) for up, part in
                ((1, "support"), (2, "tools/python"))]
from tushar.interpreter import ensure

ensure("h5py", "numpy")

import numpy as np

from sus import bits_of, run
from tushar.archive import Archive
from uda import FolderTest

OWN = "AMR/useLockStep=false"
CHECKPOINTS = ("DataArchiver/checkpoint/@timestepInterval=1", "DataArchiver/checkpoint/@cycle=100")
# Name, law, c_v, density and temperature at one pressure: of a gas beside liquids at 1e5 Pa, and of gases at 1 Pa.
LIQUIDS = (("air", "<EOS type='ideal_gas'/><gamma>1.4</gamma>", 717.5, 1e5 / (.4 * 717.5 * 300), 300),
           ("water", "<EOS type='stiffened_gas'><p_infinity>6e8</p_infinity></EOS><gamma>4.4</gamma>", 1000,
            (1e5 + 6e8) / (3.4 * 1000 * 300), 300),
           ("oil", "<EOS type='stiffened_gas'><p_infinity>3e8</p_infinity></EOS><gamma>3</gamma>", 800,
            (1e5 + 3e8) / (2 * 800 * 300), 300))
GASES = (("a", "<EOS type='ideal_gas'/><gamma>1.4</gamma>", 2.5, 1, 1),
         ("b", "<EOS type='ideal_gas'/><gamma>1.6</gamma>", 5, .1, 1 / .3),
         ("c", "<EOS type='ideal_gas'/><gamma>1.2</gamma>", 5, 4, .25))
# Volume fractions: in general, and in some intervals of x.
PARTS = ((-9, 9, (.3, .3, .4)), (.15, .175, (.2, .3, .5)), (.175, .2, (.3, .4, .3)), (.2, .22, (.6, .2, .2)),
         (.22, .29, (.1, .2, .7)), (.5, .59, (.6, .1, .3)), (.59, .64, (.5, .4, .1)))


def piece(lower, upper, content):
    return f"<geom_object><box><min>[{lower},-9,-9]</min><max>[{upper},9,9]</max></box>{content}</geom_object>"


def three_gases(laws, velocity):
    """Returns the materials of three gases at one pressure."""
    text = ""
    for k, (name, law, heat, density, temperature) in enumerate(laws):
        state = (f"<density>{density!r}</density><velocity>{velocity}</velocity>"
                 f"<temperature>{temperature!r}</temperature>")
        pieces = "".join(piece(lower, upper, f"{state}<volumeFraction>{shares[k]}</volumeFraction>")
                         for lower, upper, shares in PARTS)
        text += f"<material name='{name}'>{law}<specific_heat>{heat}</specific_heat>{pieces}</material>"
    return text


def two_gases():
    """Returns the materials of two gases that share all cells, with a shock."""
    text = ""
    for name, gamma, heat, shares in (("a", 1.4, 2.5, (.3, .8)), ("b", 1.6666666667, 1.5, (.7, .2))):
        pieces = "".join(piece(lower, upper, f"<density>{density}</density><temperature>1</temperature>"
                                             f"<volumeFraction>{share}</volumeFraction>")
                         for lower, upper, density, share in ((-9, .15, 5, shares[0]), (.15, 9, 1, shares[1])))
        text += (f"<material name='{name}'><EOS type='ideal_gas'/><gamma>{gamma}</gamma><specific_heat>{heat}"
                 f"</specific_heat>{pieces}</material>")
    return text


def scene_of(materials, saves, levels="", amr="", cells="[40,1,1]", periodic="[1,0,0]", models=""):
    """Returns a scene of gases on [0, 1], between walls or periodic along x."""
    sides = ("y", "z") if periodic[1] == "1" else ("x", "y", "z")
    sides = [side for side in sides if not (side == "y" and periodic[3] == "1")]
    faces = "".join(f'<Face side="{side}{end}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                    for side in sides for end in "-+")
    count = materials.count("<material ")
    exchange = (f"<exchange_properties><exchange_coefficients><momentum>[{','.join(['1e15'] * (2 * count - 3))}]"
                f"</momentum><heat>[{','.join(['0'] * (2 * count - 3))}]</heat></exchange_coefficients>"
                "</exchange_properties>") if count > 1 else ""
    saved = "".join(f'<save label="{save}"/>' for save in saves)
    return f"""<Uintah_specification>
  <Meta><title>gases on levels</title></Meta>
  <SimulationComponent type="ice"/>
  <Time><maxTime>1</maxTime></Time>
  <Grid>
    <BoundaryConditions>{faces}</BoundaryConditions>
    <Level>
      <Box><lower>[0,0,0]</lower><upper>[1,1,1]</upper><resolution>{cells}</resolution></Box>
      <periodic>{periodic}</periodic>
    </Level>
    {levels}
  </Grid>
  <AMR>{amr}</AMR>
  <DataArchiver>
    <filebase>gases.uda</filebase>
    <outputTimestepInterval>5</outputTimestepInterval><outputInitTimestep/><outputLastTimestep/>
    {saved}
  </DataArchiver>
  <CFD><cfl>0.4</cfl><ICE><advection type="SecondOrder"/></ICE></CFD>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties><ICE>{materials}</ICE>{exchange}</MaterialProperties>
  {models}
</Uintah_specification>"""


MIDDLE = "<Level><Box><lower>[0.2,0,0]</lower><upper>[0.6,1,1]</upper><resolution>[32,1,1]</resolution></Box></Level>"
BLOCKS = "<Regridder><min_patch_size>[[8,1,1]]</min_patch_size></Regridder>"
ADAPTIVE = ("<Regridder type='Tiled'><adaptive>true</adaptive><max_levels>3</max_levels><min_patch_size>[[8,8,1]]"
            "</min_patch_size><min_timestep_interval>4</min_timestep_interval></Regridder><ICE>"
            "<Refinement_Criteria_Thresholds><Variable name='rho_CC' value='.1'/>"
            "</Refinement_Criteria_Thresholds></ICE>")
# f is 1 in the dense gas and in a coarse cell beyond it, beside finer cells.
SCALAR = ("<Models><Model type='PassiveScalar'><PassiveScalar><scalar name='f'><constants><diffusivity>0</diffusivity>"
          f"</constants><initialization>{piece(-9, 9, '<scalar>0</scalar>')}{piece(0, .2, '<scalar>1</scalar>')}"
          "</initialization></scalar></PassiveScalar></Model></Models>")
CARRIER = ("<material name='gas'><EOS type='ideal_gas'/><gamma>1.4</gamma><specific_heat>2.5</specific_heat>"
           + piece(-9, 9, "<density>1</density><temperature>1</temperature><velocity>[1,0,0]</velocity>")
           + piece(0, .175, "<density>10</density><temperature>.1</temperature><velocity>[1,0,0]</velocity>")
           + "</material>")


class GasesOnLevels(FolderTest):
    maxDiff = None

    def ran(self, text, *sets):
        """Runs a scene given as text; returns its outputs and its report."""
        here = self.folder()
        scene = here.path / "gases.ups"
        scene.write_text(text)
        report = self.well(here.run(scene, *sets))
        return list(Archive(str(here.uda))), report

    def test_three_gases_at_rest_remain_at_rest_and_at_one_pressure(self):
        saves = ("press_CC", "vel_CC", "temp_CC")
        scene = scene_of(three_gases(LIQUIDS, "[0,0,0]"), saves, MIDDLE, BLOCKS)
        outputs, report = self.ran(scene, "Time/max_Timesteps=200")
        self.assertLess(abs(report["drift"]["mass"]), 1e-14)
        for output in outputs:
            np.testing.assert_allclose(output["c.pressure"].values, 1e5, atol=1e-5)  # round-off of the water is 1e-7 Pa
            np.testing.assert_allclose(output["c.velocity"].values, 0, atol=1e-10)
            np.testing.assert_allclose(output["c.temperature"].values, 300, rtol=1e-10)

    def test_three_gases_in_a_stream_remain_uniform(self):
        gases, saves = three_gases(GASES, "[1,.5,0]"), ("press_CC", "vel_CC")
        finer = scene_of(gases, saves, amr=ADAPTIVE, cells="[40,40,1]", periodic="[1,1,0]")
        for text, steps in ((finer, 40), (scene_of(gases, saves, MIDDLE, BLOCKS).replace(",.5,0]", ",0,0]"), 100)):
            for own in ("AMR/useLockStep=true", OWN):
                outputs, report = self.ran(text, own, f"Time/max_Timesteps={steps}")
                self.assertEqual(report["regrids"] > 0, text == finer)
                self.assertLess(abs(report["drift"]["mass"]), 1e-14)
                self.assertLess(abs(report["drift"]["energy"]), 1e-14)
                for output in outputs:
                    velocity = output["c.velocity"].values
                    np.testing.assert_allclose(output["c.pressure"].values, 1, rtol=1e-12)
                    np.testing.assert_allclose(velocity[..., 0], 1, rtol=1e-12)
                    np.testing.assert_allclose(velocity[..., 1], .5 if text == finer else 0, atol=1e-12)

    def test_volume_fractions_add_up_to_1_after_refluxing(self):
        for own in ("AMR/useLockStep=true", OWN):
            outputs, _ = self.ran(scene_of(two_gases(), ("vol_frac_CC",), MIDDLE, BLOCKS, periodic="[0,0,0]"), own,
                                  "Time/max_Timesteps=60")
            for output in outputs:
                sums = output["c.gasShare", "a"].values + output["c.gasShare", "b"].values
                np.testing.assert_allclose(sums, 1, atol=1e-12)

    def test_a_scalar_does_not_leave_its_range(self):
        for levels, amr, cells in ((MIDDLE, BLOCKS, "[40,1,1]"), ("", ADAPTIVE, "[40,40,1]")):
            text = scene_of(CARRIER, ("scalar-f", "totalSum_scalar-f"), levels, amr, cells, "[1,0,0]", SCALAR)
            outputs, report = self.ran(text, "Time/max_Timesteps=60")
            for output in outputs:
                f = output["c.scalar-f"].values
                self.assertGreaterEqual(f.min(), -1e-12)
                self.assertLessEqual(f.max(), 1 + 1e-12)

    def test_the_same_bits_on_any_patches_threads_and_ranks(self):
        scenes = (scene_of(three_gases(GASES, "[1,.5,0]"), ("rho_CC",), amr=ADAPTIVE, cells="[40,40,1]",
                           periodic="[1,1,0]"),
                  scene_of(two_gases(), ("rho_CC",), amr=ADAPTIVE, cells="[40,40,1]", periodic="[0,1,0]"),
                  scene_of(CARRIER, ("scalar-f", "totalSum_scalar-f"), amr=ADAPTIVE, cells="[40,40,1]",
                           periodic="[1,1,0]", models=SCALAR))
        for text in scenes:
            for own in ("AMR/useLockStep=true", OWN):
                if own == OWN and "PassiveScalar" in text:
                    continue  # needs one step for all levels
                here = self.folder()
                scene = here.path / "gases.ups"
                scene.write_text(text)
                found = set()
                for layout, threads, ranks in (("1x1x1", 1, 1), ("2x3x1", 2, 1), ("8x8x8", 1, 2), ("1x1x1", 1, 3)):
                    options = ("--quiet", "--layout", layout, "--nthreads", str(threads))
                    report = run(scene, own, "Time/max_Timesteps=20", options=options, ranks=ranks).report
                    found.add((bits_of(report), report["steps"], report["regrids"]))
                self.assertEqual(len(found), 1, found)
                self.well(here.run(scene, own, *CHECKPOINTS, "Time/max_Timesteps=11"))
                report = self.well(here.finish(["-restart", here.uda, "-t", 9], ["Time/max_Timesteps=20"]))
                self.assertEqual(bits_of(report), found.pop()[0])

    def test_a_mirrored_scene_has_mirrored_bits(self):
        ends = []
        for sign in (1, -1):
            gases = three_gases(GASES, f"[{sign},.5,0]")
            if sign < 0:
                for lower, upper, _ in PARTS[1:]:
                    gases = gases.replace(f"<min>[{lower},", "<MIN>[").replace(f"<max>[{upper},", f"<max>[{1 - lower},")
                    gases = gases.replace("<MIN>[", f"<min>[{1 - upper},")
            text = scene_of(gases, ("rho_CC", "press_CC", "vol_frac_CC"), amr=ADAPTIVE, cells="[64,64,1]",
                            periodic="[1,1,0]")
            ends.append(self.ran(text, "Time/max_Timesteps=16")[0][-1])
        ours, image = ends
        for name in (("c.gasMass", "a"), ("c.pressure", None), ("c.gasShare", "b")):
            np.testing.assert_array_equal(np.flip(ours[name].values, 2), image[name].values, str(name))


if __name__ == "__main__":
    unittest.main()
