#include <gtest/gtest.h>

#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;  ///< some hundred operations, each exact to 1e-16
constexpr double strain = 1e-3;
constexpr double sudden = 1e-12;  ///< sudden [s]; nothing relaxes by more than a part in 1e9 in it

double equivalent(const Matrix3& stress) { return std::sqrt(1.5) * deviator(stress).norm(); }

/// A deformation gradient suddenly stretched along z.
Matrix3 stretched() { return Vec3(1, 1, 1 + strain).asDiagonal(); }

template <class M>
void stretchAtOnce(MaterialPoint<M>& point) {
  point.timeStep = sudden;
  point.advance(stretched());
}
template <class M>
void hold(MaterialPoint<M>& point, double time) {
  point.timeStep = time;
  point.advance(point.oldDeformation);
}

TEST(MwViscoElastic, RelaxesToTheStressOfItsSpring) {
  const MwViscoElastic model = springBesideMaxwell();
  MaterialPoint<MwViscoElastic> point{model};
  stretchAtOnce(point);
  double time = 0;
  for (const double step : {0.01, 0.2, 0.1}) {
    hold(point, step);
    time += step;
    const double shear = 2 * (1 + 3 * std::exp(-time / 0.1)), bulk = 2 + 5 * std::exp(-time / 0.2);
    const Matrix3& stress = point.oldStress;
    EXPECT_NEAR((stress(2, 2) - stress(0, 0)) / strain, shear, 1e-8);
    EXPECT_NEAR(stress.trace() / 3 / strain, bulk, 1e-8);
  }
}

TEST(MwViscoElastic, HoldsTheEnergyOfItsSprings) {
  MaterialPoint<MwViscoElastic> point{springBesideMaxwell()};
  stretchAtOnce(point);
  const auto energy = [&] { return point.energy(point.oldDeformation) / (strain * strain); };
  const double volume = 1 + strain;  // J of a hypoelastic body
  EXPECT_NEAR(energy(), volume * (0.5 * 7 + 2.0 / 3.0 * 4), 1e-6);
  hold(point, 100);
  EXPECT_NEAR(energy(), volume * (0.5 * 2 + 2.0 / 3.0 * 1), 1e-6);
}

TEST(ViscoTransIsoHyper, RelaxesToItsElasticStress) {
  MaterialPoint<ViscoTransIsoHyper> point{relaxingLigament()};
  const MaterialPoint<TransIsoHyper> elastic{ligament<>()};
  stretchAtOnce(point);
  const Matrix3 without = elastic.stress(stretched());
  double time = 0;
  for (const double step : {1e-3, 5e-3, 0.05}) {
    hold(point, step);
    time += step;
    const double factor = 1 + 0.5 * std::exp(-time / 2e-3) + 1.5 * std::exp(-time / 0.1);
    EXPECT_LT((point.oldStress - factor * without).norm(), 1e-8 * without.norm());
  }
  hold(point, 100);
  EXPECT_LT((point.oldStress - without).norm(), roundOff * without.norm());
}

TEST(ViscoTransIsoHyper, IsALigamentWithoutMaxwellElements) {
  const MaterialPoint<ViscoTransIsoHyper> point{ligament<ViscoTransIsoHyper>()};
  const MaterialPoint<TransIsoHyper> elastic{ligament<>()};
  const Matrix3 f = generalDeformation(0.3);
  EXPECT_EQ(point.stress(f), elastic.stress(f));
}

TEST(ElasticPlastic, RelaxesWithMaxwellElements) {
  MaterialPoint<ElasticPlasticHp> point{relaxingMetal(IsotropicHardening{0.2, 0.5})};
  stretchAtOnce(point);
  const double shear = 2 * strain;
  EXPECT_NEAR(point.oldStress(2, 2) - point.oldStress(0, 0), 3 * shear, roundOff);
  hold(point, 0.03);
  EXPECT_NEAR(point.oldStress(2, 2) - point.oldStress(0, 0),
              (std::exp(-0.03 / 0.01) + 2 * std::exp(-0.03 / 0.1)) * shear, roundOff);
  EXPECT_EQ(point.oldState.plasticStrain, 0);
}

TEST(ElasticPlastic, HasTheWavesOfItsMaxwellElementsFromTheStart) {
  MaterialPoint<ElasticPlasticHp> point{relaxingMetal(IsotropicHardening{0.2, 0.5})};
  point.model.shearModulus = 0.1;
  const Deformation still = point.step(Matrix3::Identity());
  const double speed = point.model.initialWaveSpeed(2);
  EXPECT_NEAR(speed, std::sqrt((7 + 4.0 / 3.0 * (1 + 2)) / 2), roundOff);
  EXPECT_NEAR(speed, point.model.waveSpeed(2, still, Matrix3::Zero(), point.oldState), roundOff);
}

