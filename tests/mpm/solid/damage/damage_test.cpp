#include <gtest/gtest.h>

#include "components/mpm/particles/drawn.hpp"
#include "components/mpm/solid/damage/damage.hpp"
#include "components/mpm/solid/damage/erosion.hpp"
#include "components/mpm/solid/tasks/damage.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;

Matrix3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal().toDenseMatrix(); }

/// Copper of Johnson & Cook, Eng. Fract. Mech. 21 (1985) 31, table 2.
JohnsonCookDamage copper() {
  JohnsonCookDamage model;
  model.d1 = 0.54;
  model.d2 = 4.89;
  model.d3 = -3.03;
  model.d4 = 0.014;
  model.d5 = 1.12;
  return model;
}
const MaterialConstants constants{8930, 383, 1356, 294};

DamageConditions conditionsOf(const Matrix3& deformation, double rate, double temperature = 294, double dt = 1e-3) {
  return {deformation, 1e-3, rate, temperature, dt};
}

TEST(JohnsonCookDamage, GivesTheFractureStrainOfCopper) {
  // In uniaxial tension s* = 1/3: 0.54 + 4.89 exp(-1.01) = 2.321031; in torsion 0.54 + 4.89; ln 100 = 4.605170
  const Matrix3 still = Matrix3::Identity(), tension = diagonal(1, 0, 0);
  Matrix3 torsion = Matrix3::Zero();
  torsion(0, 1) = torsion(1, 0) = 1;
  EXPECT_NEAR(copper().fractureStrain(constants, conditionsOf(still, 1), tension), 2.321031, 1e-6);
  EXPECT_NEAR(copper().fractureStrain(constants, conditionsOf(still, 1), torsion), 5.43, roundOff);
  EXPECT_NEAR(copper().fractureStrain(constants, conditionsOf(still, 100), torsion), 5.43 * (1 + 0.014 * 4.605170),
              1e-6);
  EXPECT_NEAR(copper().fractureStrain(constants, conditionsOf(still, 1, 825), torsion), 5.43 * (1 + 1.12 * 0.5),
              roundOff);
}

TEST(JohnsonCookDamage, GrowsWithThePlasticStrainUntilTheParticleFails) {
  const Matrix3 still = Matrix3::Identity();
  Matrix3 stress = diagonal(1, 0, 0);
  DamageState state = copper().initial(1, 0);
  int steps = 0;
  for (; !state.hasFailed && steps < 10000; ++steps) copper().grow(constants, conditionsOf(still, 1), stress, state);
  EXPECT_EQ(steps, 2322);  // plastic strains of 1e-3 until the 2.321031 of above are passed
  EXPECT_GE(state.damage, 1);
}

TEST(JohnsonCookDamage, StartsSpreadAboutItsMeanWhereThatIsAskedFor) {
  JohnsonCookDamage model = copper();
  model.initialDamage = 0.2;
  model.initialDeviation = 0.03;
  EXPECT_EQ(model.initial(1, 77).damage, 0.2);

  model.startsSpread = true;
  const int count = 20000;
  double sum = 0, squares = 0;
  for (ParticleId id = 0; id < count; ++id) {
    const double damage = model.initial(1, id << 16).damage;
    sum += damage;
    squares += (damage - 0.2) * (damage - 0.2);
  }

  // Both scatter by 0.03 / (count or twice that)^(1/2) < 2.2e-4; the tolerance is five times that.
  EXPECT_NEAR(sum / count, 0.2, 1.1e-3);
  EXPECT_NEAR(std::sqrt(squares / count), 0.03, 1.1e-3);
}

TEST(BrittleDamage, SoftensInTensionOnly) {
  BrittleDamage model;
  model.young = 1e10;
  const Matrix3 pulled = diagonal(1.01, 1, 1);
  DamageState state = model.initial(1, 0);
  Matrix3 pressure = diagonal(-1, -1, -1), tension = diagonal(3, 0, 0);
  model.grow(constants, conditionsOf(pulled, 0), pressure, state);
  EXPECT_EQ(state.damage, 0);
  model.grow(constants, conditionsOf(pulled, 0), tension, state);
  EXPECT_NEAR(state.damage, 0.1, roundOff);  // no more in a step
  EXPECT_NEAR(tension(0, 0), 3 * 0.9, roundOff);
}

TEST(HancockMackenzieDamage, GrowsWithTheTriaxialityOfTensionAndNeverFails) {
  HancockMackenzieDamage model;
  model.initialDamage = 0.1;
  const Matrix3 still = Matrix3::Identity();
  DamageState state = model.initial(1, 0);
  Matrix3 tension = diagonal(2, 0, 0);  // mean over equivalent stress: 1/3
  model.grow(constants, conditionsOf(still, 0), tension, state);
  EXPECT_EQ(state.damage, 0.1) << "nothing flows";
  model.grow(constants, conditionsOf(still, 100), tension, state);  // a plastic strain of .1
  EXPECT_NEAR(state.damage, 0.1 + 0.1 / 1.65 * std::exp(0.5), roundOff);
  const double before = state.damage;
  Matrix3 pressure = diagonal(-2, 0, 0);
  model.grow(constants, conditionsOf(still, 100), pressure, state);
  EXPECT_EQ(state.damage, before);
  for (int step = 0; step < 100; ++step) model.grow(constants, conditionsOf(still, 100), tension, state);
  EXPECT_GT(state.damage, 1);
  EXPECT_FALSE(state.hasFailed);
}

