#!/usr/bin/env python3
"""Input for solids that the method would ignore or misread is refused at its place."""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from sus import ROOT, run

BEAM, BILLET, BLOCK, CYLINDER, SPALL = (f"ups/solid/{name}.ups" for name in (
    "implicit_cantilever", "billet", "pushed_block", "thick_cylinder", "spall"))
CONDITIONS, GEOMETRY = "</BoundaryConditions>", "<geom_object>"
TEMPERATURE = '<Face side="x+"><BCType id="ID" label="Temperature" var="KIND"><value>VALUE</value></BCType></Face>'
HEAT = """<PhysicalBC><MPM><heat_flux><geom_object><box><min>[1,.4,0]</min><max>[1,.6,.05]</max></box></geom_object>
          <load_curve><time_point><time>0</time><load>1</load></time_point></load_curve></heat_flux></MPM></PhysicalBC>
          <Grid>"""


def heat_flow(kind, value):
    return (CONDITIONS, TEMPERATURE.replace("ID", "all").replace("KIND", kind).replace("VALUE", value) + CONDITIONS)


RUBBER = '''<constitutive_model type="comp_neo_hook">
          <bulk_modulus>166667</bulk_modulus>
          <shear_modulus>76923</shear_modulus>'''
METAL = '<constitutive_model type="elastic_plastic"><bulk_modulus>1</bulk_modulus><shear_modulus>1</shear_modulus>'
HARDENS = '<flow_model type="isotropic_hardening"><sigma_Y>1</sigma_Y><K>1</K></flow_model>'
MTS = '<flow_model type="mts_model">' + "".join(f"<{tag}>{number}</{tag}>" for tag, number in (
    ("sigma_a", 1), ("mu_0", 1), ("koverbcubed", 1), ("g_0i", 0), ("g_0e", 1), ("edot_0i", 1), ("edot_0e", 1),
    ("p_i", 1),
    ("q_i", 1), ("p_e", 1), ("q_e", 1), ("sigma_i", 1), ("a_0", 1), ("a_1", 1), ("a_2", 1), ("a_3", 1), ("alpha", 1),
    ("edot_es0", 1), ("g_0es", 1), ("sigma_es0", 1))) + "</flow_model>"


