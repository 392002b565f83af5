#include <gtest/gtest.h>

#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpm/solid/constitutive/nonlocal_drucker_prager.hpp"
#include "components/mpm/solid/tasks/nonlocal.hpp"
#include "tests/mpm/solid/constitutive/material_point.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/particles.hpp"

namespace tushar::mpm::solid::testing {
namespace {

constexpr double roundOff = 1e-12;  ///< some hundred operations, each exact to 1e-16

NonlocalDruckerPrager soil() {
  return {.bulkModulus = 7, .shearModulus = 3, .friction = 0.2, .dilation = 0.1, .strength = 0.1};
}
/// J2^(1/2) + alpha I1
double loadOf(const NonlocalDruckerPrager& model, const Matrix3& stress) {
  return deviator(stress).norm() / std::sqrt(2.0) + model.friction * stress.trace();
}

TEST(NonlocalDruckerPrager, ReturnsToTheSurfaceOfItsStrength) {
  NonlocalDruckerPrager model = soil();
  model.localModulus = 0.5;
  MaterialPoint<NonlocalDruckerPrager> point{model};
  for (const double stretch : {0.97, 0.94, 0.9}) {
    point.advance(Vec3(1 / std::sqrt(stretch), 1 / std::sqrt(stretch), stretch).asDiagonal());
    EXPECT_GT(point.oldState.plasticIncrement, 0);
    EXPECT_NEAR(loadOf(model, point.oldStress), 0.1 + 0.5 * point.oldState.plasticStrain, roundOff);
  }
}

TEST(NonlocalDruckerPrager, ReturnsToItsApexFromStrongTension) {
  MaterialPoint<NonlocalDruckerPrager> point{soil()};
  point.advance(1.1 * Matrix3::Identity());
  EXPECT_LT((point.oldStress - 0.1 / (3 * 0.2) * Matrix3::Identity()).norm(), roundOff);
}

/// After a return to the apex, the strain beyond that of the apex is plastic, and hardens like any other.
TEST(NonlocalDruckerPrager, HardensAndSoftensAtItsApex) {
  for (const double hardening : {0.5, -0.5}) {
    NonlocalDruckerPrager model = soil();
    model.localModulus = hardening;
    MaterialPoint<NonlocalDruckerPrager> point{model};
    point.advance(Vec3(1.1, 1.1, 1.12).asDiagonal());
    const double apex = point.oldStress.trace() / 3, bulk = (0.32 - apex / 7) / 3;
    const Vec3 strain = Vec3(0.1, 0.1, 0.12) - Vec3::Constant(0.32 / 3);
    const double plastic = std::sqrt(strain.squaredNorm() + 3 * bulk * bulk);
    EXPECT_LT(deviator(point.oldStress).norm(), roundOff);
    EXPECT_NEAR(point.oldState.plasticStrain, plastic, roundOff);
    EXPECT_NEAR(point.oldState.hardening, hardening * plastic, roundOff);
    EXPECT_NEAR(3 * 0.2 * apex, std::max(0.1 + hardening * plastic, 0.0), roundOff);
  }
}

TEST(NonlocalDruckerPrager, GoesOnHardeningAtThePointWhereItsLeastStrengthHolds) {
  NonlocalDruckerPrager model = soil();
  model.friction = model.dilation = 0;
  model.localModulus = 0.5;
  model.nonlocalModulus = -2;
  model.leastStrength = 0.05;
  MaterialPoint<NonlocalDruckerPrager> point{model};
  point.oldState.meanIncrement = 1;
  point.advance(Vec3(1, 1, 0.95).asDiagonal());
  EXPECT_NEAR(loadOf(model, point.oldStress), 0.05, roundOff);
  EXPECT_GT(point.oldState.plasticStrain, 0);
  EXPECT_NEAR(point.oldState.hardening, 0.5 * point.oldState.plasticStrain, roundOff);
}

/// In uniaxial strain the axial stress exceeds the lateral one by 2 G e, and by 3^(1/2) k once it flows.
TEST(NonlocalDruckerPrager, FollowsTheUniaxialStrainPathWithoutFriction) {
  NonlocalDruckerPrager model = soil();
  model.friction = model.dilation = 0;
  MaterialPoint<NonlocalDruckerPrager> point{model};
  double strain = 0;
  for (int step = 1; step <= 50; ++step) {
    const double stretch = 1 - 1e-3 * step;
    strain += stretch / point.oldDeformation(2, 2) - 1;
    point.advance(Vec3(1, 1, stretch).asDiagonal());
    const double difference = point.oldStress(0, 0) - point.oldStress(2, 2);
    EXPECT_NEAR(difference, std::min(-2 * 3 * strain, std::sqrt(3.0) * 0.1), roundOff);
    EXPECT_NEAR(point.oldStress.trace() / 3, 7 * strain, roundOff);
  }
}

TEST(NonlocalDruckerPrager, SoftensByTheMeanPlasticStrainDownToItsLeastStrength) {
  NonlocalDruckerPrager model = soil();
  model.friction = model.dilation = 0;
  model.nonlocalModulus = -2;
  model.leastStrength = 0.05;
  MaterialPoint<NonlocalDruckerPrager> point{model};
  point.advance(Vec3(1, 1, 0.97).asDiagonal());
  EXPECT_EQ(point.oldState.meanIncrement, point.oldState.plasticIncrement) << "without a length, the point itself";
  point.oldState.meanIncrement = 0.01;
  point.advance(Vec3(1, 1, 0.96).asDiagonal());
  EXPECT_NEAR(loadOf(model, point.oldStress), 0.1 - 2 * 0.01, roundOff);
  point.oldState.meanIncrement = 1;
  point.advance(Vec3(1, 1, 0.95).asDiagonal());
  EXPECT_NEAR(loadOf(model, point.oldStress), 0.05, roundOff);
}

TEST(NonlocalDruckerPrager, FlowsFromTheStressInWhichBodiesRest) {
  NonlocalDruckerPrager model = soil();
  model.stressAlongZ = -0.3;
  MaterialPoint<NonlocalDruckerPrager> point{model};
  point.advance(Matrix3::Identity());
  const Matrix3 whole = point.oldStress + Matrix3(Vec3(0, 0, -0.3).asDiagonal());
  EXPECT_NEAR(loadOf(model, whole), 0.1, roundOff);
}

/// A row of four cells of 1 m with a particle at the centre of each.
struct Row : test::Particles {
  Row() : Particles(test::unitCells(4, 1)) {
    set.reset(grid.patches().front(), 4);
    for (int k = 0; k < 4; ++k) {
      set.at(Index3{{k, 0, 0}}) = {k, k + 1};
      x.push_back({k + 0.5, 0.5});
    }
    set.setOwned(4);
  }
  std::vector<Vec<2>> x;
};

TEST(Nonlocal, TakesTheMeanOfThePlasticStrainWithinItsLength) {
  Row row;
  NonlocalDruckerPrager model = soil();
  model.nonlocalModulus = -1;
  model.length = 1.5;
  Material material;
  material.model = std::make_shared<ModelOf<NonlocalDruckerPrager>>(model);
  constexpr int numbers = 5;
  std::vector<double> state(4 * numbers, 0.0), increment(4), volume{2, 2, 2, 2};
  state[1 * numbers + 3] = 1;  // p.plasticIncrement of the second particle

  findPlasticIncrement(row.patch(), material, numbers, row.read(state), row.write(increment));
  averagePlasticIncrement<2>(row.patch(), material, 2, numbers, row.read(row.x), row.read(volume), row.read(increment),
                             {state.data(), row.set, row.level.cells()});

  EXPECT_EQ(increment, (std::vector<double>{0, 1, 0, 0}));
  const double beside = std::exp(-std::pow(6 * std::sqrt(std::numbers::pi), 2.0 / 3.0) / (1.5 * 1.5));
  EXPECT_NEAR(state[0 * numbers + 4], beside / (1 + beside), roundOff);
  EXPECT_NEAR(state[1 * numbers + 4], 1 / (1 + 2 * beside), roundOff);
  EXPECT_NEAR(state[2 * numbers + 4], beside / (1 + 2 * beside), roundOff);
  EXPECT_EQ(state[3 * numbers + 4], 0);
}

}  // namespace
}  // namespace tushar::mpm::solid::testing
