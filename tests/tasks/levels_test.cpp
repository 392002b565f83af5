#include <gtest/gtest.h>

#include <cmath>

#include "core/core.hpp"
#include "core/tasks/reflux.hpp"
#include "core/tasks/regrid.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

constexpr CellLabel<double> value{"c.value", "1", "a number in each cell"};
constexpr ReductionLabel<Sum> total{"total", "1", "integral over the grid"};
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

/// Compares away from the sides of the grid, where the slope is unknown.
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

/// A smooth field that is periodic along all axes.
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

namespace {

/// Upwind advection along all axes with velocity 1 m/s: dU/dt = - sum_d dU/dx_d.
template <int D>
void advect(const Patch& patch, CellView<const double> old, double dt, CellView<double> fresh, RimFlux<double> flux) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    fresh[cell] = old[cell];
    for (int d = 0; d < D; ++d) fresh[cell] -= dt / level.spacing(d) * (old[cell] - old[cell - Index<D>::unit(d)]);
  });
  flux.forEachFace<D>([&](const Index<D>& cell, int d, int side, double& through) {
    through += old[side == 0 ? cell - Index<D>::unit(d) : cell];
  });
}
template <int D>
void setStep(const Patch&, Minimum& dt) {
  dt.add(0.2 / 128 / D);
}
template <int D>
void integrate(const Patch& patch, CellView<const double> values, Sum& sum) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { sum.add(patch.level().cellVolume() * values[cell]); });
}

/// A wave after a number of steps: its integral before and after, and its cells in the order of the curve.
struct Advected {
  double before, after;
  std::vector<double> cells;
};

template <int D>
std::vector<double> cellsAlongCurve(test::Runner& run) {
  std::vector<double> cells;
  const int number = run.table.find("c.value", -1);
  for (const grid::BlockId& leaf : run.grid.tree().leaves())
    forEach<3>(grid::cellsOf(leaf, run.grid.blockCells(), D), [&](const Index3& cell) {
      const data::Variable held =
          run.warehouse.variable(data::Generation::old, number, run.grid.patchOf(cell, leaf.level).id());
      cells.push_back(reinterpret_cast<const double*>(held.values)[held.stored.offset(cell)]);
    });
  return cells;
}

template <int D>
Advected advected(int blocksPerPatch, int threads = 1) {
  test::Runner run(refined<D>(3, true, blocksPerPatch), threads);
  TaskList start, step, limit, sums;
  start.perPatch("fill", fillWave<D>, computes(value));
  limit.perPatch("limit", setStep<D>, computes(delT));
  step.perPatch("advect", advect<D>, requiresOld(value, 1), requiresOld(delT), computes(value), keepsFlux(value));
  sums.perPatch("integrate", integrate<D>, requiresOld(value), computes(total));
  TaskGraph starts = run.compile(start, {"c.value"}), steps = run.compile(withRefluxing(step), {"c.value"}, true),
            limits = run.compile(limit, {"delT"}), integrals = run.compile(sums, {"total"});
  const auto integral = [&] {
    run.step(integrals);
    return run.warehouse.reductionValues(run.table.find("total", -1)).at(0);
  };
  run.step(starts);
  run.step(limits);
  Advected result{integral(), 0, {}};
  for (int k = 0; k < 20; ++k) run.step(steps);
  result.after = integral();
  result.cells = cellsAlongCurve<D>(run);
  return result;
}

template <int D>
void checkAdvection() {
  const Advected one = advected<D>(1);
  EXPECT_NEAR(one.after, one.before, 4e-16 * one.before * D);
  for (const int blocks : {2, 3, 8}) EXPECT_EQ(advected<D>(blocks).cells, one.cells);
  EXPECT_EQ(advected<D>(2, 3).cells, one.cells);
}

}  // namespace

TEST(Levels, KeepWhatFlowsBetweenThemAndHaveTheSameBitsInPatchesOfAnySize) {
  checkAdvection<1>();
  checkAdvection<2>();
  checkAdvection<3>();
}

