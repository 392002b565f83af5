#!/usr/bin/env python3
"""Bodies whose particles a file lists: a box if it lists those of a box, with the variables of the file, on any layout,
and after a restart."""
import itertools
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import RefusedSceneTest, SceneTest, globals_of, last_state
from sus import ROOT, bits_of, run
from uda import Folder

SCENE = "ups/solid/crushed_foam.ups"
TEXT = (ROOT / SCENE).read_text()
FILE = "<file><name>crushed_foam.pts</name></file>"
BOX = "<box><min>[0,0,0]</min><max>[0.008,0.008,0.008]</max></box>"
SHORT = "Time/max_Timesteps=60"


def scene_of(case, body, lines=None):
    """Returns the path of the scene with another body than the foam, next to a file with these lines."""
    path = case.scene(TEXT.replace(FILE, body))
    if lines:
        (path.parent / "particles.pts").write_text("\n".join(lines) + "\n")
    return path


class ListedParticles(SceneTest):
    def test_of_a_box_move_as_the_box(self):
        axis = [(k + .5) * .0005 for k in range(16)]
        lines = [f"{x!r} {y!r} {z!r}" for z, y, x in itertools.product(axis, axis, axis)]
        names = ("KineticEnergy", "StrainEnergy", "TotalMass")
        listed = globals_of(scene_of(self, "<file><name>particles.pts</name></file>", lines), *names, sets=(SHORT,))
        box = globals_of(scene_of(self, BOX), *names, sets=(SHORT,))
        for name in names:
            scale = max(abs(line[1]) for line in box[name])
            for one, other in zip(listed[name], box[name], strict=True):
                self.assertAlmostEqual(one[1] / scale, other[1] / scale, delta=1e-12)
        self.assertEqual(len(listed["TotalMass"]), 61)

    def test_have_the_variables_of_the_file(self):
        body = ("<file><name>particles.pts</name><var>p.color</var><var>p.velocity</var><var>p.volume</var>"
                "<var>p.temperature</var></file>")
        path = scene_of(self, body, ("0.002 0.002 0.002 7 1 2 3 1e-10 310", "0.006 0.006 0.006 8 -1 0 1 2e-10 320"))
        text = path.read_text().replace('<save label="p.x"/>', "".join(
            f'<save label="{name}"/>' for name in ("p.x", "p.color", "p.velocity", "p.mass", "p.temperature")))
        path.write_text(text)
        state = last_state(path, "p.color", "p.velocity", "p.mass", "p.temperature", material="foam",
                           sets=("Time/max_Timesteps=1", "DataArchiver/outputLastTimestep=true",
                                 "MPM/DoExplicitHeatConduction=true",
                                 "MaterialProperties/MPM/material[1]/specific_heat=1",
                                 "MaterialProperties/MPM/material[2]/specific_heat=1"))
        self.assertEqual(state["p.color [1]"], (7, 8))
        self.assertEqual([state[f"p.velocity.{axis} [m/s]"] for axis in "xyz"], [(1, -1), (2, 0), (3, 1)])
        self.assertEqual(state["p.temperature [K]"], (310, 320))
        for mass, expected in zip(state["p.mass [kg]"], (1e-7, 2e-7), strict=True):
            self.assertAlmostEqual(mass / expected, 1, delta=1e-14)

    def test_may_have_edges_in_any_order_in_a_plane_too(self):
        before, *_, after = re.split(r"<geom_object>.*?</geom_object>",
                                     (ROOT / "ups/solid/placed_bodies.ups").read_text(), flags=re.S)
        energies = []
        for edges in ("{0} 0 0 0 {0} 0 0 0 {1}", "0 {0} 0 {0} 0 0 0 0 {1}", "0 0 {1} 0 {0} 0 {0} 0 0",
                      "0 {0} 0 0 0 {1} {0} 0 0", "-{0} 0 0 0 -{0} 0 0 0 {1}"):
            path = self.scene("")
            bodies = ""
            for name, corner, speed in (("left", .2, 1), ("right", .45, -1)):
                xs, ys = ([start + (k + .5) * .025 for k in range(8)] for start in (corner, .2))
                (path.parent / f"{name}.pts").write_text("".join(
                    f"{x!r} {y!r} .025 {edges.format('.025', '.05')}\n" for y in ys for x in xs))
                bodies += (f"<geom_object><file><name>{name}.pts</name><var>p.rvec1</var><var>p.rvec2</var>"
                           f"<var>p.rvec3</var></file><res>[2,2,1]</res><velocity>[{speed},0,0]</velocity>"
                           "<temperature>300</temperature></geom_object>")
            path.write_text(before + bodies + after)
            energies.append(globals_of(path, "KineticEnergy", "StrainEnergy"))
        scale = energies[0]["KineticEnergy"][0][1]
        self.assertGreater(max(line[1] for line in energies[0]["StrainEnergy"]) / scale, .1)
        for found in energies[1:]:
            for name, lines in found.items():
                for one, other in zip(lines, energies[0][name], strict=True):
                    self.assertAlmostEqual(one[1] / scale, other[1] / scale, delta=1e-9)

    def test_have_the_same_bits_on_any_layout_and_after_a_restart(self):
        expected = bits_of(run(SCENE, SHORT).report)
        for layout, ranks in (("[2,2,1]", 1), ("[1,3,2]", 2)):
            self.assertEqual(bits_of(run(SCENE, SHORT, f"Grid/Level/Box/patches={layout}", ranks=ranks).report),
                             expected)
        folder = Folder()
        self.addCleanup(folder.cleanup)
        folder.run(SCENE, "DataArchiver/checkpoint/@timestepInterval=20", "Time/max_Timesteps=24")
        code, errors, report = folder.restart(SHORT, "Grid/Level/Box/patches=[2,1,2]", step=20)
        self.assertEqual((code, errors), (0, ""))
        self.assertEqual(bits_of(report), expected)


class RefusedLists(RefusedSceneTest):
    def test_are_told_with_their_place(self):
        for body, sentence in (
                (FILE + BOX, "geom_object/box: <file> lists all particles of this body; remove this tag, or put it "
                             "into a <geom_object> of its own"),
                ("<file><name>nowhere.pts</name></file>", "nowhere.pts' cannot be read: there is no such file"),
                ("<file/>", "missing tag <name> in <file>")):
            self.assert_refused(TEXT.replace(FILE, body), sentence)
        done = run(scene_of(self, "<file><name>particles.pts</name></file>", ("0 0 0", "1 2", "0 0 3 0")))
        self.assertEqual(done.code, 3)
        self.assertIn("particles.pts:2: found 2 numbers, expected 3: x y z", done.err)
        self.assertIn("particles.pts:3: found 4 numbers, expected 3: x y z", done.err)
        done = run(scene_of(self, "<file><name>particles.pts</name></file>", ("0.001 0.001 0.02",)))
        self.assertIn("a particle would start at (0.001, 0.001, 0.02) m, outside the grid", done.err)


if __name__ == "__main__":
    unittest.main()
