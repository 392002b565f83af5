#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/levels.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

constexpr CellLabel<double> value{"c.value", "1", "a number in each cell"};
constexpr ReductionLabel<Maximum> greatest{"greatest", "1", "greatest difference"};

/// A grid of 32 cells along each axis in blocks of 8 with the middle refined, twice in its centre.
template <int D>
grid::Domain refined(int levels, bool isPeriodic, int blocksPerPatch) {
  grid::Domain domain;
  domain.upper = Vec3::Zero();
  domain.refinement.levels = levels;
  domain.refinement.blocksPerPatch = Index3::filled(blocksPerPatch);
  for (int d = 0; d < D; ++d) {
    domain.upper[d] = 1;
    domain.resolution[d] = 32;
    domain.periodic[d] = isPeriodic;
  }
  const double edge = isPeriodic ? 0.0 : 0.3;
  domain.refinement.regions.push_back({1, Vec3(edge, 0.3, 0.3), Vec3(0.7, 0.7, 0.7)});
  if (levels > 2) domain.refinement.regions.push_back({2, Vec3(edge, 0.45, 0.45), Vec3(0.55, 0.55, 0.55)});
  return domain;
}

template <int D>
double linear(const Vec<D>& x) {
  double sum = 1;
  for (int d = 0; d < D; ++d) sum += (d + 2) * x[d];
  return sum;
}

template <int D>
void fillLinear(const Patch& patch, CellView<double> values) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { values[cell] = linear<D>(patch.level().cellCentre<D>(cell)); });
}

/// Away from sides of the grid, beside which nothing is known of the slope.
template <int D>
void compareLinear(const Patch& patch, CellView<const double> values, Maximum& difference) {
  const Level& level = patch.level();
  forEach<D>(values.box(), [&](const Index<D>& cell) {
    const Vec<D> x = level.cellCentre<D>(cell);
    for (int d = 0; d < D; ++d)
      if (x[d] < 2 * level.spacing(d) || x[d] > 1 - 2 * level.spacing(d)) return;
    difference.add(std::abs(values[cell] - linear<D>(x)));
  });
}

template <int D>
double greatestDifferenceOfLinear(int levels, int width, int blocksPerPatch) {
  test::Runner run(refined<D>(levels, false, blocksPerPatch));
  TaskList list;
  list.perPatch("fill", fillLinear<D>, computes(value));
  list.perPatch("compare", compareLinear<D>, requiresNew(value, width), computes(greatest));
  TaskGraph graph = run.compile(list, {"greatest"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("greatest", -1)).at(0);
}

/// A smooth field that repeats along all axes.
template <int D>
double wave(const Vec<D>& x) {
  double product = 1;
  for (int d = 0; d < D; ++d) product *= 1.5 + std::sin(2 * M_PI * x[d]);
  return product;
}
template <int D>
void fillWave(const Patch& patch, CellView<double> values) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { values[cell] = wave<D>(patch.level().cellCentre<D>(cell)); });
}
template <int D>
void compareWave(const Patch& patch, CellView<const double> values, Maximum& difference) {
  forEach<D>(values.box(), [&](const Index<D>& cell) {
    difference.add(std::abs(values[cell] - wave<D>(patch.level().cellCentre<D>(cell))));
  });
}
}  // namespace

TEST(Levels, GhostsOfALinearFieldAreExactWhereverTheyStand) {
  for (const int levels : {2, 3})
    for (const int blocks : {1, 2, 8})
      for (const int width : {1, 2, 3}) {
        EXPECT_LT(greatestDifferenceOfLinear<1>(levels, width, blocks), 1e-14);
        EXPECT_LT(greatestDifferenceOfLinear<2>(levels, width, blocks), 1e-13);
        EXPECT_LT(greatestDifferenceOfLinear<3>(levels, width, blocks), 1e-13);
      }
}

namespace {

template <int D>
double greatestDifferenceOfWave() {
  test::Runner run(refined<D>(3, true, 2));
  TaskList list;
  list.perPatch("fill", fillWave<D>, computes(value));
  list.perPatch("compare", compareWave<D>, requiresNew(value, 2), computes(greatest));
  TaskGraph graph = run.compile(list, {"greatest"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("greatest", -1)).at(0);
}

}  // namespace

// The mean of a fine cell's wave differs from its value in the middle by h²/24 of the second derivative, 4
// π² 2.5^(D-1); limited slopes at crests by as much as a quarter of h² of it.
TEST(Levels, GhostsOfASmoothFieldAreOfSecondOrderAlsoAcrossPeriodicSides) {
  const double h = 1.0 / 32;
  EXPECT_LT(greatestDifferenceOfWave<1>(), h * h * 4 * M_PI * M_PI / 2);
  EXPECT_LT(greatestDifferenceOfWave<2>(), h * h * 4 * M_PI * M_PI * 2.5);
  EXPECT_LT(greatestDifferenceOfWave<3>(), h * h * 4 * M_PI * M_PI * 2.5 * 2.5 * 1.5);
}

}  // namespace tushar::tasks