TEST(Levels, HaveFluxesOfTheTypeOfTheirVariableThoughOthersHaveItsName) {
  static constexpr CellLabel<Vec<1>> inOneDimension{"c.flow", "m/s", "a vector"};
  static constexpr CellLabel<Vec<3>> inThree{"c.flow", "m/s", "a vector"};
  EXPECT_EQ(data::rimLabelOf(inOneDimension).bytes, sizeof(Vec<1>));
  EXPECT_EQ(data::rimLabelOf(inThree).bytes, sizeof(Vec<3>));
  EXPECT_EQ(&data::rimLabelOf(inThree), &data::rimLabelOf(inThree));
}

TEST(Levels, AreRefluxedByATaskBehindTheOneThatKeepsTheFluxes) {
  test::Runner run(refined<1>(2, true, 1));
  TaskList list;
  list.perPatch("advect", advect<1>, requiresOld(value, 1), requiresOld(delT), computes(value), keepsFlux(value));
  EXPECT_EQ(withRefluxing(list).tasks().size(), 2U);
  EXPECT_EQ(withRefluxing(list).tasks().back().name, "reflux c.value");
}

namespace {

/// A constant field that grows by 1 in a step.
void fillBefore(const Patch&, CellView<double> values) { values.fill(3); }
void fillAfter(const Patch&, CellView<const double>, CellView<double> values) { values.fill(4); }
/// Compares the growth of ghosts beside [16, 48), the cells of level 1 of two; other ghosts have not grown.
void compareGrowth(const Patch&, CellView<const double> values, Maximum& growth) {
  forEach<1>(values.box(), [&](const Index<1>& cell) {
    if (cell[0] < 16 || cell[0] >= 48)
      growth.add(values[cell] - 3);
    else
      EXPECT_EQ(values[cell], 3);
  });
}

}  // namespace

TEST(Levels, HaveGhostsInCoarserCellsThatAreBetweenOldAndNewAtAPartOfTheirStep) {
  for (const double part : {0.0, 0.25, 0.5}) {
    test::Runner run(refined<1>(2, false, 1));
    TaskList start, step, look;
    start.perPatch("fill", fillBefore, computes(value));
    step.perPatch("grow", fillAfter, requiresOld(value, 2), computes(value));
    look.perPatch("compare", compareGrowth, requiresOld(value, 2), computes(greatest));
    TaskGraph starts = run.compile(start, {"c.value"}), steps = run.compile(step, {"c.value"}, true),
              looks = run.compile(look, {"greatest"});
    run.step(starts);
    run.scheduler.run(steps, {.level = 0});
    run.scheduler.run(looks, {.level = 1, .part = part});
    EXPECT_EQ(run.warehouse.reductionValues(run.table.find("greatest", -1)).at(0), part);
    run.scheduler.commitLevel(steps, 0);
    run.scheduler.forgetNew(steps);
    run.scheduler.run(looks, {.level = 1});
    EXPECT_EQ(run.warehouse.reductionValues(run.table.find("greatest", -1)).at(0), 1);
  }
}

namespace {

/// The waves of checkAdvection on three levels, each with two steps per step of the next coarser level.
template <int D>
class SteppedWaves {
 public:
  explicit SteppedWaves(int blocksPerPatch, int threads = 1) : run_(refined<D>(3, true, blocksPerPatch), threads) {
    TaskList start, list, sums;
    start.perPatch("fill", fillWave<D>, computes(value));
    list.perPatch("advect", advect<D>, requiresOld(value, 1), requiresOld(delT), computes(value), keepsFlux(value));
    sums.perPatch("integrate", integrate<D>, requiresOld(value), computes(total));
    const SteppedByLevel lists = withRegisters(list);
    Names wanted = registersOf(lists.advance);
    EXPECT_EQ(wanted.size(), 1U);
    wanted.insert("c.value");
    TaskGraph starts = run_.compile(start, {"c.value"});
    advance_ = run_.compile(lists.advance, wanted, true);
    reflux_ = run_.compile(lists.reflux, {"c.value"});
    integrals_ = run_.compile(sums, {"total"});
    run_.step(starts);
  }

  double integral() {
    run_.step(integrals_);
    return run_.warehouse.reductionValues(run_.table.find("total", -1)).at(0);
  }
  void step() {
    advance(0, 0.8 / 128 / D, 0);
    run_.scheduler.forgetNew(advance_);
  }
  std::vector<double> cells() { return cellsAlongCurve<D>(run_); }

