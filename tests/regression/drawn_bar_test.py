#!/usr/bin/env python3
"""A cube of copper, drawn out by implicit steps to nearly twice its length, against the closed form: it flows and
heats."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import last_state

SCENE = """<Uintah_specification>
  <Meta><title>A cube of copper is drawn out at constant speed</title></Meta>
  <SimulationComponent type="impm"/>
  <Time>
    <maxTime>9.1</maxTime>
    <delt_init>0.05</delt_init>
    <delt_max>0.05</delt_max>
    <timestep_multiplier>1</timestep_multiplier>
  </Time>
  <MPM>
    <time_integrator>implicit</time_integrator>
    <dynamic>false</dynamic>
    <do_grid_reset>false</do_grid_reset>
  </MPM>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties>
    <MPM>
      <material name="piston">
        <density>8930</density>
        <constitutive_model type="rigid"/>
        <geom_object>
          <box><min>[0,0,0.01]</min><max>[0.01,0.01,0.02]</max></box>
          <res>[1,1,1]</res>
          <velocity>[0,0,1e-3]</velocity>
        </geom_object>
      </material>
      <material name="bar">
        <density>8930</density>
        <specific_heat>414</specific_heat>
        <melt_temp>1356</melt_temp>
        <constitutive_model type="elastic_plastic">
          <bulk_modulus>129e9</bulk_modulus><shear_modulus>46e9</shear_modulus>
          <flow_model type="johnson_cook"><A>90e6</A><B>292e6</B><C>0.025</C><n>0.31</n><m>1.09</m></flow_model>
        </constitutive_model>
        <geom_object>
          <box><min>[0,0,0]</min><max>[0.01,0.01,0.01]</max></box>
          <res>[1,1,1]</res>
          <temperature>296</temperature>
        </geom_object>
      </material>
      <contact><type>rigid</type><direction>[0,0,1]</direction></contact>
    </MPM>
  </MaterialProperties>
  <Grid>
    <BoundaryConditions>
      <Face side="x-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>
      <Face side="y-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>
      <Face side="z-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>
    </BoundaryConditions>
    <Level>
      <Box label="box">
        <lower>[0,0,0]</lower>
        <upper>[0.03,0.03,0.03]</upper>
        <resolution>[3,3,3]</resolution>
      </Box>
    </Level>
  </Grid>
  <DataArchiver>
    <filebase>bar.uda</filebase>
    <outputLastTimestep>true</outputLastTimestep>
    <save label="p.x"/>
    <save label="p.plasticStrain"/>
    <save label="p.temperature"/>
    <save label="p.deformationMeasure"/>
    <save label="p.stress"/>
  </DataArchiver>
</Uintah_specification>
"""
COPPER = dict(density=8930, heat=414, young=9 * 129e9 * 46e9 / (3 * 129e9 + 46e9))


def yield_stress(strain, rate, temperature):
    """Returns Johnson and Cook's yield stress with Uintah's factors for rates below 1/s and temperatures below T_r."""
    t = (temperature - 298) / (1793 - 298)
    faster = (1 + rate)**.025 if rate < 1 else 1 + .025 * math.log(rate)
    return (90e6 + 292e6 * strain**.31) * faster * (1 - t if t < 0 else 1 - t**1.09)


def drawn(end, steps=20000):
    """Plastic strain and temperature at a time: the true strain is ln(1 + v t/L_0), less that of the stress; a share of
    .9 of the work stays as heat."""
    plastic, temperature, speed = 0, 296, .1
    for k in range(steps):
        time = (k + 1) * end / steps
        rate = speed / (1 + speed * time)
        stress = yield_stress(plastic, rate, temperature)
        flowed = max(math.log(1 + speed * time) - stress / COPPER["young"] - plastic, 0)
        temperature += .9 * stress * flowed / (COPPER["density"] * COPPER["heat"])
        plastic += flowed
    return plastic, temperature


class DrawnBar(unittest.TestCase):
    def state(self, step):
        """Returns plastic strain and temperature after 9.1 s."""
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "bar.ups")
            scene.write_text(SCENE)
            state = last_state(scene, "p.plasticStrain", "p.temperature", material="bar",
                               sets=(f"Time/delt_init={step}", f"Time/delt_max={step}",
                                     f"Time/max_Timesteps={round(9.1 / step)}"))
        return state["p.plasticStrain [1]"][0], state["p.temperature [K]"][0]

    def test_flows_and_heats_as_its_closed_form(self):
        plastic, temperature = drawn(9.1)
        coarse, fine = self.state(.1), self.state(.05)
        self.assertAlmostEqual(fine[0], plastic, delta=2e-3)
        self.assertAlmostEqual(fine[1] - 296, temperature - 296, delta=.2)
        for c, f, exact in zip(coarse, fine, (plastic, temperature)):
            self.assertAlmostEqual((c - exact) / (f - exact), 2, delta=.3)  # of first order in the step


if __name__ == "__main__":
    unittest.main()
