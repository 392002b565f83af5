#!/usr/bin/env python3
"""Sides of a gas with a given Pressure: that of gas at rest under gravity, and inflow whose temperature continues."""
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of, last_state
from sus import run

SCENE = """<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>Gas between sides with a given pressure</title></Meta>
  <SimulationComponent type="ice"/>
  <Time><maxTime>{end}</maxTime><end_at_max_time_exactly>true</end_at_max_time_exactly></Time>
  <Grid><BoundaryConditions>{faces}</BoundaryConditions>
    <Level><Box label="1"><lower>[0,1,0]</lower><upper>[1,2,1]</upper><resolution>{cells}</resolution></Box></Level>
  </Grid>
  <DataArchiver><filebase>sides.uda</filebase><outputInterval>0</outputInterval><outputLastTimestep/>
    <save label="TotalEnergy"/>
    <save label="c.temperature"/></DataArchiver>
  <CFD><cfl>.4</cfl><ICE><advection type="SecondOrder"/>{tags}</ICE></CFD>
  <PhysicalConstants><gravity>{gravity}</gravity><reference_pressure>0</reference_pressure></PhysicalConstants>
  <MaterialProperties><ICE>{gases}</ICE>{exchange}</MaterialProperties>
</Uintah_specification>
"""
GAS = """<material name="gas{0}"><EOS type="ideal_gas"/><gamma>1.4</gamma><specific_heat>2.5</specific_heat>
  <dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>0</thermal_conductivity>
  <geom_object><box><min>[-9,-9,-9]</min><max>[9,9,9]</max></box><velocity>[0,0,0]</velocity>
  <density>1</density><temperature>1</temperature>{1}</geom_object>{2}</material>"""
AROUND = "<isSurroundingMatl>true</isSurroundingMatl>"
EXCHANGE = ("<exchange_properties><exchange_coefficients><momentum>[1e15]</momentum><heat>[0]</heat>"
            "</exchange_coefficients></exchange_properties>")
IMPLICIT = "<ImplicitSolver><Solver><preconditioner>jacobi</preconditioner></Solver></ImplicitSolver>"
NO = "<applyHydrostaticPressure>false</applyHydrostaticPressure>"
MIRROR = "".join(f'<Face side="{side}"><BCType id="all" var="symmetry" label="Symmetric"/></Face>'
                 for side in ("y-", "y+", "z-", "z+"))


def side(name, pressure, more=""):
    return (f'<Face side="{name}"><BCType id="0" label="Pressure" var="Dirichlet"><value>{pressure}</value></BCType>'
            f'{more}</Face>')


def scene(faces, gases, tags="", gravity="[0,-.1,0]", cells="[8,8,1]", end=.5):
    return SCENE.format(faces=faces + MIRROR, gases=gases, tags=tags, gravity=gravity, cells=cells, end=end,
                        exchange=EXCHANGE if gases.count("<material") > 1 else "")


class Hydrostatic(SceneTest):
    ONE = GAS.format("", "", AROUND)
    TWO = (GAS.format("A", "<volumeFraction>.5</volumeFraction>", "") +
           GAS.format("B", "<volumeFraction>.5</volumeFraction>", AROUND))

    def energies(self, pressure, gases, tags):
        text = scene(side("x-", pressure) + side("x+", pressure), gases, tags)
        return [line[1] for line in globals_of(self.scene(text), "TotalEnergy")["TotalEnergy"]]

    def test_given_pressures_rise_by_the_weight_of_the_gas_around(self):
        for gases in (self.ONE, self.TWO):
            for solver in ("", IMPLICIT):
                found = self.energies("1", gases, solver)
                expected = self.energies("1 - .1*(y - 1.0625)", gases, solver + NO)
                level = self.energies("1", gases, solver + NO)
                self.assertEqual(len(found), len(expected))
                self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), 1e-11)
                self.assertGreater(abs(found[-1] - level[-1]), 1e-3)

    def test_they_are_the_same_on_two_levels(self):
        levels = ("<AMR><Regridder><adaptive>true</adaptive><max_levels>2</max_levels><min_patch_size>[[4,4,4]]"
                  "</min_patch_size></Regridder><ICE><Refinement_Criteria_Thresholds><Variable name=\"c.pressure\" "
                  "value=\".01\"/></Refinement_Criteria_Thresholds></ICE></AMR>")
        ends = []
        for pressure, tags in (("1", ""), ("1 - .1*(y - 1.03125)", NO)):
            text = scene(side("x-", pressure) + side("x+", pressure), self.ONE, tags, cells="[16,16,1]")
            text = text.replace("<DataArchiver>", levels + "<DataArchiver>")
            ends.append(globals_of(self.scene(text), "TotalEnergy")["TotalEnergy"][-1][1])
        self.assertAlmostEqual(ends[0], ends[1], delta=1e-11)

    def test_the_weight_is_that_of_the_gas_in_the_first_cell(self):
        """Its region does not contain the corner of the grid, and is not the first."""
        thin = ("<geom_object><sphere><origin>[.5,1.5,.5]</origin><radius>.1</radius></sphere>"
                "<velocity>[0,0,0]</velocity><density>.1</density><temperature>10</temperature></geom_object>")
        gas = self.ONE.replace("<geom_object>", thin + "<geom_object>", 1).replace("[-9,-9,-9]", "[.001,1.001,0]")
        found = self.energies("1", gas, "")
        expected = self.energies("1 - .1*(y - 1.0625)", gas, NO)
        self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), 1e-11)

    def test_it_does_not_rise_along_a_periodic_axis(self):
        """Gravity along a periodic axis accelerates a uniform gas, and nothing else."""
        density = '<BCType id="0" label="Density" var="Dirichlet"><value>1</value></BCType>'
        text = scene(side("y-", 1, density) + side("y+", 1, density), self.ONE, gravity="[.2,0,0]", end=.2)
        for name in ("y-", "y+"):
            text = text.replace(f'<Face side="{name}"><BCType id="all" var="symmetry" label="Symmetric"/></Face>', "")
        text = text.replace("</Box>", "</Box><periodic>[1,0,0]</periodic>").replace("c.temperature", "c.velocity")
        speeds = last_state(self.scene(text), "c.velocity")["c.velocity.x [m/s]"]
        self.assertLess(max(abs(u - .2 * .2) for u in map(float, speeds)), 1e-13)

    def test_it_needs_a_gas_around(self):
        text = scene(side("x-", 1), GAS.format("", "", ""), NO.replace("false", "true"))
        done = run(self.scene(text))
        self.assertEqual(done.code, 3)
        self.assertIn("applyHydrostaticPressure: needs a gas with <isSurroundingMatl> true", done.err)


