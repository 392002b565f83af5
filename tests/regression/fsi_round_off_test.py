#!/usr/bin/env python3
"""Round-off in where bodies are changes forces and flow by round-off: grains smaller than a cell, edges on faces."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import archive_of, columns

SCENE = """<Uintah_specification>
<Meta><title>Bodies in a gas that moves</title></Meta>
<SimulationComponent type="mpmice"/>
<Time><maxTime>1</maxTime><max_Timesteps>{steps}</max_Timesteps></Time>
<Grid><Level><Box label="grid"><lower>[{x},0,0]</lower><upper>[{end},{height},{depth}]</upper>
<resolution>{cells}</resolution></Box></Level></Grid>
<DataArchiver><filebase>s.uda</filebase><outputLastTimestep/><save label="p.velocity"/><save label="c.velocity"/>
<save label="c.pressure"/></DataArchiver>
<CFD><cfl>.3</cfl><ICE><advection type="FirstOrder"/></ICE></CFD>
<MPM><time_integrator>explicit</time_integrator><interpolator>{shapes}</interpolator></MPM>
<PhysicalConstants><gravity>[0,0,0]</gravity><reference_pressure>1</reference_pressure></PhysicalConstants>
<MaterialProperties><MPM>{bodies}</MPM>
<ICE><material name="gas"><EOS type="ideal_gas"/><gamma>1.4</gamma><specific_heat>2.5</specific_heat>
<dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>{conductivity}</thermal_conductivity>
<geom_object><box label="all"><min>[-9,-9,-9]</min><max>[9,9,9]</max></box>
<density>1 + .3*sin(5*(x - {x})) + .2*cos(4*y)</density><temperature>1 + .2*sin(3*y + 2*z)</temperature>
<velocity>[.3*sin(4*y),.2*cos(5*(x - {x})),{upward}]</velocity></geom_object></material></ICE>
<exchange_properties><exchange_coefficients><momentum>{walls}</momentum><heat>{heat}</heat></exchange_coefficients>
</exchange_properties></MaterialProperties></Uintah_specification>"""
BODY = """<material name="{}"><density>5</density><constitutive_model type="comp_neo_hook">
<bulk_modulus>20</bulk_modulus><shear_modulus>5</shear_modulus></constitutive_model><specific_heat>1</specific_heat>
<thermal_conductivity>0</thermal_conductivity>
<geom_object>{}<res>{}</res><velocity>{}</velocity></geom_object></material>"""


def box(name, low, high):
    return f'<box label="{name}"><min>{list(low)}</min><max>{list(high)}</max></box>'


def state_of(bodies, x=0, steps=1, shapes="linear", conductivity=0, heat=0, **grid):
    """Returns pressures of the gas, velocities of the gas, and velocities of particles, by column."""
    pairs = len(bodies) * (len(bodies) + 1) // 2
    text = SCENE.format(x=x, shapes=shapes, steps=steps, bodies="".join(bodies), walls=[1e15] * pairs,
                        heat=[heat] * pairs, conductivity=conductivity, **grid)
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "scene.ups")
        scene.write_text(text)
        archive = archive_of(scene, folder)
        gas = columns(archive, "c.pressure", "c.velocity")
        return {key: values for of in (gas, columns(archive, "p.velocity")) for key, values in of.items()
                if "[m]" not in key}


class RoundOff(unittest.TestCase):
    def assert_close(self, one, other, limit):
        self.assertEqual(one.keys(), other.keys())
        for key, values in one.items():
            worst = max(abs(a - b) for a, b in zip(values, other[key]))
            self.assertLess(worst, limit, key)

    def grain(self, x, y):
        """A grain of 1/2 x 3/4 cells, two of whose edges are on faces of a cell if x and y are 0."""
        of = box("grain", (.125, .5, 0), (.1875, .59375, .2))
        of += f"<affineTransformation_b>[{x},{y},0]</affineTransformation_b>"  # particles are moved with the shape
        body = BODY.format("grain", of, "[4,4,1]", "[.15,0,0]")
        return state_of([body], end=1.25, height=1, depth=.125, cells="[10,8,1]", upward=0)

    def test_of_the_place_of_a_grain_smaller_than_a_cell(self):
        """Until 30 November 2026, its normal was that of round-off; a shift by 1e-7 of a cell changed v by 5 %."""
        expected = self.grain(0, 0)
        for x, y in ((-1e-8, 0), (0, -1e-8), (-1e-8, -1e-8), (1e-8, 1e-8)):
            self.assert_close(self.grain(x, y), expected, 1e-6)

    def warm_grain(self, shift):
        """A grain of half a cell, a particle whose centre is on a face if there is no shift."""
        of = box("grain", (.25, .5, 0), (.3125, .5625, .2))
        of += f"<affineTransformation_b>[{shift - .03125},0,0]</affineTransformation_b>"
        body = BODY.format("grain", of, "[2,2,1]", "[0,.2,0]").replace("</geom_object>", "<temperature>2</temperature>"
                                                                       "</geom_object>")
        return state_of([body], steps=3, shapes="gimp", conductivity=.1, heat=5, end=1.25, height=1, depth=.125,
                        cells="[10,8,1]", upward=0)

    def test_of_the_place_of_a_warm_grain(self):
        """Until 30 November 2026, the gas conducted heat to particles by the cells of their centres, and p changed by
        1.4e-2."""
        expected = self.warm_grain(0)
        for shift in (-1e-15, 1e-15, -1e-13, 1e-13):
            self.assert_close(self.warm_grain(shift), expected, 1e-11)

    def edge(self, x, y, steps):
        """A grain of 1 x 1.75 cells that moves along the faces on which its sides are, if there is no shift."""
        of = box("grain", (.25, .5, 0), (.375, .71875, .2))
        of += f"<affineTransformation_b>[{x},{y + .0625},0]</affineTransformation_b>"
        body = BODY.format("grain", of, "[4,4,1]", "[.2,-.1,0]")
        return state_of([body], steps=steps, shapes="gimp", end=1.25, height=1, depth=.125, cells="[10,8,1]",
                        upward=0)

    def test_of_the_edges_of_a_grain_that_moves(self):
        """Until 30 November 2026, a box of which 1e-12 of a cell moved through a face determined how the wall there
        moves, instead of the nodes: a shift by 1e-11 of a cell changed p by 3.6e-5."""
        for steps in (1, 4):
            expected = self.edge(0, 0, steps)
            for shift in (1e-12, 1e-10):
                for x, y in ((-shift, 0), (shift, 0), (0, -shift), (0, shift)):
                    self.assert_close(self.edge(x * .125, y * .125, steps), expected, 100 * shift)

    def two_bodies(self, x):
        ball = f'<sphere label="ball"><origin>[{.35 + x},.37,.42]</origin><radius>.21</radius></sphere>'
        bodies = [BODY.format("ball", ball, "[2,2,2]", "[.15,-.2,.25]"),
                  BODY.format("block", box("block", (.58 + x, .2, .25), (.83 + x, .62, .7)), "[2,2,2]",
                              "[-.3,-.06,-.25]")]
        return state_of(bodies, x, end=x + 1, height=.8, depth=.9, cells="[10,8,9]", upward=f".2*sin(4*(x - {x}))")

    def test_of_the_edges_of_one_of_two_bodies(self):
        """Until 30 November 2026, a box that covered 1e-16 of a face changed the pressure on all walls of the cell."""
        self.assert_close(self.two_bodies(-1), self.two_bodies(0), 1e-12)


if __name__ == "__main__":
    unittest.main()
