#!/usr/bin/env python3
"""The gases of ups/stability, as `euler` on three levels that follow them: none dies, whose steps each level takes, and
nothing is lost. Density and pressure are checked to be positive after every step."""
import pathlib
import re
import sys
import unittest

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "support")]

from sus import ROOT, run
from uda import FolderTest

MOST_STEPS = 600  # of the finest level; beyond, many_steps.ups takes 100 000
# What is no ideal gas by boxes, has no cells to refine, or gains mass through a side.
OTHERS = {"air_bubble", "heat_ratio", "nearly_empty", "noh_2d", "one_cell", "random", "softening", "stiff_contrast",
          "stiff_incompressible", "stiff_steel", "vacuum", "water_air", "water_shock"}
OPEN = {"sod_moving"}
CHANGES = ((r"<!--.*?-->", ""), (r"<(patches|res|temperature|max_Timesteps)>.*?</\1>", ""))


def section(text, tag):
    return re.search(f"<{tag}>.*?</{tag}>", text, re.S).group(0)


def scene_of(path):
    """The gas of a particle scene, on cells twice as large and up to three levels."""
    text = path.read_text()
    for pattern, instead in CHANGES:
        text = re.sub(pattern, instead, text, flags=re.S)
    law = re.search(r'<constitutive_model type="ideal_gas">(.*?)</constitutive_model>', text, re.S).group(1)
    bodies = "".join(re.findall(r"<geom_object>.*?</geom_object>", text, re.S))
    halved = re.sub(r"<resolution>\[(.*?)\]", lambda found: "<resolution>[%s]" % ",".join(
        str(max(1, int(count) // 2)) for count in found.group(1).split(",")), section(text, "Grid"))
    return f"""<Uintah_specification>
  <Meta><title>{path.stem}</title></Meta><SimulationComponent type="euler"/>
  {section(text, "Time")}{halved}
  <AMR><Regridder><adaptive>true</adaptive><max_levels>3</max_levels></Regridder></AMR>
  <DataArchiver><filebase>gallery.uda</filebase></DataArchiver>
  <Euler><gas>{law}</gas>{bodies}</Euler>
</Uintah_specification>"""


class GalleryOnLevels(FolderTest):
    def test_every_gas_lives_and_nothing_is_lost(self):
        scenes = [one for one in sorted((ROOT / "ups/stability").glob("*.ups")) if one.stem not in OTHERS]
        self.assertGreater(len(scenes), 20)
        for one in scenes:
            copy = self.folder().path / one.name
            copy.write_text(scene_of(one))
            for lockstep, steps in (("true", MOST_STEPS), ("false", MOST_STEPS // 4)):
                done = run(copy, f"AMR/useLockStep={lockstep}", f"Time/max_Timesteps={steps}")
                self.assertEqual(done.code, 0, f"{one.stem}: {done.err}")
                for total in () if one.stem in OPEN else ("mass", "energy"):
                    self.assertLessEqual(abs(done.report["drift"][total]), 1e-13, f"{one.stem} {total}")


if __name__ == "__main__":
    unittest.main()