# name: scene, (text, what takes its place), sentence
REFUSED = {
    "a rigid body that nothing holds in implicit steps":
        (BEAM, ('type="comp_neo_hook"', 'type="rigid"'), "'rubber' is rigid, which has no tangent"),
    "a pressure on faces that does not say which":
        (BLOCK, ("<outward_normal>true</outward_normal>", ""),
         "missing tag <outward_normal>: needed with <use_CBDI_boundary_condition>"),
    "pressures that turn, at the corners of particles":
        (BLOCK, ("<interpolator>", "<keepPressBCNormalToSurface>true</keepPressBCNormalToSurface><interpolator>"),
         "is not available with <use_CBDI_boundary_condition>"),
    "a torque on a box":
        (BLOCK, ("pressure>", "torque>"), "a torque acts only on the side of a <cylinder>"),
    "planes between bodies before there are any":
        (BLOCK, ("<interpolator>", "<stress_update>usf</stress_update><interpolator>"),
         "friction_LR, friction_LRVar and specified_friction are available only with usl and musl"),
    "friction by color without its table":
        (BLOCK, ("friction_LR<", "friction_LRVar<"), "missing tag <variable_friction> in <contact>"),
    "colors of friction that do not ascend":
        (BLOCK, ("friction_LR</type>", "friction_LRVar</type><master_material>0</master_material><variable_friction>"
                 "<entry><color>1</color><mu>0</mu></entry><entry><color>1</color><mu>1</mu></entry>"
                 "</variable_friction>"), "its color is not above that of the previous entry"),
    "a master that turns without a file":
        (BILLET, ("<materials>[0,1]</materials>", "<include_rotation>true</include_rotation>"),
         "needs a contact of type rigid, specified or specified_friction and its <filename>"),
    "a flow of heat into implicit steps":
        (BEAM, heat_flow("Neumann", "5"), "value: found '5'; solids take Neumann for Temperature only with 0"),
    "heat on a surface in implicit steps":
        (BEAM, ("<Grid>", HEAT), "heat_flux: needs DoImplicitHeatConduction true", "MPM/use_load_curves=true"),
    "bodies at rest without conduction":
        (BEAM, ("<dynamic>", "<DoMechanics>false</DoMechanics><dynamic>"),
         "DoMechanics: false leaves nothing to compute"),
    "artificial viscosity in implicit steps":
        (BEAM, ("<dynamic>", "<artificial_viscosity>true</artificial_viscosity><dynamic>"),
         "artificial_viscosity: is not available; only explicit steps have artificial viscosity"),
    "a condition of one material of several in implicit steps":
        (BILLET, ('id="all" label="Symmetric" var="symmetry"/></Face>\n      <Face side="y-">',
                  'id="1" label="Velocity" var="Dirichlet"><value>[0,0,0]</value></BCType></Face>\n      <Face '
                  'side="y-">'),
         "id: found '1'; with <time_integrator> implicit, materials share their nodes",
         "MPM/time_integrator=implicit", "MPM/artificial_viscosity=false"),
    "a contact of some materials in implicit steps":
        (BILLET, ("<materials>[0,1]</materials>", "<materials>[0]</materials>"),
         "'billet' is not among its <materials>",
         "MPM/time_integrator=implicit", "MPM/artificial_viscosity=false"),
    "a direct solver that solves nothing":
        (BEAM, ("<preconditioner>lu", "<preconditioner>gamg"),
         "preconditioner: found 'gamg', but with <solver> direct the preconditioner solves the "
         "system: use lu or cholesky"),
    "steps that Uintah would take again":
        (BILLET, ("<MPM>\n    <time", "<MPM>\n    <restartOnLargeNodalVelocity>true</restartOnLargeNodalVelocity>\n    "
                                      "<time"),
         "restartOnLargeNodalVelocity: is not available; recompute_timestep in <Time> repeats a step that fails"),
    "temperatures of nodes by least squares":
        (BEAM, ("<dynamic>", "<temperature_solve>true</temperature_solve><dynamic>"),
         "temperature_solve: is not available; nodes take the mean temperature of their particles"),
    "a body that does not fill its shape":
        (BILLET, ("<geom_object>", "<geom_object><volumeFraction>0.5</volumeFraction>"),
         "volumeFraction: found '0.5', expected 1: a body always fills its shape"),
    "a load curve with the number of another load":
        (BEAM, ("<Grid>", HEAT.replace("heat_flux", "pressure").replace("<time_point>", "<id>2</id><time_point>", 1)),
         "id: found '2', expected 1: loads are numbered in the order of the scene", "MPM/use_load_curves=true"),
    "a word in thermal contact":
        (BILLET, ("<contact>", "<thermal_contact><type>none</type></thermal_contact><contact>"), "unknown tag <type>"),
    "a text in thermal contact":
        (BILLET, ("<contact>", "<thermal_contact>foo</thermal_contact><contact>"), "text 'foo' in <thermal_contact>"),
    "two thermal contacts":
        (BILLET, ("<contact>", "<thermal_contact/><thermal_contact/><contact>"),
         "tag <thermal_contact> is given twice"),
    "two sections of constants":
        (BEAM, ("<MaterialProperties>", "<PhysicalConstants/><MaterialProperties>"),
         "<PhysicalConstants> is given twice; the first is at "),
    "two sections of loads":
        (CYLINDER, ("<PhysicalBC>", "<PhysicalBC><MPM/></PhysicalBC><PhysicalBC>"),
         "<PhysicalBC> is given twice; the first is at "),
    "two places of a load":
        (CYLINDER, ("<load_curve>", "<geom_object/><load_curve>"), "tag <geom_object> is given twice"),
    "an attribute of the place of a load":
        (CYLINDER, ("<geom_object>\n          <cylinder", '<geom_object name="x">\n          <cylinder'),
         "unknown attribute 'name' of <geom_object>"),
    "two constitutive models":
        (BEAM, (RUBBER, '<constitutive_model type="rigid"/>' + RUBBER), "tag <constitutive_model> is given twice"),
    "two damage models":
        (SPALL, ("<damage_model", '<damage_model type="x"/><damage_model'), "tag <damage_model> is given twice"),
    "an attribute of a switch":
        (BEAM, (RUBBER, RUBBER + '<usePlasticity unit="1">false</usePlasticity>'),
         "unknown attribute 'unit' of <usePlasticity>"),
    "a tag in a switch":
        (BEAM, (RUBBER, RUBBER + "<usePlasticity>false<b/></usePlasticity>"),
         "found tag <b> in <usePlasticity>, where only a value is allowed"),
    "a surface of Mohr and Coulomb without corners":
        (BEAM, (RUBBER, '<constitutive_model type="MohrCoulomb"><G>1</G><K>1</K><Version>3</Version>'),
         "Version: found '3', expected 1, 11, 12: stresses return to the nearest point of a surface with corners"),
    "a rigid body without a contact":
        (BEAM, ('<material name="rubber">', '<material name="rubber"><is_rigid>true</is_rigid>'),
         "is_rigid: needs a <contact> of type rigid or specified, with this material as its master"),
    "volumes that are shared by what goes by rates":
        (BEAM, (RUBBER, '<constitutive_model type="hypo_elastic"><G>1</G><K>1</K>'),
         "DoPressureStabilization: is available with <time_integrator> implicit only "
         "for comp_neo_hook, comp_mooney_rivlin, UCNH and comp_neo_hook_plastic; 'rubber' is",
         "MPM/DoPressureStabilization=true"),
    "an energy budget of implicit steps":
        (BEAM, ("<dynamic>", " <dynamic>"),
         "the energy budget is available only for solids with explicit time steps; remove the module",
         "DataAnalysis/Module/@name=energyBudget"),
    "the heat of a viscosity that is not there":
        (SPALL, ("<artificial_viscosity>true", "<artificial_viscosity>false"),
         "artificial_viscosity_heating: needs <artificial_viscosity> true"),
    "a metal without a heat capacity":
        (SPALL, ("<specific_heat>383</specific_heat>", ""), "missing tag <specific_heat>"),
    "a metal without a heat capacity in implicit steps":
        (BEAM, (RUBBER, METAL + HARDENS), "missing tag <specific_heat>: elastic_plastic is heated by plastic work"),
    "obstacles without an energy":
        (BEAM, (RUBBER, METAL + MTS), "p_i is greater than 0, but g_0i, edot_0i and q_i are not"),
    "friction in implicit steps":
        (BILLET, ("<type>rigid</type>", "<type>friction</type><mu>.1</mu>"),
         "contact: friction needs <time_integrator> "
         "explicit; in implicit steps all materials move as one", "MPM/time_integrator=implicit",
         "MPM/artificial_viscosity=false"),
    "fibres with friction":
        (BEAM, ('type="comp_neo_hook"', 'type="TransIsoHypoFrictional"'), "hypo_elastic, without fibres"),
    "affine velocities that stresses would not see":
        (BILLET, ("<interpolator>", "<apic>true</apic><stress_update>usf</stress_update><interpolator>"),
         "apic: is available only with stress_update usl"),
    "volumes per radian in a contact":
        (CYLINDER, ("</MPM>\n  </MaterialProperties>", "<contact><type>friction</type><mu>.1</mu><volume_constraint>.5"
                    "</volume_constraint></contact></MPM>\n  </MaterialProperties>"), "volume_constraint of <contact>"),
    "a load beside all bodies":
        (CYLINDER, ("<radius>0.5</radius></cylinder>\n        </geom_object>", "<radius>0.3</radius></cylinder>\n"
                    "        </geom_object>"), ":43:8: PhysicalBC/MPM: no particle lies along the surface"),
    "a load on a material that is not there":
        (CYLINDER, ("<id>1</id>", "<id>1</id><material>4</material>"),
         "there is no material 4; materials are numbered from 0 to 0"),
    "particles lighter than may be":
        (BILLET, ("<artificial_viscosity>", "<minimum_particle_mass>1</minimum_particle_mass><artificial_viscosity>"),
         "<minimum_particle_mass> is 1 kg"),
    "an exclusion that friction does not know":
        (BILLET, ("<type>rigid</type>", "<type>friction</type><mu>.1</mu><ExcludeMaterial>0</ExcludeMaterial>"),
         "applies only to contacts of type rigid, specified and single_velocity"),
}


class SolidMistakes(unittest.TestCase):
    def edited(self, scene, before, after, *sets):
        text = (ROOT / scene).read_text()
        self.assertIn(before, text)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.ups")
            path.write_text(text.replace(before, after))
            return run(path, "Time/max_Timesteps=1", *sets, outputs=True)

    def test_are_refused(self):
        for name, (scene, edit, sentence, *sets) in REFUSED.items():
            with self.subTest(name):
                result = self.edited(scene, *edit, *sets)
                self.assertEqual(result.code, 3, result.err)
                self.assertIn(sentence, result.err)
                self.assertEqual(result.files, [])

    def test_a_wall_that_lets_no_heat_through_is_what_implicit_steps_have(self):
        self.assertEqual(self.edited(BEAM, *heat_flow("Neumann", "0")).code, 0)


if __name__ == "__main__":
    unittest.main()
