#!/usr/bin/env python3
"""Forces and heat sources of gas: rest in a closed box, in explicit and implicit steps, and heat in a period."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of
from sus import run

SCENE = """<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>Gas in a closed box</title></Meta>
  <SimulationComponent type="ice"/>
  <Time><maxTime>{end}</maxTime><end_at_max_time_exactly>true</end_at_max_time_exactly></Time>
  <Grid><BoundaryConditions>{faces}</BoundaryConditions>
    <Level><Box label="1"><lower>[0,0,0]</lower><upper>[1,1,1]</upper><resolution>{cells}</resolution></Box></Level>
  </Grid>
  <DataArchiver><filebase>box.uda</filebase><outputInterval>0</outputInterval><save label="TotalEnergy"/>
    <save label="TotalMomentum"/><save label="KineticEnergy"/></DataArchiver>
  <CFD><cfl>{cfl}</cfl><ICE><advection type="SecondOrder"/>
    <TimeStepControl><knob_for_speedSound>{knob}</knob_for_speedSound>
      <Scheme_for_delT_calc>conservative</Scheme_for_delT_calc></TimeStepControl>{tags}</ICE>{exchange}</CFD>
  <PhysicalConstants><gravity>{gravity}</gravity><reference_pressure>0</reference_pressure></PhysicalConstants>
  <MaterialProperties><ICE>{gases}</ICE>{properties}</MaterialProperties>
</Uintah_specification>
"""
GAS = """<material name="gas{0}"><EOS type="ideal_gas"/><gamma>1.4</gamma><specific_heat>2.5</specific_heat>
  <dynamic_viscosity>0</dynamic_viscosity><thermal_conductivity>0</thermal_conductivity>
  <geom_object><box><min>[-9,-9,-9]</min><max>[9,9,9]</max></box><velocity>[0,0,0]</velocity><density>1</density>
  <temperature>1</temperature>{1}</geom_object></material>"""
FACES = "".join(f'<Face side="{side}"><BCType id="all" var="symmetry" label="Symmetric"/></Face>'
                for side in ("x-", "x+", "y-", "y+", "z-", "z+"))
IMPLICIT = "<ImplicitSolver><Solver><preconditioner>jacobi</preconditioner></Solver></ImplicitSolver>"
PUSH = "<fixedPressureGradient><x_dir>.2</x_dir></fixedPressureGradient>"
HEAT = ("<ADD_HEAT><add_heat_matls>[0]</add_heat_matls><add_heat_coeff>[2.]</add_heat_coeff>"
        "<add_heat_t_start>{}</add_heat_t_start><add_heat_t_final>{}</add_heat_t_final></ADD_HEAT>")


class Box(SceneTest):
    def box(self, end, cells="[20,1,1]", cfl=.4, knob=0, tags="", gravity="[0,0,0]", count=1):
        gases = (GAS.format("", "") if count == 1 else
                 "".join(GAS.format(k, "<volumeFraction>.5</volumeFraction>") for k in range(count)))
        return self.scene(SCENE.format(end=end, cells=cells, cfl=cfl, knob=knob, tags=tags, gravity=gravity,
                                       gases=gases, faces=FACES, exchange="", properties=""))


class DrivingForce(Box):
    def energies(self, **box):
        return [line[1] for line in globals_of(self.box(**box), "TotalEnergy")["TotalEnergy"]]

    def test_in_implicit_steps_compresses_gas_between_walls_as_gravity_does(self):
        pushed = self.energies(end=20, tags=IMPLICIT + PUSH)
        fallen = self.energies(end=20, tags=IMPLICIT, gravity="[.2,0,0]")
        self.assertGreater(len(pushed), 5, "steps are limited")
        self.assertAlmostEqual(pushed[-1], 2.5024, delta=2e-4)
        self.assertAlmostEqual(pushed[-1], fallen[-1], delta=1e-3)

    def test_in_implicit_steps_does_not_heat_gas_at_rest(self):
        energies = self.energies(end=40, knob=.5, tags=IMPLICIT + PUSH)
        self.assertAlmostEqual(energies[-1], energies[len(energies) // 2], delta=1e-3)


class Heat(Box):
    def test_that_raises_the_pressure_evenly_leaves_gas_at_rest_in_implicit_steps(self):
        for cells in ("[20,1,1]", "[8,6,1]"):
            path = self.box(end=.5, cells=cells, knob=1, tags=IMPLICIT + HEAT.format(0, 1))
            self.assertEqual(run(path).code, 0)
            found = globals_of(path, "TotalEnergy", "TotalMomentum")
            self.assertAlmostEqual(found["TotalEnergy"][-1][1], 3.5, delta=1e-12)
            self.assertLess(max(map(abs, found["TotalMomentum"][-1][1:])), 1e-13)

    def test_of_a_period_does_not_depend_on_the_steps(self):
        for cfl in (.4, .05):
            found = globals_of(self.box(end=.5, cells="[10,1,1]", cfl=cfl, tags=HEAT.format(.1, .15)), "TotalEnergy")
            self.assertAlmostEqual(found["TotalEnergy"][-1][1], 2.6, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
