#!/usr/bin/env python3
"""Metals along prescribed deformations: heat of the dashpots of hypoViscoElastic, energy of damaged particles."""
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from solids import SceneTest, globals_of, last_state

SCENE = """<?xml version="1.0"?>
<Uintah_specification>
  <Meta><title>A particle of metal</title></Meta>
  <SimulationComponent type="mpm"/>
  <Time><maxTime>{end}</maxTime><initTime>0</initTime><delt_min>0</delt_min><delt_max>{step}</delt_max>
    <timestep_multiplier>.9</timestep_multiplier></Time>
  <DataArchiver><filebase>metal.uda</filebase><outputInterval>0</outputInterval><outputLastTimestep/>
    <save label="p.temperature"/><save label="StrainEnergy"/>{save}</DataArchiver>
  <MPM><time_integrator>explicit</time_integrator><interpolator>linear</interpolator>
    <UsePrescribedDeformation>true</UsePrescribedDeformation>
    <PrescribedDeformationFile>{path}</PrescribedDeformationFile></MPM>
  <PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
  <MaterialProperties><MPM><material name="metal"><density>8930</density><thermal_conductivity>0</thermal_conductivity>
    <specific_heat>414</specific_heat><room_temp>294</room_temp><melt_temp>1356</melt_temp>
    <constitutive_model type="elastic_plastic"><shear_modulus>46e9</shear_modulus><bulk_modulus>129e9</bulk_modulus>
      <initial_material_temperature>294</initial_material_temperature>
      <taylor_quinney_coeff>.9</taylor_quinney_coeff><equation_of_state type="default_hyper"/>
      <flow_model type="isotropic_hardening"><K>0</K><sigma_Y>{strength}</sigma_Y></flow_model>{deviator}
      <yield_condition type="vonMises"/></constitutive_model>{damage}
    <geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[1,1,1]</res><velocity>[0,0,0]</velocity>
      <temperature>294</temperature></geom_object></material></MPM></MaterialProperties>
  <Grid><BoundaryConditions/><Level><Box label="1"><lower>[-2,-2,-2]</lower><upper>[3,3,3]</upper>
    <resolution>[5,5,5]</resolution></Box></Level></Grid>
</Uintah_specification>
"""
DASHPOT = ('<deviatoric_stress_model type="hypoViscoElastic"><mu>[30e9,16e9]</mu><tau>[.003,1000]</tau>'
           '</deviatoric_stress_model>')
DAMAGE = ('<damage_model type="johnson_cook"><D1>.02</D1><D2>0</D2><D3>0</D3><D4>0</D4><D5>0</D5>'
          '</damage_model>')


class Metal(SceneTest):
    def path(self, *deformations):
        """A file of times and deformation gradients; nothing rotates."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name, "path.txt")
        path.write_text("".join(f"{time} {deformation} 0 0 0 1\n" for time, deformation in deformations))
        return path

    def test_the_work_of_dashpots_becomes_heat(self):
        """A shear of .02 within .1 ms, then rest for 16 tau. Until 29 November 2026, the temperature stayed."""
        path = self.path((0, "1 0 0 0 1 0 0 0 1"), (1e-4, "1 .02 0 0 1 0 0 0 1"), (.05, "1 .02 0 0 1 0 0 0 1"))
        text = SCENE.format(end=.05, step=1e-5, save="", path=path, strength=1e15, deviator=DASHPOT, damage="")
        [temperature] = last_state(self.scene(text), "p.temperature")["p.temperature [K]"]
        mu, tau, ramp = 30e9, .003, 1e-4
        kept = math.exp(-ramp / tau)
        highest = mu * .02 / ramp * tau  # of the shear stress, in a ramp without end
        in_ramp = highest ** 2 / (mu * tau) * (ramp - 2 * tau * (1 - kept) + tau / 2 * (1 - kept ** 2))
        at_rest = (highest * (1 - kept)) ** 2 / (2 * mu)
        self.assertAlmostEqual((float(temperature) - 294) * 8930 * 414 / (.9 * (in_ramp + at_rest)), 1, delta=5e-3)

    def test_damage_without_erosion_leaves_the_energy(self):
        path = self.path((0, "1 0 0 0 1 0 0 0 1"), (4e-3, "1.1 0 0 0 1 0 0 0 1"), (5e-3, "1.2 0 0 0 1 0 0 0 1"))
        text = SCENE.format(end=4e-3, step=2e-5, save='<save label="p.damage"/><save label="p.localizedMPM"/>',
                            path=path, strength=3e8, deviator="", damage=DAMAGE)
        scene = self.scene(text)
        state = last_state(scene, "p.damage", "p.localizedMPM")
        self.assertGreater(float(state["p.damage [1]"][0]), 1)
        self.assertEqual(int(state["p.localizedMPM [1]"][0]), 0)
        energies = [line[1] for line in globals_of(scene, "StrainEnergy")["StrainEnergy"]]
        self.assertGreater(energies[-1], max(energies[:-1]), "as its stress, the energy of a step grows")


if __name__ == "__main__":
    unittest.main()
