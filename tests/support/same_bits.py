"""Tests that the results of a scene, also what is only saved, have the same bits on any layout and after a restart."""
import pathlib

import gas_and_bodies as fsi
from sus import bits_of, run
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
            prints.setdefault(bits_of(done.report), []).append(layout)
        in_parts = self.bits_of_two_parts(scene, steps, *sets)
        prints.setdefault(in_parts, []).append("restarted")
        self.assertEqual(len(prints), 1, f"{name}: {prints}")
