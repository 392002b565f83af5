"""Words of scenes with solids that have no effect, or another one than they seem to have, are noted."""
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from solids import RefusedSceneTest, globals_of  # noqa: E402
from sus import ROOT, run  # noqa: E402

PRESSURE = """<pressure><geom_object><box><min>[0,.2,0]</min><max>{}</max></box></geom_object><load_curve><id>1</id>
<time_point><time>0</time><load>1000</load></time_point></load_curve></pressure>"""
HEAT = PRESSURE.replace("pressure>", "heat_flux>")
MATERIAL = """<material name="{}"><density>1000</density><constitutive_model type="comp_neo_hook">
<bulk_modulus>1e6</bulk_modulus><shear_modulus>5e5</shear_modulus></constitutive_model>{}<geom_object>
<box><min>[0,{},0]</min><max>[.5,{},.05]</max></box><res>[2,2,1]</res><velocity>[0,0,0]</velocity></geom_object>
</material>"""


def scene(mpm="", loads="", contact="<contact><type>single_velocity</type></contact>", model="",
          save='<save label="TotalMass"/>', integrator="explicit", multiplier=.3):
    kind = "impm" if integrator == "implicit" else "mpm"
    conditions = f"<PhysicalBC><MPM>{loads}</MPM></PhysicalBC>" if loads else ""
    return f"""<Uintah_specification><SimulationComponent type="{kind}"/>
<Time><maxTime>1e-4</maxTime><delt_max>1e-5</delt_max><timestep_multiplier>{multiplier}</timestep_multiplier></Time>
<MPM><time_integrator>{integrator}</time_integrator><interpolator>gimp</interpolator>{mpm}</MPM>
<MaterialProperties><MPM>{MATERIAL.format("lower", model, .2, .4)}{MATERIAL.format("upper", model, .4, .6)}{contact}
</MPM></MaterialProperties>{conditions}<Grid><BoundaryConditions>
<Face side="z-"><BCType id="all" label="Symmetric" var="symmetry"/></Face>
<Face side="z+"><BCType id="all" label="Symmetric" var="symmetry"/></Face></BoundaryConditions>
<Level><Box label="all"><lower>[0,0,0]</lower><upper>[1,1,.05]</upper><resolution>[20,20,1]</resolution></Box></Level>
</Grid><DataArchiver><filebase>idle.uda</filebase>{save}</DataArchiver></Uintah_specification>"""


CURVES = "<use_load_curves>true</use_load_curves>"
MASTER = "<contact><type>specified</type><master_material>0</master_material></contact>"
PLANES = "<contact><type>friction_LR</type><mu>.3</mu></contact>"
DEEP = PRESSURE.format("[.5,.6,.001]")
FORCE = "<force><lower>[0,.2,0]</lower><upper>[.5,.6,.05]</upper><force_density>[0,0,5]</force_density></force>"


class IdleWords(RefusedSceneTest):
    def noted(self, text):
        done = run(self.scene(text), options=("--check",))
        self.assertEqual(done.code, 0, done.err)
        return done.err

    def test_are_noted(self):
        for text, sentence in (
                (scene(loads=PRESSURE.format("[.5,.2,.05]")), "has no effect without <use_load_curves> true in <MPM>"),
                (scene(CURVES, DEEP), "pushes along an axis of which the grid has one cell, and so has no effect"),
                (scene(loads=FORCE), "force_density: acts only along an axis of which the grid has one cell"),
                (scene(contact=MASTER), "direction: without it, the other materials follow the master only along an "
                                        "axis of which the grid has one cell"),
                (scene("<do_contact_friction_heating>true</do_contact_friction_heating>", contact=PLANES),
                 "has no effect on friction along planes (friction_LR, friction_LRVar, specified_friction)"),
                (scene("<UseMomentumForm>true</UseMomentumForm><stress_update>usl</stress_update>"),
                 "has no effect with <UseMomentumForm> true, which means musl"),
                (scene(integrator="implicit"), "each step is at most 0.6 times the last one")):
            self.assertIn(sentence, self.noted(text))

    def test_nothing_is_noted_of_words_that_act(self):
        for text in (scene(CURVES, PRESSURE.format("[.5,.2,.05]")), scene(contact=MASTER.replace(
                "</type>", "</type><direction>[1,1,0]</direction>")), scene(integrator="implicit", multiplier=.5)):
            self.assertNotIn("no effect", self.noted(text))
            self.assertNotIn("follow the master only", self.noted(text))
            self.assertNotIn("times the last one", self.noted(text))

    def test_what_must_be_given_is_asked_for(self):
        self.assert_refused(scene(CURVES, HEAT.format("[.5,.2,.05]")), "heats 'lower', which has no <specific_heat>")
        lower, upper = scene(CURVES, HEAT.format("[.5,.2,.05]")).split('<material name="upper">')
        warm = lower.replace("<geom_object>", "<specific_heat>100</specific_heat><geom_object>", 1)
        self.assertEqual(run(self.scene(warm + '<material name="upper">' + upper), options=("--check",)).code, 0)
        expands = "<linear_thermal_expansion_coef>1e-5</linear_thermal_expansion_coef>"
        self.assert_refused(scene(model=expands, integrator="implicit"),
                            "expands with temperature, for which there is no tangent")

    def test_bodies_in_gas_need_no_section_of_the_method(self):
        text = (ROOT / "ups/fsi/warm_body.ups").read_text()
        without = re.sub(r"\n  <MPM>.*?\n  </MPM>", "", text, count=1, flags=re.DOTALL)
        self.assertNotEqual(without, text)
        self.assertIn("<MPM>", without)  # of the materials
        self.noted(without)

    def test_marked_particles_keep_their_strain_energy(self):
        """With PreserveStress, failed particles are only marked, and bear all stress: their energy counts."""
        fails = """<damage_model type="Threshold"><failure_criteria>MaximumPrincipalStress</failure_criteria>
<failure_mean>1e-3</failure_mean></damage_model><erosion algorithm="{}"/>"""
        save = '<save label="StrainEnergy"/>'
        text = scene(model=fails.format("PreserveStress"), save=save).replace(
            "<velocity>[0,0,0]", "<velocity>[20*x,0,0]").replace(".0001", ".01")
        whole = scene(save=save).replace("<velocity>[0,0,0]", "<velocity>[20*x,0,0]")
        marked, sound = (globals_of(self.scene(one), "StrainEnergy")["StrainEnergy"][-1][1] for one in (text, whole))
        self.assertGreater(sound, 0)
        self.assertAlmostEqual(marked, sound, delta=1e-12 * sound)
        lost = text.replace("PreserveStress", "ZeroStress")
        self.assertLess(globals_of(self.scene(lost), "StrainEnergy")["StrainEnergy"][-1][1], .5 * sound)


if __name__ == "__main__":
    unittest.main()
