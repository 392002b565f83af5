#include "core/numerics/composite_diffusion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "tests/support/levels.hpp"

namespace tushar::numerics {

namespace {

constexpr grid::BoundaryLabel<double> phiLabel{"Phi"};

input::Expression formula(const char* text) { return *input::Expression::parse(text); }

/// A unit box of 16 cells along each axis, three levels in blocks of 4: fine regions with edges and corners within the
/// grid, one that touches its sides, and two regions separated by a single coarse block.
template <int D>
grid::Domain refined() {
  grid::Domain domain = test::unitBox<D>(16);
  domain.refinement.levels = 3;
  for (int d = 0; d < 3; ++d) domain.refinement.blockCells[d] = d < D ? 4 : 1;
  domain.refinement.regions = {
      {1, {0, 0, 0}, {0.1, 0.1, 0.1}}, {2, {0.55, 0.3, 0.55}, {0.6, 0.35, 0.7}}, {1, {0.8, 0.8, 0.3}, {0.9, 0.9, 0.4}}};
  return domain;
}

/// Calls `visit(level, cell)` for all cells.
template <int D, class Visit>
void forEachLeaf(const grid::Grid& grid, Visit&& visit) {
  for (const grid::Patch& patch : grid.patches())
    grid::forEach<D>(patch.cells(), [&](const Index<D>& cell) { visit(patch.level(), cell); });
}

/// Returns the diffusion balance of a field given as a function of position.
template <int D, class Phi>
double applied(const Balance<D>& balance, const grid::Grid& grid, Phi&& phi) {
  const auto at = [&](int level, const Index<D>& cell) { return phi(grid.level(level).cellCentre<D>(cell)); };
  double sum = balance.constant;
  for (std::size_t k = 0; k < balance.count; ++k) sum += balance.weights[k] * at(balance.level, balance.cells[k]);
  for (const auto& far : balance.far) sum += far.weight * at(far.level, far.cell);
  return sum;
}

template <int D>
bool isAtSide(const grid::Level& level, const Index<D>& cell) {
  for (int d = 0; d < D; ++d)
    if (cell[d] == 0 || cell[d] == level.cells().upper[d] - 1) return true;
  return false;
}

/// Returns the largest error per volume of 3 times the Laplacian of x² - 3 y² + 2 z² + 5 x y - x z + 4 y z + x, in
/// cells away from the sides.
template <int D>
double errorForAParabola() {
  const grid::Grid grid(refined<D>());
  const input::Expression k = 3.0;
  const CompositeDiffusion<D> diffusion(grid, k, phiLabel);
  const auto parabola = [](const Vec<D>& at) {
    const double x = at[0], y = D > 1 ? at[D > 1 ? 1 : 0] : 0, z = D > 2 ? at[D - 1] : 0;
    return x * x - 3 * y * y + 2 * z * z + 5 * x * y - x * z + 4 * y * z + x;
  };
  const double laplacian = D == 1 ? 2 : D == 2 ? -4 : 0;
  double worst = 0;
  int beside = 0;
  forEachLeaf<D>(grid, [&](const grid::Level& level, const Index<D>& cell) {
    if (isAtSide<D>(level, cell)) return;
    const Balance<D> balance = diffusion.balance(level.number(), cell);
    beside += balance.far.empty() ? 0 : 1;
    worst = std::max(worst, std::abs(applied(balance, grid, parabola) / level.cellVolume() - 3 * laplacian));
  });
  EXPECT_GT(beside, 2);
  return worst;
}

/// Returns the largest row sum and column sum of the weights, relative to the largest weight, for an insulated box that
/// is periodic along x.
template <int D>
std::pair<double, double> sumsOfRowsAndColumns() {
  grid::Domain domain = refined<D>();
  domain.periodic[0] = 1;
  const grid::Grid grid(domain);
  const input::Expression k = formula(D == 3 ? "1 + y*z" : "2 + sin(6*x)");
  const CompositeDiffusion<D> diffusion(grid, k, phiLabel);
  std::map<std::pair<int, std::uint64_t>, double> columns;
  double worstRow = 0, greatest = 0;
  forEachLeaf<D>(grid, [&](const grid::Level& level, const Index<D>& cell) {
    const Balance<D> balance = diffusion.balance(level.number(), cell);
    double row = 0;
    const auto count = [&](int at, const Index<D>& image, double weight) {
      const grid::Level& there = grid.level(at);
      columns[{at, there.cellNumber<D>(there.wrapped<D>(image))}] += weight;
      row += weight;
      greatest = std::max(greatest, std::abs(weight));
    };
    for (std::size_t n = 0; n < balance.count; ++n) count(balance.level, balance.cells[n], balance.weights[n]);
    for (const auto& far : balance.far) count(far.level, far.cell, far.weight);
    worstRow = std::max(worstRow, std::abs(row));
  });
  EXPECT_EQ(columns.size(), grid.cellCount());
  double worstColumn = 0;
  for (const auto& [cell, sum] : columns) worstColumn = std::max(worstColumn, std::abs(sum));
  return {worstRow / greatest, worstColumn / greatest};
}

/// Returns the largest residual flux in a cell of a line whose left half is refined; k is 1 on one side of the middle
/// and 1e6 on the other, and phi has flux 1.
double leftOver(const char* k, double left, double right) {
  grid::Domain domain = test::unitBox<1>(16);
  domain.refinement = {2, {{4, 1, 1}}, {}, {{1, {0, 0, 0}, {0.5, 0, 0}}}};
  const grid::Grid grid(domain);
  const input::Expression coefficient = formula(k);
  const CompositeDiffusion<1> diffusion(grid, coefficient, phiLabel);
  double worst = 0;
  forEachLeaf<1>(grid, [&](const grid::Level& level, const Index<1>& cell) {
    if (isAtSide<1>(level, cell)) return;
    const auto phi = [&](const Vec<1>& x) { return (x[0] - 0.5) / (x[0] < 0.5 ? left : right); };
    worst = std::max(worst, std::abs(applied(diffusion.balance(level.number(), cell), grid, phi)));
  });
  return worst;
}

}  // namespace

// Only rounding remains: that of values of about 5, divided by squared widths of 1/64.
TEST(CompositeDiffusion, IsExactForParabolasAtFacesEdgesAndCornersOfLevels) {
  EXPECT_LT(errorForAParabola<1>(), 1e-10);
  EXPECT_LT(errorForAParabola<2>(), 1e-10);
  EXPECT_LT(errorForAParabola<3>(), 1e-10);
}

TEST(CompositeDiffusion, LosesNothingBetweenLevelsAndHasNoFluxWhereNothingVaries) {
  for (const auto& [row, column] : {sumsOfRowsAndColumns<1>(), sumsOfRowsAndColumns<2>(), sumsOfRowsAndColumns<3>()}) {
    EXPECT_LT(row, 1e-14);
    EXPECT_LT(column, 1e-14);
  }
}

TEST(CompositeDiffusion, KeepsTheFluxWhereTheCoefficientJumpsBetweenLevels) {
  EXPECT_LT(leftOver("x < 0.5 ? 1 : 1e6", 1, 1e6), 1e-8);  // rounding times 1e6
  EXPECT_LT(leftOver("x < 0.5 ? 1e6 : 1", 1e6, 1), 1e-8);
}

TEST(CompositeDiffusion, IsThatOfItsLevelWhereThereIsOne) {
  const grid::Grid grid(test::unitBox<2>(6));
  const input::Expression k = formula("1 + x*y");
  const CompositeDiffusion<2> composite(grid, k, phiLabel);
  const Diffusion<2> diffusion(grid.level(), k, phiLabel);
  forEachLeaf<2>(grid, [&](const grid::Level&, const Index<2>& cell) {
    const Balance<2> ours = composite.balance(0, cell), expected = diffusion.balance(cell);
    EXPECT_EQ(ours.count, expected.count);
    EXPECT_EQ(ours.weights, expected.weights);
    EXPECT_TRUE(ours.far.empty());
  });
}

}  // namespace tushar::numerics
