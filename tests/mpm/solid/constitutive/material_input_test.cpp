#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/material_input.hpp"
#include "components/mpm/solid/tasks/create_particles.hpp"
#include "tests/input/support.hpp"

namespace tushar::mpm::solid::testing {
namespace {

using input::Diagnostics;
using input::Document;

constexpr const char* body =
    "<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[1,1,1]</res></geom_object>";
constexpr const char* moduli = "<bulk_modulus>7</bulk_modulus><shear_modulus>3</shear_modulus>";
const std::string flow = "<flow_model type='isotropic_hardening'><sigma_Y>2</sigma_Y><K>1</K></flow_model>";

/// The tags of a constitutive model, and those next to it in the material.
std::string sceneOf(const std::string& type, const std::string& tags, const std::string& beside = "") {
  return "<MaterialProperties><MPM><material name='a'><density>2</density>\n<constitutive_model type='" + type + "'>" +
         tags + "</constitutive_model>" + beside + body + "</material></MPM></MaterialProperties>";
}
std::vector<Material> materialsOf(const std::string& scene) {
  const Document document = input::documentOf(scene);
  Diagnostics diagnostics;
  const auto properties = propertiesSchema().read(*document.root().child("MaterialProperties"), diagnostics);
  EXPECT_FALSE(diagnostics.any());
  return properties.mpm.materials;
}
/// Returns the messages of all problems.
std::string sentencesOf(const std::string& scene) {
  const Document document = input::documentOf(scene);
  Diagnostics diagnostics;
  propertiesSchema().read(*document.root().child("MaterialProperties"), diagnostics);
  std::string sentences;
  for (const auto& problem : diagnostics.sorted()) sentences += problem.sentence + "\n";
  return sentences;
}
void expectProblem(const std::string& scene, const std::string& sentence) {
  EXPECT_NE(sentencesOf(scene).find(sentence), std::string::npos) << sentencesOf(scene);
}

TEST(MaterialInput, GivesTheModelTheConstantsOfItsMaterial) {
  const auto materials = materialsOf(sceneOf("elastic_plastic", moduli + flow,
                                             "<specific_heat>5</specific_heat>"
                                             "<melt_temp>900</melt_temp>"));
  const auto& model = dynamic_cast<const ModelOf<ElasticPlasticModel>&>(*materials[0].model).model();
  EXPECT_EQ(model.material.density, 2);
  EXPECT_EQ(model.material.specificHeat, 5);
  EXPECT_EQ(model.material.meltTemperature, 900);
  EXPECT_EQ(model.material.roomTemperature, 294);
}

TEST(MaterialInput, MeltsNothingWhereNoTemperatureIsGivenAsUintah) {
  const auto materials = materialsOf(sceneOf("elastic_plastic", moduli + flow, "<specific_heat>5</specific_heat>"));
  EXPECT_EQ(dynamic_cast<const ModelOf<ElasticPlasticModel>&>(*materials[0].model).model().material.meltTemperature,
            295e10);
}

TEST(MaterialInput, PicksTheModelThatTheTagsAskFor) {
  const auto nameOf = [](const std::string& type, const std::string& tags) {
    return std::string(materialsOf(sceneOf(type, tags))[0].model->name());
  };
  const std::string elastic = "<bulk_modulus>7</bulk_modulus><shear_modulus>3</shear_modulus>";
  const std::string yields = elastic +
                             "<usePlasticity>true</usePlasticity><yield_stress>2</yield_stress>"
                             "<hardening_modulus>1</hardening_modulus>";
  const std::string spread = "<yield_distrib>uniform</yield_distrib><yield_range>1</yield_range>";
  EXPECT_EQ(nameOf("comp_neo_hook", elastic), "comp_neo_hook");
  EXPECT_EQ(nameOf("comp_neo_hook", yields), "UCNH");
  EXPECT_EQ(nameOf("comp_neo_hook", yields + spread), "UCNHVar");
  expectProblem(sceneOf("UCNH", yields + "<yield_distrib>uniform</yield_distrib><yield_range>2</yield_range>"),
                "<yield_range> is not less than <yield_stress>");
}

TEST(MaterialInput, StartsUnderPressureAlsoWhereTheYieldStressDiffers) {
  const std::string pressed =
      "<bulk_modulus>7</bulk_modulus><shear_modulus>3</shear_modulus><usePlasticity>true</usePlasticity>"
      "<yield_stress>2</yield_stress><hardening_modulus>1</hardening_modulus>"
      "<useInitialStress>true</useInitialStress><initial_pressure>0.5</initial_pressure>";
  const std::string spread = "<yield_distrib>uniform</yield_distrib><yield_range>1</yield_range>";
  const std::string hot =
      "<room_temp>300</room_temp><linear_thermal_expansion_coef>1e-4</linear_thermal_expansion_coef>";
  for (const std::string& tags : {pressed, pressed + spread}) {
    const Material material = materialsOf(sceneOf("UCNH", tags, hot))[0];
    const double ratio = material.model->initialVolumeRatio(), grown = 1.02 * 1.02 * 1.02;
    EXPECT_EQ(ratio, volumeRatioUnder(0.5, 7));
    std::vector<double> state(static_cast<std::size_t>(material.model->stateSize()));
    material.model->initialize(state.data(), {});
    const Matrix3 unit = Matrix3::Identity(), f = std::cbrt(ratio) * unit;
    EXPECT_NEAR((startStress(material, f, 300, state.data()) + 0.5 * unit).norm(), 0, 1e-13);
    const double hotter = 0.5 + 7.0 / 2 * (grown - 1 / grown);
    EXPECT_NEAR((startStress(material, f, 500, state.data()) + hotter * unit).norm(), 0, 1e-13);
  }
}

TEST(MaterialInput, GivesMetalsThePoresOfGursonsYieldCondition) {
  const std::string surface =
      "<yield_condition type='gurson'><q1>1.5</q1><q2>1</q2><q3>2.25</q3><k>4</k><f_c>.05</f_c></yield_condition>";
  for (const char* type : {"elastic_plastic", "elastic_plastic_hp"}) {
    const auto materials = materialsOf(sceneOf(type, moduli + flow + surface, "<specific_heat>5</specific_heat>"));
    EXPECT_GE(offsetOf(*materials[0].model, "p.plasticDilatation"), 0);
  }
  const std::string relaxing =
      "<deviatoric_stress_model type='hypoViscoElastic'><mu>[1]</mu><tau>[1]</tau></deviatoric_stress_model>";
  expectProblem(sceneOf("elastic_plastic", moduli + flow + surface + relaxing, "<specific_heat>5</specific_heat>"),
                "yield_condition gurson needs <deviatoric_stress_model> hypoElastic");
}

TEST(MaterialInput, RefusesColorsThatDoNotGrow) {
  const std::string entry =
      "<entry><color>1</color><bulk_modulus>7</bulk_modulus><shear_modulus>3</shear_modulus>"
      "<yield_stress>2</yield_stress><hardening_modulus>1</hardening_modulus></entry>";
  const std::string table = "<variable_properties>" + entry + entry + "</variable_properties>";
  expectProblem(sceneOf("UCNHVar", table), "in order of increasing <color>");
}

TEST(MaterialInput, KeepsStateOnlyWhereTheConstantsNeedIt) {
  const std::string yields =
      "<usePlasticity>true</usePlasticity><yield_stress>1</yield_stress>"
      "<hardening_modulus>0</hardening_modulus>";
  EXPECT_EQ(materialsOf(sceneOf("UCNH", moduli))[0].model->stateSize(), 0);
  EXPECT_EQ(materialsOf(sceneOf("UCNH", moduli + yields))[0].model->stateSize(), 10);
  EXPECT_EQ(offsetOf(*materialsOf(sceneOf("UCNH", moduli + yields))[0].model, "p.bElBar"), 1);
}

TEST(MaterialInput, LetsHotBodiesExpandWithoutStress) {
  const std::string hot =
      "<room_temp>300</room_temp><linear_thermal_expansion_coef>1e-4</linear_thermal_expansion_coef>";
  const std::string yields = "<yield_stress>1e9</yield_stress><hardening_modulus>0</hardening_modulus>";
  for (const std::string type : {"comp_neo_hook", "comp_neo_hook_plastic"}) {
    const auto materials = materialsOf(sceneOf(type, moduli + (type == "comp_neo_hook" ? "" : yields), hot));
    const Model& model = *materials[0].model;
    EXPECT_TRUE(model.usesTemperature());
    EXPECT_FALSE(model.dependsOnDeformationOnly() || model.hasTangent());
    const Matrix3 none = Matrix3::Zero(), unit = Matrix3::Identity();
    // free at (1 + 1e-4 · 200)³, and held in place under the pressure of the missing expansion
    const Matrix3 deformation[] = {unit * 1.02, unit};
    const Matrix3 before[] = {unit, unit}, rate[] = {none, none};
    const double temperature[] = {500, 500}, grown = 1.02 * 1.02 * 1.02;
    std::vector<double> state(2 * std::max(model.stateSize(), 1)), speed(2);
    for (int k = 0; k < 2; ++k) model.initialize(&state[k * model.stateSize()], {});
    Matrix3 stress[2];
    model.updateStress(2, {.count = 2,
                           .timeStep = 1,
                           .oldDeformationGradient = before,
                           .deformationGradient = deformation,
                           .velocityGradient = rate,
                           .temperature = temperature,
                           .stress = stress,
                           .state = state.data(),
                           .stateStride = model.stateSize(),
                           .waveSpeed = speed.data()});
    EXPECT_NEAR(stress[0].norm(), 0, 1e-13) << type;
    EXPECT_NEAR((stress[1] + 7.0 / 2 * (grown - 1 / grown) * unit).norm(), 0, 1e-13) << type;
  }
}

TEST(MaterialInput, NotesWhatDoesNotExpand) {
  const Document document = input::documentOf(
      sceneOf("hypo_elastic", "<G>1</G><K>1</K>", "<linear_thermal_expansion_coef>1</linear_thermal_expansion_coef>"));
  Diagnostics diagnostics;
  propertiesSchema().read(*document.root().child("MaterialProperties"), diagnostics);
  ASSERT_EQ(diagnostics.notes().size(), 1u);
  EXPECT_NE(diagnostics.notes()[0].sentence.find("as in Uintah, only comp_neo_hook"), std::string::npos);
}

TEST(MaterialInput, NotesRubberWhoseEnergyHasNoLowerBound) {
  const auto notesOf = [](const std::string& ratio) {
    const Document document = input::documentOf(
        sceneOf("comp_mooney_rivlin",
                "<he_constant_1>603</he_constant_1><he_constant_2>301</he_constant_2><he_PR>" + ratio + "</he_PR>"));
    Diagnostics diagnostics;
    propertiesSchema().read(*document.root().child("MaterialProperties"), diagnostics);
    EXPECT_FALSE(diagnostics.any());
    return diagnostics.notes();
  };
  ASSERT_EQ(notesOf("0.42").size(), 1u);
  EXPECT_NE(notesOf("0.42")[0].sentence.find("it is not negative from 0.429 on"), std::string::npos);
  EXPECT_EQ(notesOf("0.43").size(), 0u);
}

/// Tags of visco_scram with one Maxwell element, followed by `more`.
std::string crackingTags(const std::string& more) {
  std::string tags =
      "<PR>0.3</PR><CrackParameterA>1e-3</CrackParameterA><CrackPowerValue>10</CrackPowerValue>"
      "<CrackMaxGrowthRate>300</CrackMaxGrowthRate><StressIntensityF>1e5</StressIntensityF>"
      "<CrackFriction>0.35</CrackFriction><InitialCrackRadius>3e-5</InitialCrackRadius>"
      "<CrackGrowthRate>1</CrackGrowthRate><Gamma>1</Gamma>";
  for (const std::string n : {"1", "2", "3", "4", "5"})
    tags += "<G" + n + ">1</G" + n + "><RTau" + n + ">0</RTau" + n + ">";
  return tags + more;
}

TEST(MaterialInput, KeepsATemperatureOnlyWhereViscoScramExpands) {
  const auto modelOf = [](const std::string& more) {
    return materialsOf(sceneOf("visco_scram", crackingTags(more), "<specific_heat>5</specific_heat>"))[0].model;
  };
  const auto plain = modelOf(""), still = modelOf("<CoeffThermalExpansion>0</CoeffThermalExpansion>");
  const auto grows = modelOf("<CoeffThermalExpansion>1e-4</CoeffThermalExpansion>");
  EXPECT_EQ(still->stateSize(), plain->stateSize());
  EXPECT_EQ(grows->stateSize(), plain->stateSize() + 1);
  EXPECT_EQ(grows->stateVariables().back().label, "p.temperatureOfStrain");
  const ViscoScram& scram = dynamic_cast<const ModelOf<ExpandingViscoScram>&>(*grows).model().scram;
  EXPECT_EQ(scram.thermalExpansion, 1e-4);
  EXPECT_EQ(scram.material.specificHeat, 5);
}

TEST(MaterialInput, PassesOverWordsThatUintahDoesNotReadEither) {
  const std::string hotSpots =
      "<Chi>0.8</Chi><delH>5e6</delH><Z>5e19</Z><EoverR>26500</EoverR>"
      "<dynamic_coeff_friction>0.25</dynamic_coeff_friction><volfracHE>0.95</volfracHE>";
  materialsOf(sceneOf("visco_scram", crackingTags(hotSpots)));
  materialsOf(sceneOf("comp_neo_hook",
                      moduli + std::string("<strain_limit>3</strain_limit>"
                                           "<reduction_factor>1</reduction_factor>"),
                      "<gamma>1.4</gamma>"));
  materialsOf(sceneOf("hypo_elastic", "<K>7</K><G>3</G><useModifiedEOS>true</useModifiedEOS>"));
}

TEST(MaterialInput, SaysWhatThereIsInsteadOfAModelOfUintah) {
  expectProblem(sceneOf("camclay", ""),
                "the model 'camclay' of Uintah is not available; the most similar one is MohrCoulomb");
  expectProblem(sceneOf("comp_neo_hok", ""), "did you mean 'comp_neo_hook'");
}

TEST(MaterialInput, AsksForWhatAPlasticModelNeeds) {
  expectProblem(sceneOf("comp_neo_hook_plastic", moduli),
                "a material that yields needs <yield_stress> and <hardening_modulus>");
  expectProblem(sceneOf("elastic_plastic_hp", moduli), "missing tag <flow_model>");
  expectProblem(sceneOf("elastic_plastic_hp", moduli + std::string("<flow_model type='linear'/>")),
                "attribute 'type': found 'linear', expected 'isotropic_hardening', 'johnson_cook', ");
}

TEST(MaterialInput, RefusesWhatItDoesNotHave) {
  expectProblem(sceneOf("UCNHVar", "<useInitialStress>true</useInitialStress>"),
                "is not available; bodies start without stress");
  expectProblem(sceneOf("elastic_plastic", moduli + flow + "<yield_condition type='rousselier'/>"),
                "attribute 'type': found 'rousselier', expected 'vonMises' or 'gurson'");
  expectProblem(
      sceneOf("elastic_plastic", moduli + flow + "<plastic_convergence_algo>newton</plastic_convergence_algo>"),
      "found 'newton', expected 'radialReturn' or 'biswajit'");
  expectProblem(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Use_softening>1</Use_softening>"), "is not available");
  expectProblem(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Phi>10</Phi><Psi>20</Psi>"), "<Psi> is greater than <Phi>");
  EXPECT_EQ(sentencesOf(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Use_softening>0.0</Use_softening>")), "");
}

TEST(MaterialInput, RefusesPoissonRatiosWithoutAShearModulus) {
  const auto rock = [](const std::string& ratios) {
    return sceneOf("Arenisca3",
                   "<PEAKI1>600</PEAKI1><FSLOPE>.1</FSLOPE><STREN>0</STREN><YSLOPE>0</YSLOPE>"
                   "<BETA_nonassociativity>1</BETA_nonassociativity><B0>10</B0><B1>0</B1><B2>0</B2><B3>0</B3><B4>0</B4>"
                   "<G0>15</G0><p0_crush_curve>-9</p0_crush_curve><p1_crush_curve>1</p1_crush_curve>"
                   "<p3_crush_curve>.5</p3_crush_curve><CR>.5</CR><fluid_B0>0</fluid_B0>"
                   "<fluid_pressure_initial>0</fluid_pressure_initial>" +
                       ratios);
  };
  EXPECT_EQ(sentencesOf(rock("<G1>.2</G1><G2>.2</G2>")), "");
  EXPECT_EQ(sentencesOf(rock("<G1>.6</G1><G2>0</G2>")), "") << "<G0> counts";
  expectProblem(rock("<G1>.2</G1><G2>.3</G2>"), "Poisson's ratio is 0.5, so the shear modulus would not be positive");
  expectProblem(rock("<G1>-1</G1><G2>.3</G2>"), "Poisson's ratio is -1, so the shear modulus would not be positive");
}

TEST(MaterialInput, RefusesAStrengthThatFallsFasterThanTheStress) {
  const auto soil = [](const std::string& softening) {
    return sceneOf("nonlocal_drucker_prager",
                   moduli + std::string("<alpha>0.1</alpha><alpha_p>0.5</alpha_p>") + "<k_o>1</k_o>" + softening);
  };
  const double limit = (3 + 9 * 7 * 0.1 * 0.5) / std::sqrt(0.5 + 3 * 0.25);
  EXPECT_EQ(sentencesOf(soil(fmt::format("<h_local>{:g}</h_local>", -0.99 * limit))), "");
  expectProblem(soil(fmt::format("<h_local>{:g}</h_local>", -1.01 * limit)), "the strength would fall faster than");
  expectProblem(soil(fmt::format("<h_local>1</h_local><h_nonlocal>{:g}</h_nonlocal>", -1.01 * limit - 1)),
                "the strength would fall faster than the stress; expected more than");
  expectProblem(soil(fmt::format("<h_local>{:g}</h_local><h_nonlocal>9</h_nonlocal>", -1.01 * limit)),
                "the strength would fall faster than the stress; expected more than");
}

TEST(MaterialInput, ChecksDamageAgainstTheConstitutiveModel) {
  const std::string johnsonCook =
      "<damage_model type='johnson_cook'><D1>1</D1><D2>1</D2><D3>1</D3><D4>0</D4><D5>0</D5>";
  expectProblem(
      sceneOf("comp_neo_hook", moduli, johnsonCook + "</damage_model>"),
      "johnson_cook needs the plastic strain of a constitutive model elastic_plastic_hp, found comp_neo_hook");
  expectProblem(
      sceneOf("elastic_plastic", moduli + flow,
              johnsonCook + "<initial_scalar_damage_distrib>uniform</initial_scalar_damage_distrib></damage_model>"),
      "found 'uniform', expected 'constant' or 'gauss'");
  expectProblem(sceneOf("hypo_elastic", "<G>1</G><K>1</K>", "<damage_model type='Brittle'/>"),
                "Brittle needs a constitutive model with bulk_modulus and shear_modulus");
  const std::string gurson =
      "<yield_condition type='gurson'><q1>1.5</q1><q2>1</q2><q3>2.25</q3><k>4</k><f_c>.1</f_c></yield_condition>";
  expectProblem(sceneOf("elastic_plastic", moduli + flow + gurson + "<stability_check type='drucker'/>",
                        "<erosion algorithm='ZeroStress'/>"),
                "acts after a loss of stability, which is not detected with yield_condition gurson");
  EXPECT_EQ(sentencesOf(sceneOf("elastic_plastic", moduli + flow + "<stability_check type='drucker'/>",
                                "<erosion algorithm='ZeroStress'/>")),
            "");
}

TEST(MaterialInput, ChecksTheThresholdsOfDamage) {
  const auto threshold = [](const std::string& tags) {
    return sceneOf("comp_neo_hook", moduli,
                   "<damage_model type='Threshold'><failure_criteria>MaximumPrincipalStress"
                   "</failure_criteria><failure_mean>1</failure_mean>" +
                       tags + "</damage_model>");
  };
  expectProblem(threshold("<failure_distrib>weibull</failure_distrib>"), "failure_distrib weibull needs <failure_std>");
  expectProblem(threshold("<scaling>kayenta</scaling>"), "scaling needs <reference_volume>");
  expectProblem(threshold("<scaling>kayenta</scaling><reference_volume>1</reference_volume>"),
                "scaling needs <exponent>");
  EXPECT_TRUE(materialsOf(threshold(""))[0].isDamageable());
  EXPECT_FALSE(materialsOf(sceneOf("comp_neo_hook", moduli))[0].isDamageable());
}

TEST(MaterialInput, TakesTheStiffnessOfBrittleDamageFromTheModel) {
  const auto materials = materialsOf(sceneOf("comp_neo_hook", moduli, "<damage_model type='Brittle'/>"));
  EXPECT_NEAR(std::get<BrittleDamage>(materials[0].damage).young, 9.0 * 7 * 3 / (3 * 7 + 3), 1e-12);
}

TEST(MaterialInput, TakesTheConstantPartOfTheYieldStressOfZerilliAndArmstrongFromTheGrainsToo) {
  const std::string before = moduli + std::string("<flow_model type='zerilli_armstrong'>");
  const std::string rest =
      "<B>1</B><beta_0>1</beta_0><beta_1>1</beta_1><B_0>1</B_0><alpha_0>1</alpha_0>"
      "<alpha_1>1</alpha_1><K>1</K><n>1</n></flow_model>";
  const auto constantPart = [&](const std::string& tags) {
    const auto materials =
        materialsOf(sceneOf("elastic_plastic", before + tags + rest, "<specific_heat>5</specific_heat>"));
    const auto& model = dynamic_cast<const ModelOf<ElasticPlasticModel>&>(*materials[0].model).model();
    return std::get<ZerilliArmstrong>(model.flow).c0;
  };
  EXPECT_EQ(constantPart("<c_0>7</c_0>"), 7);
  EXPECT_EQ(constantPart("<sigma_g>2</sigma_g><k_H>3</k_H><sqrt_l_inv>4</sqrt_l_inv>"), 14);
  expectProblem(sceneOf("elastic_plastic", before + rest), "missing tag <c_0>");
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
