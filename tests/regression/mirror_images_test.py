#!/usr/bin/env python3
"""Mirror images of particles beyond symmetry planes: half of a body moves like half of the whole, nothing is pushed off
a plane, and no momentum along it is lost."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
import tushar
from solids import SceneTest, archive_of, globals_of
from sus import run

STEPS = 30
SPLINES = ("3rdorderBS", "4thorderBS")
IMAGES = "<mirror_images>true</mirror_images>"
METHODS = [(shapes, "") for shapes in SPLINES] + [(shapes, IMAGES) for shapes in ("gimp", "cpdi")]
UPDATES = ("", "<stress_update>musl</stress_update>", "<stress_update>usf</stress_update>", "<XPIC2>true</XPIC2>",
           "<apic>true</apic>", "<artificial_viscosity>true</artificial_viscosity>",
           "<DoExplicitHeatConduction>false</DoExplicitHeatConduction><UseGradientEnhancedVelocityProjection>true"
           "</UseGradientEnhancedVelocityProjection>")


def material(lower, upper, velocity):
    return f"""<material><density>1000</density>
  <constitutive_model type="comp_neo_hook"><bulk_modulus>1e5</bulk_modulus><shear_modulus>5e4</shear_modulus>
  </constitutive_model><thermal_conductivity>0</thermal_conductivity><specific_heat>1</specific_heat><geom_object>
  <box><min>{lower}</min><max>{upper}</max></box><res>[2,2,2]</res><velocity>{velocity}</velocity>
  <temperature>300</temperature></geom_object></material>"""


def scene(shapes, tags, cells, bodies, contact=""):
    """A scene on a grid of cells of 1 m, between the ends along each axis, with symmetry planes all around."""
    lower, upper = ([int(one[end]) for one in cells] for end in (0, 1))
    planes = "".join(f'<Face side="{axis}{end}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
                     for axis in "xyz" for end in "-+")
    return f"""<?xml version="1.0"?><Uintah_specification><SimulationComponent type="mpm"/>
