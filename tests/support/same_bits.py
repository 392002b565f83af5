"""Tests that the results of a scene are bitwise equal on any patches, threads and ranks, and after a restart."""
import pathlib

import gas_and_bodies as fsi
from sus import run
from uda import FolderTest


class SameBitsTest(FolderTest):
    def assert_same(self, name, steps, layouts, *sets, ranks):
        """The third of the `layouts` of patches runs on several ranks; every other layout on two threads."""
        scene = name if isinstance(name, pathlib.Path) else fsi.scene(name)
        sets = (f"Time/max_Timesteps={steps}", *sets)
        prints = {}
        for place, layout in enumerate(layouts):
            done = run(scene, *sets, f"Grid/Level/Box/patches={layout}", ranks=ranks if place == 2 else 1,
                       options=("--quiet", "-nthreads", str(1 + place % 2)))
            self.assertIsNotNone(done.report, done.err)
            prints.setdefault(done.report["fingerprint"], []).append(layout)
        in_parts = self.fingerprint_of_two_parts(scene, steps, *sets)
        prints.setdefault(in_parts, []).append("restarted")
        self.assertEqual(len(prints), 1, f"{name}: {prints}")
