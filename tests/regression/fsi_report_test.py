#!/usr/bin/env python3
"""What the report of a run with bodies in a gas says of their exchange: against saved totals, and on any layout."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import gas_and_bodies as fsi
from fsi_test import DISC, LIGHT, PLUG, WARM, also, changed, rigid
from solids import globals_of
from uda import FolderTest

SAVED = ("GasImpulseOnBodies", "GasWorkOnBodies", "GasHeatToBodies", "GasLeak", "MergedCells", "LeastFreeVolume")
# A light rigid disc in a wind.
BLOWN = changed(rigid(DISC), LIGHT, ("<temperature>5<", "<temperature>15<"))
ON_25 = fsi.resolution("carried_disc", 25)


class Report(FolderTest):
    def scene(self, text):
        scene = self.folder().path / "scene.ups"
        scene.write_text(text)
        return scene

    def test_says_what_the_saved_totals_say(self):
        folder, scene = self.folder(), self.scene(also(WARM, *SAVED))
        found = self.well(folder.run(scene, "Time/maxTime=0.3"))["of_run"]
        saved = globals_of(scene, *SAVED, sets=("Time/maxTime=0.3",))
        last = {name: saved[name][-1][1] for name in SAVED}
        # The sums have another order: of steps instead of cells.
        self.assertAlmostEqual(found["impulse_on_bodies"][0] / last["GasImpulseOnBodies"], 1, delta=1e-12)
        self.assertAlmostEqual(found["work_on_bodies"] / last["GasWorkOnBodies"], 1, delta=1e-12)
        self.assertAlmostEqual(found["heat_to_bodies"] / last["GasHeatToBodies"], 1, delta=1e-12)
        self.assertEqual(found["leak"], last["GasLeak"])
        self.assertEqual(found["merged_cells"], sum(line[1] for line in saved["MergedCells"]))
        self.assertEqual(found["least_free_volume"], min(line[1] for line in saved["LeastFreeVolume"]))

    def test_shows_costly_numbers_only_if_they_are_saved(self):
        report = self.well(self.folder().run(self.scene(PLUG), "Time/max_Timesteps=2"))
        self.assertNotIn("leak", report["of_run"])
        self.assertNotIn("mpmice::measureLeak", report["tasks"]["kept"])
        self.assertNotIn("heat_to_bodies", report["of_run"])

    def test_shows_the_energy_of_gas_and_bodies(self):
        for text, sets in ((PLUG, ()), (WARM, ("Time/maxTime=0.3",)), (BLOWN, (*ON_25, "Time/maxTime=0.2"))):
            drift = self.well(self.folder().run(self.scene(text), *sets))["drift"]
            self.assertLess(abs(drift["energy"]), 1e-13)
        elastic = self.well(self.folder().run("ups/fsi/closed_box.ups", "Grid/Level/Box/resolution=[50,1,1]"))
        self.assertLess(abs(elastic["drift"]["energy"]), 1.5 * 8e-6)
        self.assertGreater(abs(elastic["drift"]["energy"]), 1e-7)  # the update of particles loses some

    def test_is_the_same_on_patches_on_ranks_and_after_a_restart(self):
        scene, often = self.scene(also(BLOWN, "GasLeak")), "DataArchiver/checkpoint/@timestepInterval=20"
        found = []
        for layout, ranks, steps in (("[1,1,1]", 1, 41), ("[3,2,1]", 1, 41), ("[5,5,1]", 3, 41), ("[1,2,1]", 1, 21)):
            folder = self.folder(ranks)
            report = self.well(folder.run(scene, often, *ON_25, f"Time/max_Timesteps={steps}", layout=layout))
            found.append([report["of_run"], report["drift"]])
        report = self.well(folder.restart(*ON_25, "Time/max_Timesteps=41", step=20))
        found[-1] = [report["of_run"], report["drift"]]
        self.assertGreater(abs(found[0][0]["impulse_on_bodies"][0]), 1e-6)
        for other in found[1:]:
            self.assertEqual(other, found[0])


if __name__ == "__main__":
    unittest.main()
