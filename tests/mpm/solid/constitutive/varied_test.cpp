#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/gurson.hpp"
#include "components/mpm/solid/damage/damage.hpp"
#include "tests/mpm/solid/constitutive/example_models.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"

namespace tushar::mpm::solid::testing {
namespace {

UcnhVar twoColors() {
  UcnhVar model;
  model.isPlastic = true;
  model.entries[0] = {1, 7, 3, 0.2, 0.5};
  model.entries[1] = {3, 9, 5, 0.4, 0.1};
  model.count = 2;
  return model;
}

TEST(UcnhVar, IsTheModelWithTheConstantsOfTheColor) {
  for (const auto& [color, share] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.5, 0.25}, {3.0, 1.0}, {4.0, 1.0}}) {
    MaterialPoint<UcnhVar> point{twoColors()};
    point.oldState = point.model.initialState({17, color});
    MaterialPoint<CompNeoHookPlastic> expected{withModuli<CompNeoHookPlastic>(7 + 2 * share, 3 + 2 * share)};
    expected.model.yieldStress = 0.2 + 0.2 * share;
    expected.model.hardeningModulus = 0.5 - 0.4 * share;
    for (const double strain : {0.01, 0.2, 0.1}) {
      const Matrix3 f = generalDeformation(strain);
      EXPECT_LT((point.stress(f) - expected.stress(f)).norm(), 1e-14 * expected.stress(f).norm());
      EXPECT_NEAR(point.energy(f), expected.energy(f), 1e-14);
      point.advance(f);
      expected.advance(f);
    }
    EXPECT_GT(point.oldState.plasticStrain, 0);
    EXPECT_NEAR(point.oldState.plasticStrain, expected.oldState.plasticStrain, 1e-15);
  }
}

TEST(UcnhVar, DrawsYieldStressesByTheIdOfAParticleFromTheRange) {
  CompNeoHookPlastic common = compNeoHookPlastic(0.5);
  common.yieldRange = 0.1;
  const UcnhVar model = UcnhVar::spread(common);
  double sum = 0;
  const int count = 10000;
  for (ParticleId id = 0; id < count; ++id) {
    const double yield = model.initialState({id << 16, 0}).yieldStress;
    EXPECT_GE(yield, 0.1);
    EXPECT_LE(yield, 0.3);
    sum += yield;
  }
  EXPECT_NEAR(sum / count, 0.2, 4 * 0.1 / std::sqrt(3.0 * count)) << "four deviations of the mean";
  EXPECT_EQ(model.initialState({77, 0}).yieldStress, model.initialState({77, 5}).yieldStress);
  EXPECT_NE(model.initialState({77, 0}).yieldStress, model.initialState({78, 0}).yieldStress);
}