TEST(ElasticPlastic, ReturnsToTheYieldSurfaceWithMaxwellElements) {
  MaterialPoint<ElasticPlasticHp> point{relaxingMetal(IsotropicHardening{0.2, 0.5})};
  point.timeStep = 1e-4;
  for (const double size : {0.05, 0.1, 0.3}) {
    point.advance(generalDeformation(size));
    EXPECT_NEAR(equivalent(point.oldStress), 0.2 + 0.5 * point.oldState.plasticStrain, roundOff);
    const Matrix3 sum = matrixOf(point.oldState.maxwell[0]) + matrixOf(point.oldState.maxwell[1]);
    EXPECT_LT((sum - deviator(point.oldStress)).norm(), roundOff);
  }
}

TEST(ElasticPlastic, KeepsTheStressesOfTheMaxwellElementsThatItHas) {
  const ModelOf<ElasticPlasticHp> plain(elasticPlastic(IsotropicHardening{0.2, 0.5}));
  const ModelOf<ElasticPlasticHp> relaxing(relaxingMetal(IsotropicHardening{0.2, 0.5}));
  EXPECT_EQ(plain.stateSize(), 4);
  EXPECT_EQ(plain.stateVariables().size(), 4u);
  EXPECT_EQ(relaxing.stateSize(), 22);
  EXPECT_EQ(relaxing.stateVariables().back().label, "p.sigmaDev1");
  std::array<double, 23> state;
  state[22] = -7;
  relaxing.initialize(state.data(), {});
  const Matrix3 f = stretched(), still = Matrix3::Identity(), rate = (f - still) / sudden;
  const double warm = 300;
  double speed;
  StressPoints points{1, sudden, &still, &f, &rate, &warm};
  points.state = state.data();
  points.stateStride = 22;
  points.waveSpeed = &speed;
  relaxing.updateStress(2, points);
  EXPECT_NEAR(state[4 + 8], 4.0 / 3.0 * strain, roundOff);  // p.sigmaDev0, along z
  EXPECT_EQ(state[22], -7);
}

TEST(ViscoScram, RelaxesByItsMaxwellElements) {
  ViscoScram model = explosive();
  model.initialCrackRadius = 0;
  MaterialPoint<ViscoScram> point{model};
  stretchAtOnce(point);
  hold(point, 0.02);
  EXPECT_NEAR((point.oldStress(2, 2) - point.oldStress(0, 0)) / strain, 2 * (1 + 2 * std::exp(-2.0)), 1e-6);
  EXPECT_NEAR(point.oldStress.trace() / 3, 2 * 3 * 1.3 / (3 * 0.4) * strain, roundOff);
}

/// One long step at rest equals two steps of half its length: exp(-2 x) = exp(-x)².
TEST(ViscoScram, AdvancesEachMaxwellElementOnceInAStep) {
  ViscoScram model = explosive();
  model.initialCrackRadius = 0;
  MaterialPoint<ViscoScram> whole{model};
  stretchAtOnce(whole);
  MaterialPoint<ViscoScram> halves = whole;
  hold(whole, 0.02);
  for (const double time : {0.01, 0.01}) hold(halves, time);
  for (int n = 0; n < 5; ++n)
    EXPECT_LT((matrixOf(whole.oldState.deviators[n]) - matrixOf(halves.oldState.deviators[n])).norm(), roundOff) << n;
  EXPECT_GT(matrixOf(whole.oldState.deviators[2]).norm(), 0.1 * strain);
}

TEST(ViscoScram, IsHalfAsStiffWithCracksOfTheGivenRadius) {
  ViscoScram model = explosive();
  model.greatestCrackSpeed = 0;
  MaterialPoint<ViscoScram> point{model};
  stretchAtOnce(point);
  EXPECT_NEAR((point.oldStress(2, 2) - point.oldStress(0, 0)) / strain, 2 * 3 / 2.0, 1e-6);
  EXPECT_EQ(point.oldState.crackRadius, 1e-3);
}

/// With m = 2, slow growth follows dc/dt = v 3/2 pi c sigma²/(4 K_0²).
TEST(ViscoScram, GrowsCracksExponentiallyUnderASmallStress) {
  MaterialPoint<ViscoScram> point{explosive()};
  point.oldStress = Vec3(-0.5, -0.5, 1).asDiagonal();
  point.timeStep = 1e-4;
  const double radius = point.state(stretched()).crackRadius;
  EXPECT_NEAR(std::log(radius / 1e-3), 1e-3 * 1e-4 * 1.5 * std::numbers::pi * 1.5 / (4 * 0.25), 1e-13);
}

TEST(ViscoScram, GrowsCracksAtTheGreatestSpeedUnderALargeStressAndMoreSlowlyUnderPressure) {
  MaterialPoint<ViscoScram> point{explosive()};
  point.timeStep = 1e-4;
  const Matrix3 shear = Vec3(-500, -500, 1000).asDiagonal();
  const auto growth = [&](double pressure) {
    point.oldStress = shear - pressure * Matrix3::Identity();
    return (point.state(stretched()).crackRadius - 1e-3) / point.timeStep;
  };
  EXPECT_NEAR(growth(0), 1e-3 * (1 - 0.25 / (1.5 * std::numbers::pi * 1e-3 * 1.5e6)), 1e-9);
  EXPECT_LT(growth(100), growth(0));
  EXPECT_GT(growth(100), 0);
}