class OpenSides(SceneTest):
    """A column of gas at rest under gravity, closed below. Until 30 November 2026, the pressure of explicit steps had
    no gradient at the open side, so that gas poured in: at .4 m/s and more, on any grid."""

    WAVES = "".join(f'<BCType id="all" label="{name}" var="LODI"/>' for name in ("Pressure", "Velocity"))

    def speed(self, cells, condition, gases=1):
        """The greatest speed in an isothermal column after a time in which sound crosses it twice."""
        top = f'<Face side="y+">{condition}</Face>'
        if "LODI" in condition:
            top += f"<LODI><press_infinity>{math.exp(-.5)}</press_infinity></LODI>"
        share = f"<volumeFraction>{1 / gases}</volumeFraction>"
        gas = "".join(GAS.format(k, share, "") for k in range(gases))
        gas = gas.replace("<density>1<", "<density>exp(-.5*(y - 1))<")
        text = scene(top, gas, gravity="[0,-.5,0]", cells=f"[1,{cells},1]", end=2)
        for name in ("x-", "x+"):
            text = text.replace("</BoundaryConditions>", '<Face side="' + name + '"><BCType id="all" var="symmetry" '
                                'label="Symmetric"/></Face></BoundaryConditions>')
        text = text.replace('<Face side="y+"><BCType id="all" var="symmetry" label="Symmetric"/></Face>', "", 1)
        text = text.replace("c.temperature", "c.velocity")
        return max(abs(float(v)) for v in last_state(self.scene(text), "c.velocity")["c.velocity.y [m/s]"])

    def test_a_column_stays_at_rest_as_if_it_were_closed(self):
        """What moves is gas beside the wall below: half as much on half as wide cells."""
        flat = '<BCType id="all" label="Pressure" var="Neumann"><value>0</value></BCType>'
        closed = self.speed(32, '<BCType id="all" label="Symmetric" var="symmetry"/>')
        for condition in (self.WAVES, "", flat):
            coarse, fine = self.speed(16, condition), self.speed(32, condition)
            with self.subTest(condition, coarse=coarse, fine=fine, closed=closed):
                self.assertLess(fine, 1.02 * closed)
                self.assertLess(fine, .51 * coarse)

    def test_a_column_of_two_gases_stays_at_rest(self):
        for condition in (self.WAVES, ""):
            self.assertAlmostEqual(self.speed(32, condition, gases=2), self.speed(32, condition), delta=1e-9)


class Inflow(SceneTest):
    def test_the_temperature_continues_where_the_scene_asks_for_it(self):
        """A flow from a side at p = 1.02 to one at 1. Until 29 November 2026, the density continued, and the gas became
        warmer from step to step."""
        flat = '<BCType id="0" label="Temperature" var="Neumann"><value>0</value></BCType>'
        faces = side("x-", "1.02", flat) + side("x+", "1", flat)
        for tags in ("", IMPLICIT):
            text = scene(faces, GAS.format("", "", ""), tags, gravity="[0,0,0]", cells="[16,1,1]", end=10)
            warm = last_state(self.scene(text), "c.temperature")["c.temperature [K]"]
            self.assertLess(max(abs(t - 1) for t in map(float, warm)), .006)


if __name__ == "__main__":
    unittest.main()
