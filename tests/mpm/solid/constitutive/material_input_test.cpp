#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/all.hpp"
#include "components/mpm/solid/material_input.hpp"
#include "tests/input/support.hpp"

namespace tushar::mpm::solid::testing {
namespace {

using input::Diagnostics;
using input::Document;

constexpr const char* body =
    "<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[1,1,1]</res></geom_object>";
constexpr const char* moduli = "<bulk_modulus>7</bulk_modulus><shear_modulus>3</shear_modulus>";
const std::string flow = "<flow_model type='isotropic_hardening'><sigma_Y>2</sigma_Y><K>1</K></flow_model>";

/// The constitutive model's tags, and those beside it in the material.
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
/// The sentences of all problems.
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

TEST(MaterialInput, KeepsStateOnlyWhereTheConstantsNeedIt) {
  const std::string yields =
      "<usePlasticity>true</usePlasticity><yield_stress>1</yield_stress>"
      "<hardening_modulus>0</hardening_modulus>";
  EXPECT_EQ(materialsOf(sceneOf("UCNH", moduli))[0].model->stateSize(), 0);
  EXPECT_EQ(materialsOf(sceneOf("UCNH", moduli + yields))[0].model->stateSize(), 10);
  EXPECT_EQ(offsetOf(*materialsOf(sceneOf("UCNH", moduli + yields))[0].model, "p.bElBar"), 1);
}

TEST(MaterialInput, SaysWhatThereIsInsteadOfAModelOfUintah) {
  expectProblem(sceneOf("Arenisca3", ""), "the model 'Arenisca3' of Uintah is not available; nearest is MohrCoulomb");
  expectProblem(sceneOf("comp_neo_hok", ""), "did you mean 'comp_neo_hook'");
}

TEST(MaterialInput, AsksForWhatAPlasticModelNeeds) {
  expectProblem(sceneOf("comp_neo_hook_plastic", moduli),
                "where it yields, <yield_stress> and <hardening_modulus> must be given");
  expectProblem(sceneOf("elastic_plastic_hp", moduli), "missing tag <flow_model>");
  expectProblem(sceneOf("elastic_plastic_hp", moduli + std::string("<flow_model type='linear'/>")),
                "attribute 'type': found 'linear', expected 'isotropic_hardening', 'johnson_cook', ");
}

TEST(MaterialInput, RefusesWhatItDoesNotHave) {
  expectProblem(sceneOf("UCNH", moduli + std::string("<useInitialStress>true</useInitialStress>")),
                "is not available; bodies start without stress");
  expectProblem(sceneOf("elastic_plastic", moduli + flow + "<yield_condition type='gurson'/>"),
                "attribute 'type': found 'gurson', expected 'vonMises'");
  expectProblem(
      sceneOf("elastic_plastic", moduli + flow + "<plastic_convergence_algo>biswajit</plastic_convergence_algo>"),
      "found 'biswajit', expected 'radialReturn'");
  expectProblem(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Use_softening>1</Use_softening>"), "is not available");
  expectProblem(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Phi>10</Phi><Psi>20</Psi>"), "<Psi> is greater than <Phi>");
  EXPECT_EQ(sentencesOf(sceneOf("MohrCoulomb", "<G>1</G><K>1</K><Use_softening>0.0</Use_softening>")), "");
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
  expectProblem(sceneOf("elastic_plastic", moduli + flow + "<stability_check type='drucker'/>",
                        "<erosion algorithm='ZeroStress'/>"),
                "would follow a loss of stability, which is not looked for");
  EXPECT_EQ(sentencesOf(sceneOf("elastic_plastic", moduli + flow + "<stability_check type='drucker'/>")), "");
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