TEST(ExpandingViscoScram, BearsNoStressWhereItGrowsFreely) {
  MaterialPoint<ExpandingViscoScram> point{hotExplosive()};
  point.advance(Matrix3::Identity());
  for (const double rise : {3.0, 7.0, -20.0}) {
    point.temperature += rise;
    point.advance((1 + 1e-3 * rise) * point.oldDeformation);
    EXPECT_LT(point.oldStress.norm(), roundOff) << point.temperature;
  }
  EXPECT_EQ(point.oldState.temperature, 290);
  EXPECT_EQ(point.oldState.scram.crackRadius, 1e-3) << "nothing opens the cracks";
}

TEST(ExpandingViscoScram, IsPressedByHeatWhereItCannotGrow) {
  MaterialPoint<ExpandingViscoScram> point{hotExplosive()};
  for (const double temperature : {300.0, 310.0, 305.0}) {
    point.temperature = temperature;
    point.advance(Matrix3::Identity());
    const Matrix3 expected = -3 * 6.5 * 1e-3 * (temperature - 300) * Matrix3::Identity();
    EXPECT_LT((point.oldStress - expected).norm(), roundOff) << temperature;
  }
}

/// The strain is 0 at the temperature of the first step, even at 0 K.
TEST(ExpandingViscoScram, StartsWithoutStrainAtAnyTemperature) {
  for (const double start : {0.0, 300.0}) {
    MaterialPoint<ExpandingViscoScram> point{hotExplosive()};
    point.temperature = start;
    point.advance(Matrix3::Identity());
    EXPECT_EQ(point.oldStress.norm(), 0);
    point.temperature = start + 10;
    point.advance(Matrix3::Identity());
    EXPECT_NEAR(point.oldStress.trace() / 3, -3 * 6.5 * 1e-2, roundOff);
  }
}

TEST(ExpandingViscoScram, IsViscoScramAtOneTemperature) {
  MaterialPoint<ExpandingViscoScram> point{hotExplosive()};
  MaterialPoint<ViscoScram> other{explosive()};
  for (const double size : {0.01, 0.02, 0.03}) {
    point.advance(generalDeformation(size));
    other.advance(generalDeformation(size));
    EXPECT_EQ(point.oldStress, other.oldStress);
    EXPECT_EQ(point.oldState.scram.crackRadius, other.oldState.crackRadius);
  }
}

TEST(ViscoPlastic, CreepsUnderTheStressAtWhichItsInternalStressesSaturate) {
  MaterialPoint<ViscoPlastic> point{ice()};
  const double rate = 1e-4;
  point.timeStep = 1;
  for (int step = 1; step <= 2000; ++step) {
    const double stretch = std::exp(rate * step);
    point.advance(Vec3(1 / std::sqrt(stretch), 1 / std::sqrt(stretch), stretch).asDiagonal());
  }
  const double expected = 1e6 * std::pow(rate / 7.794e-8, 0.25);
  EXPECT_NEAR(equivalent(point.oldStress), expected, 1e-4 * expected);  // elongations, not logarithms: 1e-4 a step
  EXPECT_NEAR(point.oldState.yield, 0.8 * expected, 1e-4 * expected);
  EXPECT_NEAR(equivalent(matrixOf(point.oldState.backStress)), 0.1 * expected, 1e-4 * expected);
}

TEST(ViscoPlastic, IsElasticInAFastStep) {
  MaterialPoint<ViscoPlastic> point{ice()};
  stretchAtOnce(point);
  EXPECT_NEAR((point.oldStress(2, 2) - point.oldStress(0, 0)) / (2 * 3.52e9 * strain), 1, 1e-3);
}

TEST(ViscoPlastic, TurnsTheStressThatAFailedParticleKeeps) {
  ViscoPlastic model = ice();
  model.canFail = true;
  model.failureVariable = 1e4;
  model.losesStress = false;
  MaterialPoint<ViscoPlastic> point{model};
  point.timeStep = 1e-6;
  point.advance(Vec3(1, 1, 1 + 1e-5).asDiagonal());
  ASSERT_EQ(point.oldState.failed, 1);
  const Matrix3 kept = point.oldStress, turn = rotation(0.8);
  point.advance(turn * point.oldDeformation);
  EXPECT_LT((point.oldStress - turn * kept * turn.transpose()).norm(), roundOff * kept.norm());
}

TEST(ViscoPlastic, FailsForGoodWhereItsStressExceedsItsStrength) {
  ViscoPlastic model = ice();
  model.canFail = true;
  model.failureVariable = 1e4;
  MaterialPoint<ViscoPlastic> point{model};
  point.timeStep = 1e-6;
  point.advance(Vec3(1, 1, 1 + 1e-7).asDiagonal());
  EXPECT_GT(point.oldStress(2, 2), 1e3);
  point.advance(Vec3(1, 1, 1 + 1e-6).asDiagonal());
  EXPECT_EQ(point.oldStress.norm(), 0);
  point.advance(Matrix3::Identity());
  EXPECT_EQ(point.oldStress.norm(), 0);
  EXPECT_EQ(point.oldState.failed, 1);
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
