#include "components/mpm/gas/paper/mass_projection.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/levels.hpp"

namespace tushar::mpm::gas::paper {

namespace {

/// Particles in a row of cells of width 1/cells, and the measured errors.
struct Row {
  Grid grid;
  const Level& level = grid.level();
  data::ParticleSet set;
  std::vector<Vec<1>> x;
  std::vector<double> density, error, bound;
  Maximum greatestError, greatestRatio;

  /// `places[c]` are the positions of the particles within cell c, from 0 to 1; `rho` is the density at x [m].
  template <class Rho>
  Row(const std::vector<std::vector<double>>& places, const Rho& rho)
      : grid(test::domain({{static_cast<int>(places.size()), 1, 1}})) {
    set.reset(patch(), 2);
    for (std::size_t c = 0; c < places.size(); ++c) {
      const int first = static_cast<int>(x.size());
      for (const double place : places[c]) {
        x.emplace_back((static_cast<double>(c) + place) * level.spacing(0));
        density.push_back(rho(x.back()[0]));
      }
      set.at(Index<1>{{static_cast<int>(c)}}) = {first, static_cast<int>(x.size())};
    }
    set.setOwned(static_cast<int>(x.size()));
    error.resize(level.nodes().size());
    bound.resize(level.nodes().size());
    measureMassProjection(patch(), Gas(), {x.data(), set, level.cells()}, {density.data(), set, level.cells()},
                          {error.data(), level.nodes()}, {bound.data(), level.nodes()}, greatestError, greatestRatio);
  }
  const Patch& patch() const { return grid.patches().front(); }
};

double one(double) { return 1; }

}  // namespace

TEST(MassProjection, HasTheDiscrepancyOfEquation20) {
  EXPECT_NEAR(discrepancy({{0.25, 1}, {0.75, 1}}), 1 / std::sqrt(48.0), 1e-16);
  EXPECT_NEAR(discrepancy({{0.5, 1}}), 1 / std::sqrt(12.0), 1e-16);
  EXPECT_NEAR(discrepancy({{0.0, 1}, {1.0, 1}}), std::sqrt(1.0 / 48 + 1.0 / 16), 1e-16);
}

// One particle per cell at 0.3 of its cell, density 1: a cell gives its upper node 1/2 - 0.3 and its lower node
// 1/2 - 0.7 of its volume; the gradient of S_i is 1/h, so both have the bound D_2 = sqrt(1/12 + 0.2²).
TEST(MassProjection, IsWhatOneComputesByHandForUniformDensity) {
  const Row row({{0.3}, {0.3}}, one);
  const double volume = row.level.cellVolume(), term = std::sqrt(1.0 / 12 + 0.04);

  EXPECT_NEAR(row.error[0], -0.2 * volume, 1e-16);
  EXPECT_NEAR(row.error[1], 0, 1e-16);
  EXPECT_NEAR(row.error[2], 0.2 * volume, 1e-16);
  EXPECT_NEAR(row.bound[0], term * volume, 1e-16);
  EXPECT_NEAR(row.bound[1], 2 * term * volume, 1e-16);
  EXPECT_NEAR(row.greatestError.value, 0.2, 1e-15);
  EXPECT_NEAR(row.greatestRatio.value, 0.2 / term, 1e-15);
}

// rho = 1 + z in a cell with one particle at its middle: integral of (1 + z) z is 5/6, less 3/2 * 1/2; integral of
// ((1 + z) z)'² = (1 + 2z)² is 13/3. For the lower node: (1 + z)(1 - z) gives 2/3 - 3/4, and 4z² gives 4/3.
TEST(MassProjection, IsWhatOneComputesByHandForALine) {
  const CellProjection cell = projectCell({{0.5, 1.5}}, {{0, 1}, {0.5, 1.5}, {1, 2}});

  EXPECT_NEAR(cell.error[0], 2.0 / 3 - 0.75, 1e-15);
  EXPECT_NEAR(cell.error[1], 5.0 / 6 - 0.75, 1e-15);
  EXPECT_NEAR(cell.bound[0], std::sqrt(1.0 / 12 * 4 / 3), 1e-15);
  EXPECT_NEAR(cell.bound[1], std::sqrt(1.0 / 12 * 13 / 3), 1e-15);
}

// The worst case: the only particle of the cell is at a face.
TEST(MassProjection, ComesNearItsBoundWhereParticlesGather) {
  const Row row({{1e-9}}, one);

  EXPECT_NEAR(row.greatestRatio.value, 0.5 / std::sqrt(1.0 / 12 + 0.25), 1e-8);
}

TEST(MassProjection, LosesNoMassOfAUniformGasOverAllNodes) {
  const Row row({{0.1, 0.2, 0.9}, {0.5}, {0.7, 0.3}}, one);
  double sum = 0;
  for (const double e : row.error) sum += e;

  EXPECT_GT(row.greatestError.value, 0.05);
  EXPECT_NEAR(sum, 0, 1e-16);
}

TEST(MassProjection, HoldsItsBoundForAnyParticlesAndDensities) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<std::vector<double>> places(6);
    for (auto& cell : places)
      for (int k = 0; k <= trial % 9; ++k) cell.push_back(uniform(generator));
    const Row row(places, [&](double) { return uniform(generator) < 0.2 ? 100.0 : uniform(generator); });
    for (std::size_t i = 0; i < row.error.size(); ++i) EXPECT_LE(std::abs(row.error[i]), row.bound[i]);
    EXPECT_LE(row.greatestRatio.value, 1);
  }
}

TEST(MassProjection, LeavesOutNodesBesideEmptyCells) {
  const Row row({{0.3}, {0.4}, {}, {0.3}}, one);

  EXPECT_GT(row.bound[1], 0);
  for (const std::size_t node : {2u, 3u}) {
    EXPECT_EQ(row.error[node], 0);
    EXPECT_EQ(row.bound[node], 0);
  }
  EXPECT_NEAR(row.greatestError.value, 0.2, 1e-15);
}

}  // namespace tushar::mpm::gas::paper
