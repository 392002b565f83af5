#include <gtest/gtest.h>

#include <cmath>

#include "tests/poisson/solved.hpp"

// Poisson's equation on fixed grids of several levels.

namespace tushar::poisson {

namespace {

/// Three levels in blocks of a quarter of the grid, so that finer grids have them in the same places: a finer region
/// with edges and corners within the grid, and one at its lower sides.
template <int D>
grid::Domain refined(grid::Domain domain) {
  domain.refinement.levels = 3;
  for (int d = 0; d < 3; ++d) domain.refinement.blockCells[d] = d < D ? domain.resolution[d] / 4 : 1;
  domain.refinement.regions = {{2, {0.5, 0.25, 0.5}, {0.75, 0.5, 0.625}}, {1, {0, 0, 0}, {0.25, 0.25, 0.25}}};
  return domain;
}

/// Returns the order of convergence between `cells` and twice as many, from the maximum error.
template <int D>
double orderOfTheGreatest(int cells, const Settings& settings, const std::string& exact) {
  const auto worst = [&](int n) { return solved<D>(refined<D>(keptAtOne<D>(n)), settings, exact).worst; };
  return std::log2(worst(cells) / worst(2 * cells));
}

}  // namespace

TEST(PoissonOnLevels, IsOfSecondOrderInTheMaximumNorm) {
  // phi = 1 + sin(pi x) ..., k = 1 + x
  const Settings line = settingsOf("pi*cos(pi*x) - (1 + x)*pi^2*sin(pi*x)", "1 + x");
  EXPECT_GT((orderOfTheGreatest<1>(32, line, "1 + sin(pi*x)")), 1.9);
  const Settings plane = settingsOf("pi*cos(pi*x)*sin(pi*y) - 2*(1 + x)*pi^2*sin(pi*x)*sin(pi*y)", "1 + x");
  EXPECT_GT((orderOfTheGreatest<2>(16, plane, "1 + sin(pi*x)*sin(pi*y)")), 1.9);
  const Settings space = settingsOf("-3*pi^2*sin(pi*x)*sin(pi*y)*sin(pi*z)");
  EXPECT_GT((orderOfTheGreatest<3>(16, space, "1 + sin(pi*x)*sin(pi*y)*sin(pi*z)")), 1.9);
}

TEST(PoissonOnLevels, IsOfSecondOrderInAPeriodicBoxWhereAConstantIsFree) {
  // The levels are symmetric about x = 1/2 and the source is odd, so that its sum over their cells is 0, too.
  const Settings settings = settingsOf("-8*pi^2*sin(2*pi*x)*cos(2*pi*y)");
  const auto worst = [&](int cells) {
    grid::Domain domain = test::unitBox<2>(cells);
    domain.periodic = {{1, 1, 0}};
    domain.refinement = {2, {{cells / 4, cells / 4, 1}}, {}, {{1, {0.25, 0.25, 0}, {0.75, 0.5, 0}}}};
    return solved<2>(domain, settings, "sin(2*pi*x)*cos(2*pi*y)").worst;
  };
  EXPECT_GT(std::log2(worst(16) / worst(32)), 1.9);
}

TEST(PoissonOnLevels, HasTheMeanZeroOverTheVolumeWhereAConstantIsFree) {
  // phi = 1.5 x² - x and a constant
  const Solved found = solved<1>(refined<1>(betweenSlopes(16, 1, 2)), settingsOf("3"), "0");
  double sum = 0;
  for (const auto& [cell, phi] : found.phi) sum += phi;
  EXPECT_NEAR(found.mean, 0, 1e-12);
  EXPECT_GT(std::abs(sum / double(found.phi.size())), 1e-3);
}

TEST(PoissonOnLevels, KeepsTheValueOfAPartThatOnlyFinerCellsHave) {
  // The middle of one face of the finer cells is in the part, that of the coarse cell in its place is not.
  grid::Domain domain = test::unitBox<2>(8);
  domain.refinement = {2, {{4, 4, 1}}, {}, {{1, {0.5, 0.5, 0}, {1, 1, 0}}}};
  const auto part = grid::SidePart::rectangle(0, Vec3(1, 0.96, -1), Vec3(1, 0.98, 2));
  domain.boundaries.parts[1] = {{part, {{boundary::phi, BoundaryKind::dirichlet, Vec3(3, 0, 0)}}}};
  Settings settings = settingsOf("0");
  settings.solver = {"preonly", "lu", 1e-10, 1, ""};
  EXPECT_LT(solved<2>(domain, settings, "3").worst, 1e-9);
}

TEST(PoissonOnLevels, NeedsHardlyMoreIterationsThanOnAUniformGrid) {
  const Settings settings = settingsOf("1");
  const double uniform = solved<3>(keptAtOne<3>(16), settings, "0").iterations;
  EXPECT_LE(solved<3>(refined<3>(keptAtOne<3>(16)), settings, "0").iterations, 1.5 * uniform);
  EXPECT_GT(uniform, 1);
}

TEST(PoissonOnLevels, GivesTheSameBitsOnAnyPatches) {
  const Settings settings = settingsOf("-2*pi^2*sin(pi*x)*sin(pi*y)");
  grid::Domain one = refined<2>(keptAtOne<2>(16)), many = one;
  one.refinement.blocksPerPatch = Index3::filled(8);
  many.refinement.blocksPerPatch = Index3::filled(1);
  const Solved alone = solved<2>(one, settings, "0"), shared = solved<2>(many, settings, "0");
  EXPECT_EQ(alone.iterations, shared.iterations);
  EXPECT_EQ(alone.phi, shared.phi);
}

TEST(PoissonOnLevels, IsSolvedDirectly) {
  Settings settings = settingsOf("-2*pi^2*sin(pi*x)*sin(pi*y)");
  const std::string exact = "1 + sin(pi*x)*sin(pi*y)";
  const double expected = solved<2>(refined<2>(keptAtOne<2>(16)), settings, exact).worst;
  for (const char* const preconditioner : {"lu", "cholesky"}) {
    settings.solver = {"preonly", preconditioner, 1e-10, 1, ""};
    EXPECT_NEAR(solved<2>(refined<2>(keptAtOne<2>(16)), settings, exact).worst, expected, 1e-8);
  }
}

}  // namespace tushar::poisson
