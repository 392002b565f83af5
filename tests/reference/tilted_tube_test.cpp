#include "components/reference/tilted_tube.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/reference/gas_equations.hpp"
#include "tests/reference/riemann_problems.hpp"

namespace tushar::reference {
namespace {

const Vec3 kDiagonal = Vec3(1, 1, 0) / std::sqrt(2.0);

/// Sod's tube along the diagonal: dense gas within .3 m of parallel planes through the origin and every 1.4 m.
TiltedTube mirroredSod() { return {tube({1, 0, 1}, {.125, 0, .1}, 0.3), {kDiagonal, 0.0, 1.4}}; }

TEST(TiltedTube, IsTheTubeAlongX) {
  const ExactRiemann straight(sodTube());
  const TiltedTube tilted(sodTube(), {Vec3::UnitX(), {}, 0});
  for (const double x : {0.1, 0.4, 0.6, 0.8, 0.9})
    EXPECT_EQ(difference(tilted.at(Vec3(x, 3, 4), 0.2), straight.at(Vec3(x, 3, 4), 0.2)), 0);
  const GasState mean = tilted.average(Vec3(0.3, 0, 0), Vec3(0.31, 1, 1), 0.2);
  EXPECT_LT(difference(mean, straight.average(Vec3(0.3, 0, 0), Vec3(0.31, 1, 1), 0.2)), 1e-13);
}

TEST(TiltedTube, RunsAlongItsNormal) {
  const ExactRiemann straight(sodTube());
  const Vec3 normal = Vec3(2, -3, 6) / 7, across = Vec3(3, 2, 0);
  const TiltedTube tilted(sodTube(), {normal, {}, 0});
  for (const double s : {0.1, 0.4, 0.6, 0.8, 0.9}) {
    const GasState here = tilted.at(s * normal + across, 0.2), there = straight.at(Vec3(s, 0, 0), 0.2);
    EXPECT_NEAR(here.density, there.density, 1e-14);
    EXPECT_LT((here.velocity - there.velocity[0] * normal).norm(), 1e-14);
    EXPECT_NEAR(here.energy, there.energy, 1e-14);
  }
  EXPECT_LT(gasResidual(tilted, 0.35 * normal, 0.2, 1.4, 1e-3), 1e-7);  // in the fan
}

TEST(TiltedTube, StandsAgainInItsMirrors) {
  const TiltedTube gas = mirroredSod();
  const Vec3 x(0.31, 0.02, 0);
  const GasState here = gas.at(x, 0.1);
  EXPECT_GT(here.velocity.norm(), 0.1);
  const GasState mirrored = gas.at(-x, 0.1), next = gas.at(x + 2.8 * kDiagonal, 0.1),
                 beyond = gas.at(1.4 * kDiagonal - x, 0.1);
  EXPECT_NEAR(mirrored.density, here.density, 1e-14);
  EXPECT_LT((mirrored.velocity + here.velocity).norm(), 1e-14);
  EXPECT_LT(difference(next, here), 1e-14);
  EXPECT_NEAR(beyond.pressure, here.pressure, 1e-14);
  EXPECT_LT((beyond.velocity + here.velocity).norm(), 1e-14);
}

TEST(TiltedTube, StandsOnTheSideOfItsMirrorThatItsDiaphragmIsOn) {
  const TiltedTube gas(tube({.125, 0, .1}, {1, 0, 1}, -0.3), {Vec3::UnitX(), 0.0, 1.4}), other = mirroredSod();
  for (const double s : {-0.6, -0.31, -0.1, 0.2, 0.35, 0.65}) {
    const GasState here = gas.at(Vec3(s, 0, 0), 0.1), there = other.at(s * kDiagonal, 0.1);
    EXPECT_NEAR(here.density, there.density, 1e-14);
    EXPECT_NEAR(here.velocity[0], there.velocity.dot(kDiagonal), 1e-14);
  }
}

TEST(TiltedTube, AveragesAsBruteForceDoes) {
  const TiltedTube gas = mirroredSod();
  const Vec3 size(0.1, 0.07, 0.05);
  for (const Vec3& lower : {Vec3(0.15, 0.2, 0), Vec3(-0.3, -0.05, 1), Vec3(1.1, 1.0, 0), Vec3(0.02, 0.01, 0)}) {
    const GasState mean = gas.average(lower, lower + size, 0.15);
    EXPECT_LT(difference(mean, midpointMean(gas, lower, lower + size - 0.05 * Vec3::UnitZ(), 0.15, 1000)), 2e-4);
  }
}

TEST(TiltedTube, KeepsMassAndEnergyInAPeriodicBox) {
  const TiltedTube gas = mirroredSod();
  const double side = 1.4 * std::sqrt(2.0);
  const int n = 20;
  for (const double t : {0.0, 0.05, 0.2}) {
    double mass = 0;
    Vec3 velocity = Vec3::Zero();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vec3 lower = side / n * Vec3(i, j, 0) - Vec3(0.37, 0.61, 0);
        const GasState mean = gas.average(lower, lower + side / n * Vec3(1, 1, 0), t);
        mass += mean.density / (n * n);
        velocity += mean.velocity / (n * n);
      }
    EXPECT_NEAR(mass, (0.6 + 0.125 * 0.8) / 1.4, 1e-9) << t;  // of 5 points across whole cells of the fan
    EXPECT_LT(velocity.norm(), 1e-9) << t;
  }
}

TEST(TiltedTube, HoldsUntilAWaveReachesAMirror) {
  const TiltedTube gas = mirroredSod();
  EXPECT_TRUE(gas.holdsAt(0.2282));  // the shock: .4 m at 1.752156 m/s
  EXPECT_FALSE(gas.holdsAt(0.2283));
  EXPECT_THROW(gas.at(Vec3::Zero(), 0.2283), std::domain_error);
  const TiltedTube narrow(tube({1, 0, 1}, {.125, 0, .1}, 0.1), {Vec3::UnitX(), 0.0, 0});
  EXPECT_TRUE(narrow.holdsAt(0.084));  // the fan: .1 m at 1.183216 m/s
  EXPECT_FALSE(narrow.holdsAt(0.085));
  EXPECT_TRUE(TiltedTube(sodTube(), {kDiagonal, {}, 0}).holdsAt(1e9));
}

TEST(TiltedTube, RefusesWhatCannotBe) {
  const auto make = [](const TubePlacement& placement, const RiemannProblem& problem = sodTube()) {
    TiltedTube(problem, placement);
  };
  EXPECT_THROW(make({Vec3(1, 1, 0), {}, 0}), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, {}, 1}), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, 0.5, 2}), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, 0.0, 1}), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, 0.0, 0}, tube({1, 1, 1}, {1, 0, 1})), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, 1.0, 0}, tube({1, 0, 1}, {1, 1, 1})), std::invalid_argument);
  EXPECT_THROW(make({kDiagonal, 0.0, 2}, tube({1, 0, 1}, {1, 1, 1})), std::invalid_argument);
  EXPECT_NO_THROW(make({kDiagonal, 0.0, 0}, tube({1, 0, 1}, {1, 1, 1})));
  EXPECT_THROW(mirroredSod().at(Vec3::Zero(), -1), std::invalid_argument);
}

}  // namespace
}  // namespace tushar::reference
