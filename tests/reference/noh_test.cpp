#include "components/reference/noh.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/reference/gas_equations.hpp"

namespace tushar::reference {
namespace {

NohProblem inDimensions(int d) {
  NohProblem problem;
  problem.round = Vec3(1, d > 1, d > 2);
  return problem;
}

TEST(Noh, HasThePublishedValues) {
  const double densities[] = {4, 16, 64};
  for (int d = 1; d <= 3; ++d) {
    const Noh noh(inDimensions(d));
    EXPECT_NEAR(noh.shockRadius(0.6), 0.2, 1e-15);
    const GasState behind = noh.at(Vec3(0.1, 0, 0), 0.6), ahead = noh.at(Vec3(0.3, 0, 0), 0.6);
    EXPECT_NEAR(behind.density, densities[d - 1], 1e-12);
    EXPECT_NEAR(behind.pressure, densities[d - 1] / 3, 1e-12);
    EXPECT_NEAR(behind.energy, 0.5, 1e-15);
    EXPECT_EQ(behind.velocity, Vec3::Zero());
    EXPECT_NEAR(ahead.density, std::pow(3, d - 1), 1e-12);
    EXPECT_EQ(ahead.pressure, 0);
    EXPECT_EQ(ahead.velocity, Vec3(-1, 0, 0));
  }
}

TEST(Noh, SolvesTheGasEquationsAheadOfItsShock) {
  for (int d = 1; d <= 3; ++d) {
    NohProblem problem = inDimensions(d);
    problem.density = 2;
    problem.speed = 0.8;
    problem.centre = Vec3(0.1, -0.2, 0.3);
    const Vec3 x = problem.centre + Vec3(0.4, 0.3, 0.2);
    EXPECT_LT(gasResidual(Noh(problem), x, 0.5, problem.gamma, 1e-3, problem.round), 1e-8);
  }
}

TEST(Noh, JumpsAsAShockMust) {
  for (int d = 1; d <= 3; ++d) {
    NohProblem problem = inDimensions(d);
    problem.gamma = 1.4;
    problem.speed = 2;
    const Noh noh(problem);
    const double t = 0.5, speed = noh.shockRadius(1), r = noh.shockRadius(t);
    const GasState in = noh.at(Vec3(r * (1 - 1e-12), 0, 0), t), out = noh.at(Vec3(r * (1 + 1e-12), 0, 0), t);
    const double flow = out.density * (out.velocity[0] - speed);
    EXPECT_NEAR(in.density * (in.velocity[0] - speed) / flow, 1, 1e-10);
    EXPECT_NEAR((flow * out.velocity[0] + out.pressure) / in.pressure, 1, 1e-10);
    EXPECT_NEAR(0.5 * out.velocity.squaredNorm() / in.energy, 1, 1e-10);  // no work: the gas behind is at rest
  }
}

TEST(Noh, SqueezesAPressureAsItFalls) {
  NohProblem problem = inDimensions(3);
  problem.pressure = 1e-6;
  const GasState gas = Noh(problem).at(Vec3(0, 0, 0.3), 0.6);
  EXPECT_NEAR(gas.density, 9, 1e-14);
  EXPECT_NEAR(gas.pressure / (1e-6 * std::pow(9, 5.0 / 3)), 1, 1e-14);
  EXPECT_NEAR(gas.energy, gas.pressure / (2.0 / 3 * 9), 1e-20);
}

TEST(Noh, StartsUniform) {
  const Noh noh(inDimensions(2));
  EXPECT_EQ(noh.at(Vec3(0.3, 0.4, 5), 0).density, 1);
  EXPECT_NEAR((noh.at(Vec3(0.3, 0.4, 5), 0).velocity - Vec3(-0.6, -0.8, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(noh.at(Vec3::Zero(), 0).density, 1);
  EXPECT_EQ(noh.average(Vec3(0, 0, 0), Vec3(0.1, 0.1, 0), 0).density, 1);
}

TEST(Noh, KeepsTheMassThatFellIn) {
  for (int d = 1; d <= 3; ++d) {
    const NohProblem problem = inDimensions(d);
    const Noh noh(problem);
    // The gas within r = .3 at t = .6 was within .9 at the start; cells of .05 m, an eighth of the ball.
    Fields sum = Fields::Zero();
    const int n = 12;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < (d > 1 ? n : 1); ++j)
        for (int k = 0; k < (d > 2 ? n : 1); ++k) {
          const Vec3 lower = 0.05 * Vec3(i, j, k);
          sum += toFields(noh.average(lower, lower + Vec3::Constant(0.05), 0.6)) * std::pow(0.05, d);
        }
    // The rest of the box of .6 m, of density (1 + .6 / r)^(d-1), is compared with an integral by midpoints.
    double rest = 0;
    const int m = 120;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < (d > 1 ? m : 1); ++j)
        for (int k = 0; k < (d > 2 ? m : 1); ++k) {
          const Vec3 x = Vec3(i + 0.5, d > 1 ? j + 0.5 : 0, d > 2 ? k + 0.5 : 0) * 0.6 / m;
          const double r = x.norm();
          rest += (r > 0.2 ? std::pow(1 + 0.6 / r, d - 1) : std::pow(4, d)) * std::pow(0.6 / m, d);
        }
    EXPECT_NEAR(sum[0] / rest, 1, d == 1 ? 1e-12 : 1e-3) << d;  // midpoints see the shock to a part of a cell
  }
}

TEST(Noh, AveragesACellThatTheShockCuts) {
  // The parts of the disc and outside of it are known: density 16 in the disc, 1 + .6 / r outside; over the square
  // [0, .2]² the integral of 1 / r is .4 asinh(1), over the quarter disc .1 pi.
  const double mean = (16 * M_PI * 0.01 + (0.04 - M_PI * 0.01) + 0.6 * (0.4 * std::asinh(1.0) - 0.1 * M_PI)) / 0.04;
  EXPECT_NEAR(Noh(inDimensions(2)).average(Vec3::Zero(), Vec3(0.2, 0.2, 1), 0.6).density / mean, 1, 1e-8);
}

TEST(Noh, RefusesWhatCannotBe) {
  const auto expectRefused = [](auto change) {
    NohProblem problem;
    change(problem);
    EXPECT_THROW(Noh{problem}, std::invalid_argument);
  };
  expectRefused([](auto& p) { p.density = 0; });
  expectRefused([](auto& p) { p.speed = 0; });
  expectRefused([](auto& p) { p.pressure = -1; });
  expectRefused([](auto& p) { p.gamma = 1; });
  expectRefused([](auto& p) { p.round = Vec3::Zero(); });
  expectRefused([](auto& p) { p.round = Vec3(2, 0, 0); });
  EXPECT_THROW(Noh(NohProblem()).at(Vec3::Zero(), -1), std::invalid_argument);
}

}  // namespace
}  // namespace tushar::reference
