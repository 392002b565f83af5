#!/usr/bin/env python3
"""Gas and bodies on a grid of several boxes: bodies fill the cells along inner sides, and the gas flows as in one box
that they fill; the same bits on any layout; gas at an inner side is refused."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools/python"))
import tushar
from gas_and_bodies import changed
from solids import SceneTest, archive_of, globals_of
from sus import bits_of, run
from uda import FolderTest

BOX = "<Box><lower>[{}]</lower><upper>[{}]</upper><resolution>[{}]</resolution></Box>"
LEGS = (BOX.format("0,0,0", "1,0.5,0.03125", "32,16,1") +
        BOX.format("0.375,0.5,0", "0.625,1,0.03125", "8,16,1"))
ONE = BOX.format("0,0,0", "1,1,0.03125", "32,32,1")
SYMMETRY = '<Face side="{}"><BCType id="all" label="Symmetric" var="symmetry"/></Face>'
PRESSURE = ('<Face side="{}"><BCType id="0" label="Pressure" var="Dirichlet"><value>1</value></BCType>'
            '<BCType id="1" label="Velocity" var="Neumann"><value>[0,0,0]</value></BCType></Face>')
PATHS = """<union><box label="along"><min>[-1,0.046875,-1]</min><max>[2,0.453125,1]</max></box>
<box label="up"><min>[0.4375,0.046875,-1]</min><max>[0.5625,1,1]</max></box></union>"""
WALLS = f"""<difference><box label="all"><min>[0,0,-1]</min><max>[1,1,1]</max></box>{PATHS}</difference>"""
MATERIAL = """<material name="{}"><density>{}</density><specific_heat>1</specific_heat>
<thermal_conductivity>0</thermal_conductivity><constitutive_model type="comp_neo_hook"><bulk_modulus>1000</bulk_modulus>
<shear_modulus>100</shear_modulus></constitutive_model><geom_object>{}<res>[2,2,1]</res><velocity>[{}]</velocity>
<temperature>1</temperature></geom_object></material>"""
DISC = "<cylinder label=\"disc\"><bottom>[0.2,0.25,-1]</bottom><top>[0.2,0.25,1]</top><radius>0.1</radius></cylinder>"
SCENE = f"""<Uintah_specification><Meta><title>Gas in a channel with a shaft</title></Meta>
<SimulationComponent type="rmpmice"/><Time><maxTime>0.25</maxTime></Time>
<Grid><BoundaryConditions>{"".join(map(PRESSURE.format, ("x-", "x+")))}
{"".join(map(SYMMETRY.format, ("y-", "y+", "z-", "z+")))}</BoundaryConditions><Level>{LEGS}</Level></Grid>
<DataArchiver><filebase>shaft.uda</filebase><outputInterval>0.25</outputInterval><outputLastTimestep/>
<save label="c.density"/><save label="c.momentum"/><save label="c.totalEnergy"/><save label="c.freeVolume"/>
<save label="GasMass"/><save label="GasEnergy"/><save label="GasWorkOnBodies"/></DataArchiver>
<CFD><cfl>0.4</cfl><ICE><advection type="SecondOrder"/></ICE></CFD>
<MPM><time_integrator>explicit</time_integrator><interpolator>linear</interpolator></MPM>
<PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>1</reference_pressure></PhysicalConstants>
<MaterialProperties><MPM>{MATERIAL.format("walls", 100, WALLS, "0,0,0")}{MATERIAL.format("disc", 50, DISC, "0.5,0.1,0")}
<contact><type>null</type></contact></MPM>
<ICE><material name="gas"><EOS type="ideal_gas"/><gamma>1.4</gamma><specific_heat>2.5</specific_heat>
<dynamic_viscosity>0.001</dynamic_viscosity><thermal_conductivity>0.005</thermal_conductivity>
<geom_object><difference>{PATHS}<box label="charge"><min>[-1,0.7,-1]</min><max>[2,1,1]</max></box></difference>
<density>1</density><temperature>1</temperature></geom_object>
<geom_object><box label="charge"/><density>4</density><temperature>1.5</temperature></geom_object></material></ICE>
<exchange_properties><exchange_coefficients><momentum>[1e15,1e15,1e15]</momentum><heat>[0,1,1]</heat>
</exchange_coefficients></exchange_properties></MaterialProperties></Uintah_specification>"""
NAMES = ("c.density", "c.momentum", "c.totalEnergy", "c.freeVolume")
MESSAGE = "of a cell free that lies at an inner side of the grid"


def implicit(text):
    solver = '<advection type="SecondOrder"/><ImplicitSolver><max_outer_iterations>5</max_outer_iterations>' \
             "<Parameters><tolerance>1e-10</tolerance></Parameters></ImplicitSolver>"
    return changed(text, ('<advection type="SecondOrder"/>', solver))


def elastic(text):
    """The scene with a gas that may push the walls, and without the disc."""
    disc = MATERIAL.format("disc", 50, DISC, "0.5,0.1,0")
    return changed(text, ('"rmpmice"', '"mpmice"'), (disc, ""), ("[1e15,1e15,1e15]", "[1e15]"), ("[0,1,1]", "[1]"),
                   *((PRESSURE.format(side), SYMMETRY.format(side)) for side in ("x-", "x+")))


class InnerSides(SceneTest):
    def fields(self, text):
        """The fields inside the boxes of the scene at the end."""
        with tempfile.TemporaryDirectory() as folder:
            with tushar.open(archive_of(self.scene(text), folder))[-1] as last:
                return [last[name][:] for name in NAMES], last.grid.mask("cell")

    def test_gas_flows_as_in_one_box_that_bodies_fill(self):
        for name, text in (("explicit", SCENE), ("implicit", implicit(SCENE))):
            with self.subTest(name):
                found, inside = self.fields(text)
                expected, _ = self.fields(text.replace(LEGS, ONE))
                self.assertEqual(int(inside.sum()), 640)
                for one, other in zip(found, expected):
                    self.assertEqual(one[inside].tobytes(), other[inside].tobytes())
                    self.assertTrue((one[~inside] == 0).all())
                self.assertGreater(float(np.abs(found[1]).max()), .05)

    def test_what_gas_and_elastic_walls_exchange_is_conserved(self):
        for name, text in (("explicit", elastic(SCENE)), ("implicit", implicit(elastic(SCENE)))):
            with self.subTest(name):
                text = changed(text, ("<heat>[1]", "<heat>[0]"))
                lines = globals_of(self.scene(text), "GasMass", "GasEnergy", "GasWorkOnBodies")
                mass, energy, work = (np.array(lines[one])[:, 1] for one in lines)
                self.assertLess(np.abs(mass / mass[0] - 1).max(), 1e-13)
                self.assertLess(np.abs((energy + work) / energy[0] - 1).max(), 1e-12)
                self.assertGreater(np.abs(work).max(), 1e-9)

    def test_gas_at_an_inner_side_ends_the_run(self):
        wide = "<box label=\"up\"><min>[0.375,0.046875,-1]</min><max>[0.5625,1,1]</max></box>"
        text = changed(SCENE, ('<box label="up"><min>[0.4375,0.046875,-1]</min><max>[0.5625,1,1]</max></box>', wide))
        done = run(self.scene(text))
        self.assertNotEqual(done.code, 0)
        self.assertIn("bodies leave 1 " + MESSAGE + ", at (0.390625, 0.515625, 0.015625)", done.err)

    def test_a_body_that_leaves_an_inner_side_ends_the_run(self):
        done = run(self.scene(changed(SCENE, (f"{WALLS}<res>[2,2,1]</res><velocity>[0,0,0]",
                                              f"{WALLS}<res>[2,2,1]</res><velocity>[0.3,0,0]"))))
        self.assertNotEqual(done.code, 0)
        self.assertIn(MESSAGE, done.err)


class Layouts(FolderTest, SceneTest):
    def test_have_the_same_bits_on_any_number_of_threads_and_ranks_and_after_a_restart(self):
        scene, steps = self.scene(SCENE), 40
        prints = {self.bits_of_two_parts(scene, steps)}
        for layout, threads, ranks in (("1x1x1", 1, 1), ("3x2x1", 2, 1), ("4x5x1", 1, 3), ("8x1x1", 2, 2)):
            done = run(scene, f"Time/max_Timesteps={steps}", ranks=ranks,
                       options=("--quiet", "-layout", layout, "-nthreads", str(threads)))
            self.assertIsNotNone(done.report, done.err)
            prints.add(bits_of(done.report))
        self.assertEqual(len(prints), 1)


if __name__ == "__main__":
    unittest.main()