TEST(BrittleDamage, FollowsItsSofteningCurve) {
  BrittleDamage model;
  model.young = 1e10;
  model.greatestStep = 1;
  const double strain = 1e-3, stretch = 1 / std::sqrt(1 - 2 * strain), energy = std::sqrt(1e10) * strain;
  DamageState state = model.initial(1, 0);
  Matrix3 stress = diagonal(1, 0, 0);
  model.grow(constants, conditionsOf(diagonal(stretch, 1, 1), 0), stress, state);
  const double c = 57 * 1e-3 * 1.1 / (11.2 * 0.1) * std::log(1.1);
  EXPECT_NEAR(state.damage, 9.99 * (1.1 / (1 + 0.1 * std::exp(-c * (energy - 57))) - 1), 1e-9);
  EXPECT_NEAR(state.threshold, energy, 1e-9);
}

TEST(ThresholdDamage, FailsWhereAPrincipalValueIsAboveTheThreshold) {
  ThresholdDamage byStress, byStrain;
  byStress.mean = 2;
  byStrain.mean = 0.1;
  byStrain.criterion = ThresholdDamage::Criterion::principalStrain;
  const auto fails = [](const ThresholdDamage& model, const Matrix3& deformation, Matrix3 stress) {
    DamageState state = model.initial(1, 0);
    model.grow(constants, conditionsOf(deformation, 0), stress, state);
    return state.hasFailed;
  };
  const Matrix3 q = rotation(0.6), still = Matrix3::Identity();
  EXPECT_TRUE(fails(byStress, still, q * diagonal(2.1, -9, 0) * q.transpose()));
  EXPECT_FALSE(fails(byStress, still, q * diagonal(1.9, -9, 0) * q.transpose()));
  EXPECT_TRUE(fails(byStrain, q * diagonal(1.2, 1, 1), still));
  EXPECT_FALSE(fails(byStrain, q * diagonal(1.1, 1, 1), still));
}

TEST(ThresholdDamage, FailsByMohrAndCoulombUnderShearAndUnderTension) {
  ThresholdDamage model;
  model.criterion = ThresholdDamage::Criterion::mohrCoulomb;
  model.mean = 1;
  model.frictionAngle = 30;
  model.tensileCutoff = 0.5;
  const auto fails = [&](Matrix3 stress) {
    DamageState state = model.initial(1, 0);
    const Matrix3 still = Matrix3::Identity();
    model.grow(constants, conditionsOf(still, 0), stress, state);
    return state.hasFailed;
  };
  EXPECT_TRUE(fails(diagonal(0.51, 0, 0)));
  EXPECT_FALSE(fails(diagonal(0.49, 0, 0)));
  // Under a lateral pressure of 2 the axial one is at most 2 * 3 + 2 * 3^(1/2).
  EXPECT_TRUE(fails(diagonal(-2, -9.47, -2)));
  EXPECT_FALSE(fails(diagonal(-2, -9.46, -2)));
}

TEST(Drawn, GivesTheNumbersOfEarlierRuns) {
  EXPECT_EQ(drawn(Drawing::threshold, 0, 0, 0), 0x1.58abaf01967f6p-1);
  EXPECT_EQ(drawn(Drawing::threshold, 0, 77, 1), 0x1.38872e2f410b2p-1);
  EXPECT_EQ(drawn(Drawing::threshold, 5, ParticleId{3} << 40, 3), 0x1.4048bad370a71p-2);
}

TEST(ThresholdDamage, DrawsThresholdsByTheIdOfAParticleWithTheMeanThatIsAskedFor) {
  for (const auto distribution : {ThresholdDamage::Distribution::gauss, ThresholdDamage::Distribution::weibull,
                                  ThresholdDamage::Distribution::uniform}) {
    ThresholdDamage model;
    model.distribution = distribution;
    model.mean = 10;
    model.deviation = 2;
    const int count = 20000;
    double sum = 0;
    for (ParticleId id = 0; id < count; ++id) sum += model.initial(1, id << 16).threshold;
    // The mean of `count` values scatters by at most 5.3/count^(1/2) = 0.037 (Weibull's distribution with modulus 2);
    // the tolerance is four times that.
    EXPECT_NEAR(sum / count, 10, 0.15);
    EXPECT_EQ(model.initial(1, 77).threshold, model.initial(1, 77).threshold);
    EXPECT_NE(model.initial(1, 77).threshold, model.initial(1, 78).threshold);
  }
}