 private:
  void advance(int level, double dt, double part) {
    const StepInfo at{.delT = dt, .level = level, .part = part};
    run_.warehouse.template reduction<Minimum>(run_.table.find(delT.name, -1)).value = dt;
    run_.warehouse.template reduction<Minimum>(run_.table.find(partOfStep.name, -1)).value = part;
    run_.scheduler.run(advance_, at);
    if (level < 2) {
      advance(level + 1, dt / 2, 0);
      advance(level + 1, dt / 2, 0.5);
      run_.scheduler.run(reflux_, at);
    }
    run_.scheduler.commitLevel(advance_, level);
  }

  test::Runner run_;
  TaskGraph advance_, reflux_, integrals_;
};

template <int D>
void checkSteppedAdvection() {
  const auto after = [](int blocksPerPatch, int threads) {
    SteppedWaves<D> waves(blocksPerPatch, threads);
    const double before = waves.integral();
    for (int k = 0; k < 5; ++k) waves.step();
    EXPECT_NEAR(waves.integral(), before, 4e-16 * before * D);
    return waves.cells();
  };
  const std::vector<double> one = after(1, 1);
  for (const int blocks : {2, 3, 8}) EXPECT_EQ(after(blocks, 1), one);
  EXPECT_EQ(after(2, 3), one);
  const std::vector<double> together = advected<D>(1).cells;  // in as many steps as the finest level has made
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_NEAR(one[k], together[k], 0.02 * std::pow(2.5, D));
}

}  // namespace

TEST(Levels, KeepWhatFlowsBetweenThemInStepsOfTheirOwn) {
  checkSteppedAdvection<1>();
  checkSteppedAdvection<2>();
  checkSteppedAdvection<3>();
}

namespace {

/// Refines the first block, and coarsens the middle by two levels.
grid::BlockTree otherTree(const grid::Grid& grid) { return grid.tree().regridded({{0, {}}}, {}); }

template <int D>
void checkRegridding(int blocksPerPatch) {
  test::Runner run(refined<D>(3, false, blocksPerPatch));
  TaskList start, sums, compared;
  start.perPatch("fill", fillLinear<D>, computes(value));
  sums.perPatch("integrate", integrate<D>, requiresOld(value, 1), computes(total));
  compared.perPatch("compare", compareLinear<D>, requiresOld(value), computes(greatest));
  TaskGraph starts = run.compile(start, {"c.value"}), integrals = run.compile(sums, {"total"}),
            compares = run.compile(compared, {"greatest"});
  const auto measured = [&](TaskGraph& graph, const char* name) {
    run.step(graph);
    return run.warehouse.reductionValues(run.table.find(name, -1)).at(0);
  };
  run.step(starts);
  const double before = measured(integrals, "total");
  const std::uint64_t cells = run.grid.cellCount();
  regrid(run.grid, otherTree(run.grid), run.warehouse, {0, {run.table.find("c.value", -1)}});
  run.scheduler.forgetLayout();
  EXPECT_NE(run.grid.cellCount(), cells);
  EXPECT_NEAR(measured(integrals, "total"), before, 4e-15 * before);
  EXPECT_LT(measured(compares, "greatest"), 1e-13);
}

}  // namespace

TEST(Levels, RegriddingKeepsTheIntegralAndALinearField) {
  for (const int blocks : {1, 2, 8}) {
    checkRegridding<1>(blocks);
    checkRegridding<2>(blocks);
    checkRegridding<3>(blocks);
  }
}

// All blocks of the finest level would be 2^28.
TEST(Levels, RegriddingTakesAsLongAsThereAreCellsHoweverManyLevelsThereMayBe) {
  grid::Domain domain = refined<2>(14, false, 8);
  domain.refinement.regions.clear();
  domain.resolution = {{16, 16, 1}};
  test::Runner run(domain);
  TaskList start;
  start.perPatch("fill", fillLinear<2>, computes(value));
  TaskGraph starts = run.compile(start, {"c.value"});
  run.table.widen(run.table.find("c.value", -1), 1);
  run.step(starts);
  run.scheduler.fillGhosts({run.table.find("c.value", -1)});
  regrid(run.grid, otherTree(run.grid), run.warehouse, {0, {run.table.find("c.value", -1)}});
  EXPECT_EQ(run.grid.cellCount(), (3u + 4u) * 64u);
}

}  // namespace tushar::tasks
