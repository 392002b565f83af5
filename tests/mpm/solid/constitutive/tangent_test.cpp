#include <gtest/gtest.h>

#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

/// The differences are of fourth order, with steps of 1e-3 of a smooth function: their error is 1e-12 in theory, and
/// 1e-10 with round-off; 1e-7 is required.
template <class M>
void expectConsistentTangent(const MaterialPoint<M>& point, const Matrix3& f) {
  const Matrix9 tangent = point.model.nominalTangent(point.step(f), point.oldStress, point.oldState);
  const Matrix9 expected = derivative([&](const Matrix3& at) { return point.nominalStress(at); }, f);
  EXPECT_LT((tangent - expected).norm() / expected.norm(), 1e-7);
}

TEST(NominalTangent, IsTheDerivativeOfTheStressOfHyperelasticModels) {
  const Matrix3 f = generalDeformation(0.3);
  expectConsistentTangent(MaterialPoint<CompNeoHook>{withModuli<CompNeoHook>()}, f);
  expectConsistentTangent(MaterialPoint<CompMooneyRivlin>{compMooneyRivlin()}, f);
  expectConsistentTangent(MaterialPoint<CnhMms>{withModuli<CnhMms>()}, f);
  expectConsistentTangent(MaterialPoint<ArrudaBoyce8>{lockingRubber()}, f);
  TransIsoHyper fibres = ligament<>();
  for (const double straight : {1.0, 1.05, 2.0}) {
    fibres.straight = straight;
    expectConsistentTangent(MaterialPoint<TransIsoHyper>{fibres}, f);
  }
  expectConsistentTangent(MaterialPoint<TransIsoHyper>{fibres}, f.inverse());
  fibres.failureOption = 1;
  for (const auto& [stretch, shear] : {std::pair{100.0, 1e-3}, {1e-3, 100.0}}) {
    fibres.mostFibreStretch = stretch;
    fibres.mostShear = shear;
    expectConsistentTangent(MaterialPoint<TransIsoHyper>{fibres}, f);
  }
}

TEST(NominalTangent, OfRelaxingFibresCountsWhatTheyRemember) {
  MaterialPoint<ViscoTransIsoHyper> point{relaxingLigament()};
  for (const auto rubber : {FibreElasticity::Rubber::mooneyRivlin, FibreElasticity::Rubber::verondaWestmann}) {
    point.model.rubber = rubber;
    point.advance(generalDeformation(0.1));
    expectConsistentTangent(point, generalDeformation(0.2));
  }
}

TEST(NominalTangent, OfHypoElasticCountsTheStressAtTheStartOfTheStep) {
  MaterialPoint<HypoElastic> point{withModuli<HypoElastic>()};
  point.advance(generalDeformation(0.1));
  expectConsistentTangent(point, generalDeformation(0.2));
}

/// Compares the tangent before yield, at an elastic strain, and after yield.
template <class M>
void expectConsistentTangentAroundYield(MaterialPoint<M> point, double elasticStrain) {
  const Matrix3 elastic = generalDeformation(elasticStrain), plasticStep = generalDeformation(0.2);
  EXPECT_EQ(point.state(elastic).plasticStrain, 0);
  expectConsistentTangent(point, elastic);
  point.advance(generalDeformation(0.1));
  EXPECT_GT(point.state(plasticStep).plasticStrain, point.oldState.plasticStrain);
  expectConsistentTangent(point, plasticStep);
}

TEST(NominalTangent, OfJ2FlowIsConsistentWithTheReturnBeforeAndAfterYield) {
  for (const double hardening : {0.0, 0.5})
    expectConsistentTangentAroundYield(MaterialPoint<CompNeoHookPlastic>{compNeoHookPlastic(hardening)}, 0.01);
}

/// Compares the tangent before and after yield, from a stressed and rotated state.
void expectConsistentTangentOfMetal(const ElasticPlasticHp& model) {
  MaterialPoint<ElasticPlasticHp> point{model};
  point.oldDeformation = generalDeformation(0);
  expectConsistentTangentAroundYield(point, 0.003);
}