<Time><maxTime>100</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>1</delt_max>
<timestep_multiplier>.4</timestep_multiplier><max_Timesteps>{STEPS}</max_Timesteps></Time>
<Grid><Level><Box><lower>{lower}</lower><upper>{upper}</upper>
<resolution>{[one[1] - one[0] for one in cells]}</resolution></Box></Level>
<BoundaryConditions>{planes}</BoundaryConditions></Grid>
<MPM><time_integrator>explicit</time_integrator><interpolator>{shapes}</interpolator>{tags}</MPM>
<MaterialProperties><MPM>{"".join(bodies)}{contact}</MPM></MaterialProperties>
<DataArchiver><filebase>o.uda</filebase><outputTimestepInterval>{STEPS}</outputTimestepInterval>
<save label="TotalMomentum"/><save label="p.x"/><save label="p.velocity"/><save label="p.stress"/></DataArchiver>
</Uintah_specification>"""


def is_available(shapes, update):
    return shapes != "cpdi" or "apic" not in update


class Images(SceneTest):
    def particles(self, text):
        """Positions, velocities and stresses at the end, of all materials, in the order of x, then y, then z."""
        with tempfile.TemporaryDirectory() as folder:
            with tushar.open(archive_of(self.scene(text), folder))[-1] as last:
                x, v, stress = (last[name][:] for name in ("p.x", "p.velocity", "p.stress"))
        order = np.lexsort(np.round(x, 3).T[::-1])
        return x[order], v[order], stress.reshape(len(x), -1)[order]

    def assert_half_of(self, whole, part, axes):
        """Asserts that the particles of a part in front of symmetry planes at 0 move like those of the whole."""
        whole, part = self.particles(whole), self.particles(part)
        in_front = (whole[0][:, axes] > 0).all(axis=1)
        for name, all_values, found in zip(("x", "velocity", "stress"), whole, part):
            expected = all_values[in_front]
            self.assertEqual(expected.shape, found.shape)
            error = np.abs(found - expected).max() / np.abs(expected).max()
            self.assertLess(error, 1e-11, name)

    def test_half_of_a_body_moves_like_half_of_the_whole(self):
        velocity = "[.3*(x-8),-.3*y,0]"
        for shapes, tags in METHODS:
            for update in UPDATES:
                if not is_available(shapes, update):
                    continue
                with self.subTest(shapes=shapes, update=update):
                    whole, half = (scene(shapes, tags + update, [(0, 16), (low, 3), (0, 1)],
                                         [material(f"[4,{edge},0]", "[12,1.5,1]", velocity)])
                                   for low, edge in ((-3, -1.5), (0, 0)))
                    self.assert_half_of(whole, half, [1])

    def test_the_eighth_of_a_block_moves_like_an_eighth_of_the_whole(self):
        velocity = "[.5*x,-.4*y+.02*y^3,.1*z]"
        for shapes, tags in METHODS:
            with self.subTest(shapes):
                whole, eighth = (scene(shapes, tags, [(low, 4)] * 3,
                                       [material(f"[{-size},{-size},{-size}]", "[2,2,2]", velocity)])
                                 for low, size in ((-4, 2), (0, 0)))
                self.assert_half_of(whole, eighth, [0, 1, 2])

    def test_two_bodies_that_meet_at_a_plane_move_like_half_of_the_whole(self):
        contacts = ("<contact><type>single_velocity</type><materials>[0,1]</materials></contact>",
                    "<contact><type>friction</type><materials>[0,1]</materials><mu>.3</mu></contact>")
        for shapes, tags in METHODS:
            for one in contacts:
                with self.subTest(shapes=shapes, contact=one):
                    whole, half = (scene(shapes, tags, [(0, 16), (low, 3), (0, 1)],
                                         [material(f"[4,{edge},0]", "[8,1.5,1]", "[1,-.3*y,0]"),
                                          material(f"[8,{edge},0]", "[12,1.5,1]", "[-1,.1*y,0]")], one)
                                   for low, edge in ((-3, -1.5), (0, 0)))
                    self.assert_half_of(whole, half, [1])

    def test_stress_along_a_plane_pushes_nothing_off_it(self):
        for shapes, tags in METHODS:
            with self.subTest(shapes):
                bar = [material("[2,0,0]", "[8,3,1]", "[.5,0,0]"),
                       material("[8,0,0]", "[14,3,1]", "[-.5,0,0]")]
                v = self.particles(scene(shapes, tags, [(0, 16), (0, 3), (0, 1)], bar))[1]
                self.assertGreater(np.abs(v[:, 0]).max(), .1)
                self.assertLess(np.abs(v[:, 1]).max(), 1e-12)

    def test_no_momentum_along_a_plane_is_lost(self):
        for shapes, tags in METHODS:
            with self.subTest(shapes):
                text = scene(shapes, tags, [(0, 24), (0, 3), (0, 1)],
                             [material("[8,0,0]", "[14,1.5,1]", "[1+.2*(y-.7)*(x-11),-.2*y,0]")])
                lines = np.array(globals_of(self.scene(text), "TotalMomentum",
                                            sets=["DataArchiver/outputTimestepInterval=0"])["TotalMomentum"])
                self.assertLess(np.ptp(lines[:, 1]) / lines[0, 1], 1e-13)

    def test_layouts_ranks_threads_and_restarts_give_the_same_bits(self):
        for shapes, tags in METHODS:
            text = self.scene(scene(shapes, tags, [(0, 4), (0, 4), (0, 3)],
                                    [material("[0,0,0]", "[2,2.5,2]", "[.5*x,-.4*y+.1*z,.1*z]")]))
            expected = run(text).report["fingerprint"]
            for options, ranks in ((("--layout", "4x4x3"), 1), (("--layout", "4x2x3", "--nthreads", "2"), 1),
                                   (("--layout", "2x4x1"), 2), (("--layout", "4x1x3"), 3)):
                with self.subTest(shapes=shapes, options=options):
                    ended = run(text, options=("--quiet", *options), ranks=ranks)
                    self.assertEqual(ended.report["fingerprint"], expected)

    def test_gimp_and_cpdi_have_images_only_if_the_scene_says_so(self):
        for shapes in ("gimp", "cpdi", *SPLINES):
            prints = {}
            for tags in ("", IMAGES, IMAGES.replace("true", "false")):
                text = scene(shapes, tags, [(0, 4), (0, 4), (0, 1)],
                             [material("[0,0,0]", "[2,2.5,1]", "[.5*x,-.4*y,0]")])
                prints[tags] = run(self.scene(text)).report["fingerprint"]
            first, second, third = prints.values()
            self.assertNotEqual(second, third)
            self.assertEqual(first, second if shapes in SPLINES else third)


if __name__ == "__main__":
    unittest.main()
