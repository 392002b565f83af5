#!/usr/bin/env python3
"""Arenisca, Arenisca3, ArrudaBoyce8, and visco_scram that heat expands: bitwise equal results on any patches, threads
and ranks, and after a restart."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import bits_of, run
from uda import Folder

SOIL = """<B0>6e8</B0><G0>4e8</G0><PEAKI1>9e5</PEAKI1><FSLOPE>0.4</FSLOPE>
<T1_rate_dependence>1e-5</T1_rate_dependence><T2_rate_dependence>0.1</T2_rate_dependence>
<p0_crush_curve>-3e6</p0_crush_curve><p1_crush_curve>2e-7</p1_crush_curve><p3_crush_curve>0.12</p3_crush_curve>
<CR>0.4</CR><fluid_B0>1e8</fluid_B0><fluid_pressure_initial>0</fluid_pressure_initial>"""
MODELS = {
    "Arenisca": SOIL + """<p4_fluid_effect>1e8</p4_fluid_effect><hardening_modulus>0</hardening_modulus>
<FSLOPE_p>0.4</FSLOPE_p><gruneisen_parameter>0</gruneisen_parameter>
<subcycling_characteristic_number>10</subcycling_characteristic_number>
<kinematic_hardening_constant>0</kinematic_hardening_constant>""",
    "Arenisca3": SOIL + """<STREN>2e8</STREN><YSLOPE>0.05</YSLOPE><BETA_nonassociativity>1</BETA_nonassociativity>
<B1>0</B1><B2>0</B2><B3>0</B3><B4>0</B4><G1>0</G1><G2>0</G2><G3>0</G3><G4>0</G4><p2_crush_curve>0</p2_crush_curve>""",
    "ArrudaBoyce8": "<bulk_modulus>2e7</bulk_modulus><shear_modulus>2e6</shear_modulus><beta>3</beta>",
    "visco_scram": """<PR>0.3</PR><CrackParameterA>1e-3</CrackParameterA><CrackPowerValue>10</CrackPowerValue>
<CrackMaxGrowthRate>300</CrackMaxGrowthRate><StressIntensityF>5e4</StressIntensityF><CrackFriction>0.35</CrackFriction>
<InitialCrackRadius>3e-5</InitialCrackRadius><CrackGrowthRate>1</CrackGrowthRate><Gamma>1</Gamma>
<CoeffThermalExpansion>1e-4</CoeffThermalExpansion><G1>2e6</G1><RTau1>0</RTau1><G2>2e6</G2><RTau2>1e3</RTau2>
<G3>0</G3><RTau3>0</RTau3><G4>0</G4><RTau4>0</RTau4><G5>0</G5><RTau5>0</RTau5>"""}
CAPACITIES = {"visco_scram": 1000}  # J/(kg K): cracks heat it
BODY = """<material name="{name}"><density>2000</density>
<constitutive_model type="{model}">{tags}</constitutive_model>
<specific_heat>{capacity}</specific_heat><thermal_conductivity>0</thermal_conductivity>
<geom_object><cylinder label="{name}"><bottom>[{x},{y},0]</bottom><top>[{x},{y},0.1]</top>
<radius>0.2</radius></cylinder>
<res>[2,2,1]</res><velocity>[{speed},{speed},0]</velocity><temperature>300</temperature></geom_object></material>
"""
SCENE = """<Uintah_specification><Meta><title>A disc of {model} meets another</title></Meta>
<SimulationComponent type="mpm"/>
<Time><maxTime>1</maxTime><max_Timesteps>60</max_Timesteps><timestep_multiplier>0.4</timestep_multiplier></Time>
<MPM><time_integrator>explicit</time_integrator><interpolator>gimp</interpolator></MPM>
<PhysicalConstants><gravity>[0,0,0]</gravity></PhysicalConstants>
<MaterialProperties><MPM>{bodies}
<contact><type>approach</type><mu>0.2</mu></contact></MPM></MaterialProperties>
<Grid><BoundaryConditions>
<Face side="z-"><BCType id="all" var="symmetry" label="Symmetric"/></Face>
<Face side="z+"><BCType id="all" var="symmetry" label="Symmetric"/></Face>
</BoundaryConditions><Level><Box label="0">
<lower>[0,0,0]</lower><upper>[1,1,0.1]</upper><resolution>[10,10,1]</resolution><patches>[1,1,1]</patches>
</Box></Level></Grid>
<DataArchiver><filebase>discs.uda</filebase><outputInterval>0</outputInterval>
<save label="StrainEnergy"/><save label="KineticEnergy"/></DataArchiver></Uintah_specification>
"""


def scene_of(model, folder):
    capacity = CAPACITIES.get(model, 1)
    bodies = [BODY.format(name=f"body{k}", model=model, tags=MODELS[model], x=x, y=y, speed=speed, capacity=capacity)
              for k, (x, y, speed) in enumerate([(.36, .36, 4), (.64, .64, -4)])]
    path = pathlib.Path(folder, model + ".ups")
    path.write_text(SCENE.format(model=model, bodies="".join(bodies)))
    return path


class SoilsAndRubber(unittest.TestCase):
    def on_all_layouts(self, model, *changes):
        """Asserts that all runs of a changed scene are bitwise equal; returns their fingerprint."""
        with tempfile.TemporaryDirectory() as folder:
            scene = scene_of(model, folder)
            expected = run(scene, *changes)
            self.assertEqual((expected.code, expected.err), (0, ""))
            for change in ({"sets": ["Grid/Level/Box/patches=[3,2,1]"]},
                           {"sets": ["Grid/Level/Box/patches=[2,2,1]"], "ranks": 2},
                           {"sets": ["Grid/Level/Box/patches=[2,2,1]"],
                            "options": ("--quiet", "--nthreads", "2")}):
                result = run(scene, *changes, *change.pop("sets"), **change)
                self.assertEqual(result.report["fingerprint"], expected.report["fingerprint"], change)
            archive = Folder()
            self.addCleanup(archive.cleanup)
            archive.run(scene, *changes, "DataArchiver/checkpoint/@timestepInterval=30", "Time/max_Timesteps=40")
            code, errors, report = archive.restart("Time/max_Timesteps=60", "Grid/Level/Box/patches=[2,3,1]", step=30)
            self.assertEqual((code, errors), (0, ""))
            self.assertEqual(bits_of(report), bits_of(expected.report))
            return bits_of(expected.report)

    def test_arenisca(self):
        self.on_all_layouts("Arenisca")

    def test_arenisca3(self):
        self.on_all_layouts("Arenisca3")

    def test_arruda_boyce(self):
        self.on_all_layouts("ArrudaBoyce8")

    def test_visco_scram_that_heat_expands(self):
        coefficient = "MaterialProperties/MPM/material[1]/constitutive_model/CoeffThermalExpansion=0"
        with tempfile.TemporaryDirectory() as folder:
            stiff = run(scene_of("visco_scram", folder), coefficient)
        self.assertEqual(stiff.code, 0, stiff.err)
        self.assertNotEqual(self.on_all_layouts("visco_scram"), stiff.report["fingerprint"])

    def test_a_normal_of_each_body(self):
        with tempfile.TemporaryDirectory() as folder:
            shared = run(scene_of("ArrudaBoyce8", folder)).report["fingerprint"]
        self.assertNotEqual(self.on_all_layouts("ArrudaBoyce8", "MPM/computeColinearNormals=false"), shared)


if __name__ == "__main__":
    unittest.main()
