#include "components/reference/gresho_vortex.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/reference/gas_equations.hpp"

namespace tushar::reference {
namespace {

GreshoProblem inUnitBox() {
  GreshoProblem problem;
  problem.frame = {Vec3(0.5, 0.5, 0), Vec3::Zero(), Vec3(1, 1, 0)};
  return problem;
}

TEST(GreshoVortex, HasThePublishedValues) {
  const GreshoVortex vortex(inUnitBox());
  const auto at = [&](double r) { return vortex.at(Vec3(0.5 + r, 0.5, 0), 3); };
  EXPECT_NEAR(at(0.1).velocity[1], 0.5, 1e-15);
  EXPECT_NEAR(at(0.3).velocity[1], 0.5, 1e-15);
  EXPECT_EQ(at(0.45).velocity[1], 0);
  EXPECT_NEAR(at(0.1).pressure, 5 + 12.5 * 0.01, 1e-15);
  EXPECT_NEAR(at(0.3).pressure, 9 - 4 * std::log(0.2) + 12.5 * 0.09 - 20 * 0.3 + 4 * std::log(0.3), 1e-14);
  EXPECT_NEAR(at(0.45).pressure, 3 + 4 * std::log(2), 1e-15);
  EXPECT_EQ(at(0.1).density, 1);
  EXPECT_NEAR(at(0.1).energy, 5.125 / 0.4, 1e-14);
}

TEST(GreshoVortex, SolvesTheGasEquationsInEachRingAndInAnyUnits) {
  GreshoProblem problem = inUnitBox();
  problem.density = 2;
  problem.speed = 0.7;
  problem.gamma = 5.0 / 3;
  problem.frame.velocity = Vec3(0.3, -0.2, 0);
  for (const GreshoProblem& p : {inUnitBox(), problem}) {
    const GreshoVortex vortex(p);
    for (const double r : {0.05, 0.15, 0.25, 0.35, 0.45})
      EXPECT_LT(gasResidual(vortex, p.frame.start + 0.1 * p.frame.velocity + r * Vec3(0.6, 0.8, 0), 0.1, p.gamma, 1e-4),
                1e-9);
  }
}

TEST(GreshoVortex, AveragesAsBruteForceDoes) {
  const GreshoVortex vortex(inUnitBox());
  // Boxes in the core, cut by the inner ring, cut by the outer ring, and touched by it at a side.
  for (const auto& [lower, size] : {std::pair{Vec3(0.5, 0.5, 0), 0.05},
                                    {Vec3(0.61, 0.62, 0), 0.05},
                                    {Vec3(0.75, 0.78, 0), 0.05},
                                    {Vec3(0.875, 0.475, 0), 0.05}}) {
    const Vec3 upper = lower + Vec3(size, size, 0);
    const GasState mean = vortex.average(lower, upper, 0);
    // The error of 500² midpoints on fields with kinks is h² / 12 times their second derivatives, which are about 50.
    const double brute = size * size / 2.5e5 / 12 * 2 * 50 + 1e-11;
    EXPECT_LT(difference(mean, midpointMean(vortex, lower, upper, 0, 500)), 2 * brute) << lower;
  }
}

TEST(GreshoVortex, AveragesAddUpAcrossTheRings) {
  const GreshoVortex vortex(inUnitBox());
  const int n = 20;
  Fields sum = Fields::Zero();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += toFields(vortex.average(Vec3(i, j, 0) / n, Vec3(i + 1, j + 1, 0) / n, 0));
  EXPECT_NEAR(sum[1] / (n * n), 0, 1e-12);  // the rule does not know of the symmetry
  EXPECT_NEAR(sum[2] / (n * n), 0, 1e-12);
  // Over the disc: 2 pi of s times s²/2 to 1 and s²/2 + 4 (ln s + 1 - s) from 1 to 2, times .04, the rest outside.
  const double rings = 2 * M_PI * 0.04 * (0.125 + 15.0 / 8 + 4 * (2 * M_LN2 - 0.75 + 1.5 - 7.0 / 3));
  const double mean = 5 + rings + (1 - 0.16 * M_PI) * (4 * M_LN2 - 2);
  EXPECT_NEAR(sum[4] / (n * n), mean, 1e-10);
}

TEST(GreshoVortex, IsCarriedAlongAcrossTheSeam) {
  GreshoProblem problem = inUnitBox();
  problem.frame.velocity = Vec3(1, 0.5, 0);
  const GreshoVortex moving(problem), still(inUnitBox());
  const Vec3 lower(0.9, 0.3, 0), upper(1.1, 0.4, 0), shift(-0.4, 0.2, 0);  // 1 - .4 and .2 of a period at t = .6, .4
  GasState mean = moving.average(lower - Vec3(0.5, 0, 0), upper - Vec3(0.5, 0, 0), 2);
  mean.velocity -= problem.frame.velocity;
  EXPECT_LT(difference(mean, still.average(lower - Vec3(0.5, 0, 0), upper - Vec3(0.5, 0, 0), 0)), 1e-14);
  mean = moving.average(lower + Vec3(0.5, 0.25, 0), upper + Vec3(0.5, 0.25, 0), 0.5);
  mean.velocity -= problem.frame.velocity;
  EXPECT_LT(difference(mean, still.average(lower, upper, 0)), 1e-14);
}

TEST(GreshoVortex, RefusesWhatCannotBe) {
  const auto expectRefused = [](auto change) {
    GreshoProblem problem = inUnitBox();
    change(problem);
    EXPECT_THROW(GreshoVortex{problem}, std::invalid_argument);
  };
  expectRefused([](auto& p) { p.density = 0; });
  expectRefused([](auto& p) { p.pressure = 0; });
  expectRefused([](auto& p) { p.gamma = 1; });
  expectRefused([](auto& p) { p.radius = 0; });
  expectRefused([](auto& p) { p.axis = -1; });
  expectRefused([](auto& p) { p.radius = 0.3; });  // 1.2 m wide in a period of 1 m
}

}  // namespace
}  // namespace tushar::reference