/// Correlations of the random values of initial porosity, initial damage, thresholds and yield stresses.
TEST(Drawn, DecidesEachQuantityByAStreamOfItsOwn) {
  GursonPlastic porous{elasticPlastic(IsotropicHardening{0.2, 0})};
  porous.base.initialPorosity = 0.5;
  porous.base.porosityDeviation = 0.01;
  porous.base.porositySpreads = true;
  CompNeoHookPlastic common = compNeoHookPlastic(0.5);
  common.yieldRange = 0.1;
  const UcnhVar yielding = UcnhVar::spread(common);
  ThresholdDamage failing;
  failing.mean = 5;
  failing.deviation = 1;
  failing.distribution = ThresholdDamage::Distribution::uniform;
  const int count = 10000;
  Eigen::MatrixXd drawn(count, 4);
  for (int k = 0; k < count; ++k) {
    const ParticleId id = ParticleId(k) << 16;
    drawn.row(k) << porous.initialState({id, 0}).porosity, damagedAtStart(0.5, 0.01, id).damage,
        failing.initial(1, id).threshold, yielding.initialState({id, 0}).yieldStress;
  }
  drawn.rowwise() -= drawn.colwise().mean().eval();
  drawn.colwise().normalize();
  const Eigen::Matrix4d correlation = drawn.transpose() * drawn;
  EXPECT_LT((correlation - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff(), 4 / std::sqrt(double(count)))
      << correlation;
}

MohrCoulomb soilWith(double friction) {
  auto soil = withModuli<MohrCoulomb>();
  soil.frictionAngle = friction;
  return soil;
}

/// Soil with a water suction in its pores, 1.7 Pa at the start.
MohrCoulomb soilWithWater(double specificVolume) {
  MohrCoulomb soil = soilWith(20);
  soil.retainsWater = true;
  std::tie(soil.retentionM, soil.retentionN, soil.retentionAlpha) = std::tuple(0.3, 2.5, 0.8);
  std::tie(soil.suctionAngle, soil.initialSuction, soil.initialSpecificVolume) = std::tuple(15.0, 1.7, specificVolume);
  return soil;
}

TEST(MohrCoulomb, HasTheCohesionOfItsWaterAndItsRate) {
  MaterialPoint<MohrCoulomb> point{soilWith(0)};
  point.model.isWet = true;
  std::tie(point.model.strength, point.model.waterContent, point.model.waterExponent) = std::tuple(0.3, 2.0, 1.5);
  std::tie(point.model.sensitivity, point.model.rateExponent, point.model.referenceRate) = std::tuple(1.2, 0.1, 4.0);
  point.oldState = point.model.initialState();
  const double slow = 1.2 * 0.3 * std::pow(2, -1.5);
  point.timeStep = 1;
  const Matrix3 sheared = (Matrix3() << 1, 0.4, 0, 0, 1, 0, 0, 0, 1).finished();
  EXPECT_NEAR(point.state(sheared).cohesion, slow, 1e-15);
  // Simple shear with D_12 = 200/s: the rate of shear is (3/4)^(1/2) 200/s.
  point.timeStep = 1e-3;
  EXPECT_NEAR(point.state(sheared).cohesion, slow * std::pow(std::sqrt(0.75) * 200 / 4, 0.1), 1e-13);
  const Matrix3 stress = point.stress(sheared);
  const Eigen::Vector3d s = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress).eigenvalues();
  EXPECT_NEAR((s[2] - s[0]) / 2, point.state(sheared).cohesion, 1e-13) << "without friction it bears c in shear";
}

TEST(MohrCoulomb, GainsCohesionFromTheSuctionOfItsWater) {
  MaterialPoint<MohrCoulomb> point{soilWithWater(1.9)};
  point.model.cohesion = 0.05;
  point.oldState = point.model.initialState();
  const auto still = point.state(Matrix3::Identity());
  EXPECT_NEAR(still.suction, 1.7, 1e-13);
  EXPECT_NEAR(still.cohesion, 0.05 + 1.7 * std::tan(15 * std::numbers::pi / 180), 1e-13);
  const auto squeezed = point.state(0.99 * Matrix3::Identity());
  const double v = 1.9 * (1 + 3 * std::log(0.99)), saturation = std::pow(1 + std::pow(0.8 * 1.7, 2.5), -0.3);
  EXPECT_NEAR(squeezed.specificVolume, v, 3e-4) << "the dilatation of the step is tr D dt";
  const double filled = saturation * (0.9 / 1.9) * squeezed.specificVolume / (squeezed.specificVolume - 1);
  EXPECT_NEAR(std::pow(1 + std::pow(0.8 * squeezed.suction, 2.5), -0.3), filled, 1e-14) << "as much water stays";
  EXPECT_LT(squeezed.suction, 1.7);
}

TEST(MohrCoulomb, IsFullOfWaterWhereItsPoresHaveClosed) {
  MaterialPoint<MohrCoulomb> point{soilWithWater(1.02)};
  point.oldState = point.model.initialState();
  const double least = std::pow(std::pow(0.99999, -1 / 0.3) - 1, 1 / 2.5) / 0.8;
  for (const double stretch : {0.999, 0.99, 0.98, 0.99, 1.0}) {
    point.advance(stretch * Matrix3::Identity());
    if (stretch == 0.999 || stretch == 1.0) continue;  // some pores are open
    EXPECT_LT(point.oldState.specificVolume, 1) << stretch;
    EXPECT_NEAR(point.oldState.suction, least, 1e-13) << stretch;
  }
  EXPECT_GT(point.oldState.specificVolume, 1);
  EXPECT_NEAR(point.oldState.suction, least, 1e-13) << "pores that open again are full";
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
