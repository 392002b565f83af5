#include "core/numerics/diffusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tushar::numerics {

namespace {

constexpr grid::BoundaryLabel<double> phiLabel{"Phi"};
using grid::BoundaryKind;

/// A line of unit length with four cells: h = 0.25.
grid::Domain line() {
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{4, 1, 1}};
  return domain;
}

input::Expression formula(const char* text) { return *input::Expression::parse(text); }

/// Returns div(k grad phi) in a cell of a line.
double diffusionIn(int cell, const grid::Domain& domain, const input::Expression& k, std::vector<double> phi) {
  const grid::Level level(domain);
  const Diffusion<1> diffusion(level, k, phiLabel);
  return diffusion(data::CellView<const double>(phi.data(), level.cells()), Index<1>{{cell}});
}

/// Returns div(k grad phi) in a cell of a line, computed from the row of a linear system.
double balanceIn(int cell, const grid::Domain& domain, const input::Expression& k, std::vector<double> phi) {
  const grid::Level level(domain);
  const Balance<1> balance = Diffusion<1>(level, k, phiLabel).balance(Index<1>{{cell}});
  double sum = balance.constant;
  for (std::size_t n = 0; n < balance.count; ++n) sum += balance.weights[n] * phi[std::size_t(balance.cells[n][0])];
  return sum / level.cellVolume();
}

}  // namespace

TEST(HarmonicMean, IsTwiceTheSmallerOfTwoThatDifferVeryMuch) {
  EXPECT_DOUBLE_EQ(harmonicMean(3, 3), 3);
  EXPECT_NEAR(harmonicMean(1, 1e12), 2, 1e-11);
}

TEST(Diffusion, IsTheSecondDifferenceBetweenCells) {
  EXPECT_NEAR(diffusionIn(1, line(), 2.0, {1, 5, 2, 8}), 2 * 16 * (1 - 10 + 2), 1e-12);
  EXPECT_NEAR(balanceIn(1, line(), 2.0, {1, 5, 2, 8}), 2 * 16 * (1 - 10 + 2), 1e-12);
}

TEST(Diffusion, TakesTheHarmonicMeanWhereTheCoefficientJumps) {
  const input::Expression k = formula("x < 0.5 ? 1 : 3");
  const double atJump = 1.5, expected = 16 * (atJump * (2 - 5) - 1 * (5 - 1));

  EXPECT_NEAR(diffusionIn(1, line(), k, {1, 5, 2, 8}), expected, 1e-12);
  EXPECT_NEAR(balanceIn(1, line(), k, {1, 5, 2, 8}), expected, 1e-12);
}

TEST(Diffusion, LetsNothingThroughASideWithoutACondition) {
  EXPECT_NEAR(diffusionIn(0, line(), 1.0, {1, 5, 2, 8}), 16 * (5 - 1), 1e-12);
  EXPECT_NEAR(balanceIn(0, line(), 1.0, {1, 5, 2, 8}), 16 * (5 - 1), 1e-12);
}

TEST(Diffusion, KeepsAValueAtASide) {
  grid::Domain domain = line();
  domain.boundaries.face(0, 0).push_back({phiLabel, BoundaryKind::dirichlet, Vec3(3, 0, 0)});
  const double expected = 16 * (5 - 1) + 2 * 16 * (3 - 1);

  EXPECT_NEAR(diffusionIn(0, domain, 1.0, {1, 5, 2, 8}), expected, 1e-12);
  EXPECT_NEAR(balanceIn(0, domain, 1.0, {1, 5, 2, 8}), expected, 1e-12);
}

TEST(Diffusion, TakesInWhatTheOutwardDerivativeGives) {
  grid::Domain domain = line();
  domain.boundaries.face(0, 1).push_back({phiLabel, BoundaryKind::neumann, Vec3(3, 0, 0)});
  const double expected = 16 * (2 - 8) + 3 / 0.25;

  EXPECT_NEAR(diffusionIn(3, domain, 1.0, {1, 5, 2, 8}), expected, 1e-12);
  EXPECT_NEAR(balanceIn(3, domain, 1.0, {1, 5, 2, 8}), expected, 1e-12);
}

TEST(Diffusion, GivesTheSumOfWeightsThatLimitsAStep) {
  const grid::Level level(line());
  const input::Expression k = 2.0;

  EXPECT_DOUBLE_EQ(Diffusion<1>(level, k, phiLabel).rate(Index<1>{{1}}), 2 * 2 * 16);
}

/// Of a part of a grid, k is held in its cells and beside them; elsewhere, it is evaluated as before.
TEST(Diffusion, IsTheSameWithHeldCoefficients) {
  grid::Domain domain = line();
  const input::Expression k = formula("1 + x");
  for (const bool isPeriodic : {false, true}) {
    domain.periodic[0] = isPeriodic;
    const grid::Level level(domain);
    const Diffusion<1> once(level, k, phiLabel);
    for (const int upper : {2, 4}) {
      const Diffusion<1> held(level, k, phiLabel, grid::Box{{}, Index3{{upper, 1, 1}}});
      for (int i = 0; i < 4; ++i) EXPECT_EQ(held.rate(Index<1>{{i}}), once.rate(Index<1>{{i}}));
    }
  }
}

TEST(Diffusion, ReachesAcrossAPeriodicSide) {
  grid::Domain domain = line();
  domain.periodic = {{1, 0, 0}};
  const grid::Level level(domain);
  const input::Expression k = formula("x < 0.25 ? 1 : 3");

  const Balance<1> balance = Diffusion<1>(level, k, phiLabel).balance(Index<1>{{0}});

  ASSERT_EQ(balance.count, 3u);
  EXPECT_EQ(balance.cells[1][0], -1);
  EXPECT_NEAR(balance.weights[1], 1.5 / 0.25, 1e-12);
  EXPECT_NEAR(balance.weights[0], -2 * 1.5 / 0.25, 1e-12);
}

}  // namespace tushar::numerics
