#include "components/analysis/control_vol_fluxes.hpp"

#include <gtest/gtest.h>

namespace tushar::analysis {
namespace {

/// A domain of 4 x 3 cells of .5 m x .2 m, one cell of 1 m along z.
grid::Domain domain() {
  grid::Domain domain;
  domain.upper = {2, .6, 0};
  domain.resolution = {{4, 3, 1}};
  return domain;
}

/// Returns the fluxes through the sides of a box for a gas whose density is 1 + the cell's index along x.
std::vector<double> flowOf(const Level& level, const Box& box, const Vec<2>& v) {
  const Patch patch(level, 0, level.cells());
  std::vector<double> densities(level.cells().size());
  std::vector<Vec<2>> velocities(level.cells().size(), v);
  const CellView<double> density(densities.data(), level.cells());
  forEach<2>(level.cells(), [&](const Index<2>& cell) { density[cell] = 1 + cell[0]; });
  BoxFlow flow;
  addBoxFlow<2>(patch, box, 0, CellView<const double>(densities.data(), level.cells()),
                CellView<const Vec<2>>(velocities.data(), level.cells()), flow);
  return flow.values();
}

void expectNear(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-14) << k;  // round-off
}

TEST(ControlVolFluxes, TakesTheDensityUpwindThroughEachSide) {
  const Level level(domain());
  ASSERT_EQ(level.dimension(), 2);
  const Box box{{{1, 0, 0}}, {{3, 3, 1}}};
  const double mass = 3 * .1 * (2 + 3), area = .6;
  expectNear(flowOf(level, box, {10, 0}), {mass, 10 * area * 1, 10 * area * 3, 0, 0, 0, 0});
  expectNear(flowOf(level, box, {-10, 0}), {mass, -10 * area * 2, -10 * area * 4, 0, 0, 0, 0});
  expectNear(flowOf(level, box, {0, 2}), {mass, 0, 0, 2 * .5 * 5, 2 * .5 * 5, 0, 0});
}

TEST(ControlVolFluxes, AtAnEndOfTheGridTheConditionOfTheSideCounts) {
  const Box all{{{0, 0, 0}}, {{4, 3, 1}}};
  const double mass = 3 * .1 * (1 + 2 + 3 + 4), area = .6;
  const Level open(domain());
  expectNear(flowOf(open, all, {10, 0}), {mass, 10 * area * 1, 10 * area * 4, 0, 0, 0, 0});
  grid::Domain sides = domain();
  sides.boundaries.face(0, 0).push_back({grid::symmetric, BoundaryKind::symmetry});
  sides.boundaries.face(0, 1).push_back({BoundaryLabel<Vec3>("Velocity"), BoundaryKind::dirichlet, {3, 0, 0}});
  const Level closed(sides);
  expectNear(flowOf(closed, all, {10, 0}), {mass, 0, 3 * area * 4, 0, 0, 0, 0});
}

TEST(ControlVolFluxes, AtAnEndOfTheGridTheConditionOfAPartCounts) {
  const Box all{{{0, 0, 0}}, {{4, 3, 1}}};
  const double mass = 3 * .1 * (1 + 2 + 3 + 4), face = .2;
  const auto middle = grid::SidePart::rectangle(0, Vec3(2, .2, -1), Vec3(2, .4, 2));
  const BoundaryLabel<Vec3> velocity("Velocity");
  grid::Domain sides = domain();
  sides.boundaries.face(0, 1).push_back({velocity, BoundaryKind::dirichlet, {3, 0, 0}});
  sides.boundaries.parts[1] = {{middle, {{velocity, BoundaryKind::dirichlet, Vec3(7, 0, 0)}}}};
  expectNear(flowOf(Level(sides), all, {10, 0}), {mass, 10 * 3 * face * 1, (3 + 7 + 3) * face * 4, 0, 0, 0, 0});
}

TEST(ControlVolFluxes, WhatSeveralPatchesHaveAddsUp) {
  BoxFlow all, part;
  part.mass.add(2);
  part.through[3].add(5);
  all.merge(part);
  all.merge(part);
  EXPECT_EQ(all.values(), (std::vector<double>{4, 0, 0, 0, 10, 0, 0}));
}

}  // namespace
}  // namespace tushar::analysis