TEST(ThresholdVarDamage, DrawsThresholdsByTheColorOfAParticle) {
  ThresholdVarDamage model;
  model.distribution = ThresholdDamage::Distribution::uniform;
  model.table.entries = {{1, 10, 2}, {3, 20, 4}};
  ThresholdDamage common = model;
  for (const auto& [color, share] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {2.5, 0.75}, {3.0, 1.0}, {9.0, 1.0}}) {
    common.mean = 10 + 10 * share;
    common.deviation = 2 + 2 * share;
    EXPECT_NEAR(model.initial(1, 77, color).threshold, common.initial(1, 77).threshold, 1e-14);
  }
}

TEST(ThresholdDamage, GivesSmallParticlesMoreToBear) {
  ThresholdDamage model;
  model.distribution = ThresholdDamage::Distribution::uniform;
  model.mean = 10;
  model.scalesWithVolume = true;
  model.referenceVolume = 8;
  model.exponent = 3;
  EXPECT_NEAR(model.initial(1, 0).threshold, 20, roundOff);
}

TEST(Erosion, LeavesOfTheStressWhatItsAlgorithmSays) {
  using Algorithm = Erosion::Algorithm;
  const Matrix3 tension = diagonal(3, 0, 0), pressure = diagonal(-3, 0, 0);
  const auto bearable = [](Algorithm algorithm, const Matrix3& stress) {
    return Erosion{algorithm}.bearable(stress, 1);
  };
  EXPECT_EQ(bearable(Algorithm::none, tension), tension);
  EXPECT_EQ(bearable(Algorithm::preserveStress, tension), tension);
  EXPECT_EQ(bearable(Algorithm::zeroStress, tension).norm(), 0);
  EXPECT_EQ(bearable(Algorithm::allowNoTension, tension).norm(), 0);
  EXPECT_LT((bearable(Algorithm::allowNoTension, pressure) + Matrix3::Identity()).norm(), roundOff);
  EXPECT_LT((bearable(Algorithm::allowNoShear, tension) - Matrix3::Identity()).norm(), roundOff);
}

TEST(Erosion, TakesLostStressAwayInItsTime) {
  const Erosion erosion{Erosion::Algorithm::zeroStress, 0.5};
  EXPECT_NEAR(erosion.bearable(diagonal(3, 0, 0), 1)(0, 0), 3 * std::exp(-2.0), roundOff);
}

TEST(Erosion, KeepsTheVolumeOfADeformationThatItDoesNotStop) {
  const Matrix3 old = Matrix3::Identity(), f = generalDeformation(0.2);
  Matrix3 kept = f, rate = f, stopped = f, none = f;
  Erosion{Erosion::Algorithm::allowNoShear}.restrain(old, kept, rate);
  Erosion{Erosion::Algorithm::zeroStress}.restrain(old, stopped, none);
  EXPECT_NEAR(kept.determinant(), f.determinant(), roundOff);
  EXPECT_LT(deviator(kept).norm(), roundOff);
  EXPECT_NEAR(rate.trace(), f.trace(), roundOff);
  EXPECT_EQ(stopped, old);
  EXPECT_EQ(none.norm(), 0);
}

TEST(Erosion, TakesParticlesWhosePlasticFlowIsUnstable) {
  grid::Domain domain;
  domain.upper = {1, 1, 0};
  domain.resolution = {{1, 1, 0}};
  const Grid grid(domain);
  data::ParticleSet set;
  set.reset(grid.patches().front(), 0);
  set.setOwned(1);
  const auto view = [&]<class T>(T& value) { return ParticleView<T>{&value, set, grid.level().cells()}; };
  const auto fails = [&](const StabilityCheck& check) {
    auto metal = elasticPlastic(IsotropicHardening{0.02, 0});
    metal.stability = check;
    const MaterialPoint<ElasticPlasticHp> point{metal};
    Matrix3 sheared = Matrix3::Identity();
    sheared(0, 1) = 0.2;
    Matrix3 stress = point.stress(sheared);
    const auto end = point.state(sheared);
    const double zero = 0, one = 1;
    const int sound = 0;
    double damage = 0, threshold = 0, failureTime = 0;
    int localized = 0;
    Material material;
    material.model = std::make_shared<ModelOf<ElasticPlasticHp>>(metal);
    material.erosion.algorithm = Erosion::Algorithm::zeroStress;
    const DamageGrowth<2> growth{.x = std::nullopt,
                                 .oldDeformation = view(point.oldDeformation),
                                 .temperature = view(point.temperature),
                                 .oldDamage = view(zero),
                                 .oldThreshold = view(zero),
                                 .oldLocalized = view(sound),
                                 .oldFailureTime = view(zero),
                                 .deformation = view(std::as_const(sheared)),
                                 .volume = view(one),
                                 .state = view(end.plasticStrain),
                                 .stress = view(stress),
                                 .damage = view(damage),
                                 .threshold = view(threshold),
                                 .localized = view(localized),
                                 .failureTime = view(failureTime)};
    computeDamage(grid.patches().front(), material, material.model->stateSize(), 0, point.timeStep, growth);
    return localized == 1;
  };
  EXPECT_TRUE(fails(BeckerCheck()));
  EXPECT_FALSE(fails(NoStabilityCheck()));
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