TEST(NominalTangent, OfElasticPlasticIsFiniteWhereAYieldedPointIsAtRest) {
  for (const FlowModel& flow : flowModels()) {
    SCOPED_TRACE(std::visit([](const auto& model) { return std::string(model.name); }, flow));
    MaterialPoint<ElasticPlasticHp> point{elasticPlastic(flow)};
    point.advance(generalDeformation(0.1));
    const Matrix3 beyond = 1.001 * point.oldStress;
    EXPECT_TRUE(point.model.nominalTangent(point.step(point.oldDeformation), beyond, point.oldState).allFinite());
  }
}

TEST(NominalTangent, OfElasticPlasticIsConsistentWithEveryFlowModel) {
  for (const FlowModel& flow : flowModels()) {
    SCOPED_TRACE(std::visit([](const auto& model) { return std::string(model.name); }, flow));
    expectConsistentTangentOfMetal(elasticPlastic(flow));
  }
}

TEST(NominalTangent, OfElasticPlasticIsConsistentWithMaxwellElements) {
  for (const FlowModel& flow : flowModels()) {
    SCOPED_TRACE(std::visit([](const auto& model) { return std::string(model.name); }, flow));
    expectConsistentTangentOfMetal(relaxingMetal(flow));
  }
}

TEST(NominalTangent, OfElasticPlasticIsConsistentWithEveryEquationOfState) {
  ElasticPlasticHp model = elasticPlastic(IsotropicHardening{0.2, 0.5});
  for (const EquationOfState& law : {EquationOfState(HyperelasticVolume{}), EquationOfState(MieGruneisen{1.9, 2, 1.5}),
                                     EquationOfState(MieGruneisenEnergy{1.9, 2, 1.5, 0.1, 0.1})}) {
    SCOPED_TRACE(std::visit([](const auto& one) { return std::string(one.name); }, law));
    model.equationOfState = law;
    expectConsistentTangentOfMetal(model);
  }
}

TEST(NominalTangent, OfElasticPlasticIsConsistentWithEveryShearModulus) {
  for (const ShearModel& shear : {ShearModel(MtsShear{3.2, 0.1, 200}), ShearModel(NpShear{3, 0.05, 0.05, 1e6, 60}),
                                  ShearModel(ScgShear{3, 0.1, 1e-4})})
    for (const FlowModel& flow : flowModels()) {
      SCOPED_TRACE(std::visit([](const auto& one) { return std::string(one.name); }, shear));
      ElasticPlasticHp model = elasticPlastic(flow);
      model.shear = shear;
      expectConsistentTangentOfMetal(model);
    }
}

TEST(NominalTangent, OfElasticPlasticWhereItIsMoltenHasOnlyTheMeanStress) {
  MaterialPoint<ElasticPlasticHp> point{elasticPlastic(IsotropicHardening{0.2, 0.5})};
  point.temperature = 3000;
  point.advance(generalDeformation(0.1));
  expectConsistentTangent(point, generalDeformation(0.2));
}

TEST(NominalTangent, OfUcnhWithoutPlasticityIsThatOfNeoHookElasticity) {
  const MaterialPoint<Ucnh> point{withModuli<Ucnh>()};
  const Matrix3 f = generalDeformation(0.3);
  const Matrix9 tangent = point.model.nominalTangent(point.step(f), point.oldStress, point.oldState);
  const MaterialPoint<CompNeoHook> elastic{withModuli<CompNeoHook>()};
  const Matrix9 expected = elastic.model.nominalTangent(elastic.step(f), elastic.oldStress, {});
  EXPECT_LT((tangent - expected).norm(), 1e-13 * expected.norm());
}

TEST(NominalTangent, IsReachedThroughTheModelInterface) {
  const ModelOf<CompNeoHook> neoHook(withModuli<CompNeoHook>());
  const Matrix3 f = generalDeformation(0.3), identity = Matrix3::Identity(), zero = Matrix3::Zero();
  StressPoints points;
  points.count = 1;
  points.timeStep = 1;
  points.deformationGradient = &f;
  points.oldDeformationGradient = &identity;
  points.velocityGradient = &zero;
  Matrix9 tangent;
  neoHook.nominalTangent(points, &tangent);
  EXPECT_TRUE(neoHook.hasTangent());
  EXPECT_FALSE(ModelOf<Rigid>(Rigid{}).hasTangent());
  EXPECT_EQ(tangent, withModuli<CompNeoHook>().nominalTangent({f, identity, zero, 1, 0}, zero, {}));
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
