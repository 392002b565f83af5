#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "core/simulation/refinement_marks.hpp"
#include "core/simulation/regridder.hpp"
#include "tests/simulation/cooling.hpp"
#include "tests/support/levels.hpp"
#include "tests/support/run.hpp"

namespace tushar::simulation {

namespace {

using Indicator = Criterion::Indicator;

double of(Indicator indicator, const std::vector<Neighbours>& axes, const std::vector<double>& spacing,
          int components) {
  return indicatorOf(indicator, axes, spacing, components);
}

/// Returns the indicator for the middle of three values in a row, half a metre apart.
double inRow(Indicator indicator, double a, double b, double c) { return of(indicator, {{&a, &b, &c}}, {0.5}, 1); }

/// A row of 4 blocks of 8 cells with up to 3 levels, without prescribed regions.
grid::Domain row(bool isPeriodic = false) {
  grid::Domain domain;
  domain.upper = {1, 0, 0};
  domain.resolution = {{32, 1, 1}};
  domain.periodic[0] = isPeriodic;
  domain.refinement.levels = 3;
  return domain;
}

constexpr CellLabel<double> anyNumber{"c.any", "1", "a number in each cell"};
template <int D>
constexpr CellLabel<Vec<D>> anyVector{"c.vector", "1", "a vector in each cell"};
constexpr ReductionLabel<Sum> wrong{"wrong", "1", "number of wrong marks"};

template <int D>
void fillAny(const Patch& patch, CellView<double> numbers, CellView<Vec<D>> vectors) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double place = static_cast<double>(patch.level().cellNumber<D>(cell));
    numbers[cell] = 1 + 0.2 * std::sin(7 * place * place);
    for (int d = 0; d < D; ++d) vectors[cell][d] = 0.2 * std::cos((3 + d) * place * place);
  });
}

/// The jumps of a variable around a cell.
template <int D, class T>
double jumpAt(const Level& level, const CellView<const T>& values, const Index<D>& cell) {
  const auto numbers = [&](const Index<D>& at) { return reinterpret_cast<const double*>(&values[at]); };
  std::vector<Neighbours> axes;
  for (int d = 0; d < D; ++d) {
    const Index<D> below = cell - Index<D>::unit(d), above = cell + Index<D>::unit(d);
    axes.push_back({cell[d] > 0 ? numbers(below) : nullptr, numbers(cell),
                    above[d] < level.cells().upper[d] ? numbers(above) : nullptr});
  }
  return of(Indicator::jump, axes, std::vector<double>(D, 1), sizeof(T) / sizeof(double));
}

/// The number of cells whose mark is not that of their indicators.
template <int D>
double wrongMarks() {
  test::Runner run(test::unitBox<D>(D == 3 ? 7 : 19));
  std::vector<BoundCriterion> criteria{{{}, &anyNumber, true}, {{}, &anyVector<D>, true}};
  for (BoundCriterion& one : criteria) one.criterion.refine = 0.16, one.criterion.coarsen = 0.08;
  tasks::TaskList list;
  list.perPatch("fill", fillAny<D>, computes(anyNumber), computes(anyVector<D>));
  list.add(markTask(criteria));
  const auto compare = [](const Patch& patch, CellView<const double> numbers, CellView<const Vec<D>> vectors,
                          CellView<const int> marks, Sum& sum) {
    forEach<D>(patch.cells(), [&](const Index<D>& cell) {
      const double most = std::max(jumpAt<D>(patch.level(), numbers, cell), jumpAt<D>(patch.level(), vectors, cell));
      sum.add(marks[cell] != (most > 0.16 ? 2 : most > 0.08 ? 1 : 0));
    });
  };
  list.perPatch("compare", compare, requiresNew(anyNumber, 1), requiresNew(anyVector<D>, 1),
                requiresNew(tasks::refinementMark), computes(wrong));
  tasks::TaskGraph graph = run.compile(list, {"wrong"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0);
}

std::vector<int> levelsOfLeaves(const grid::BlockTree& tree) {
  std::vector<int> levels;
  for (const grid::BlockId& leaf : tree.leaves()) levels.push_back(leaf.level);
  return levels;
}

}  // namespace

TEST(Indicator, OfAJumpIsHalfTheDifferenceOverTheLeastValue) {
  EXPECT_DOUBLE_EQ(inRow(Indicator::jump, 1, 2, 4), 1.5);
  EXPECT_DOUBLE_EQ(inRow(Indicator::jump, 4, 2, 1), 1.5);
  EXPECT_EQ(inRow(Indicator::jump, 3, 3, 3), 0);
  EXPECT_EQ(inRow(Indicator::jump, 0, 0, 0), 0);
  EXPECT_EQ(inRow(Indicator::jump, 0, 1, 1), std::numeric_limits<double>::infinity());
}

TEST(Indicator, OfAVectorsJumpIsThatOfTheVector) {
  const double a[] = {1, 0}, b[] = {0, 0}, c[] = {-2, 4};
  EXPECT_DOUBLE_EQ(of(Indicator::jump, {{a, b, c}}, {0.5}, 2), 2.5);
}

TEST(Indicator, OfASecondDerivativeIsZeroForALineAndNearlyOneForAStep) {
  EXPECT_EQ(inRow(Indicator::secondDerivative, 1, 2, 3), 0);
  EXPECT_DOUBLE_EQ(inRow(Indicator::secondDerivative, 0, 0, 1), 1 / 1.01);
  EXPECT_NEAR(inRow(Indicator::secondDerivative, 1, 1.0001, 1), 0.0002 / 0.0402, 1e-5);  // ripples do not count
}

TEST(Indicator, OfAGradientIsItsMagnitude) {
  const double a = 1, b = 2, c = 4, d = 6;
  EXPECT_DOUBLE_EQ(of(Indicator::gradient, {{&a, &b, &c}, {&a, &b, &d}}, {0.5, 1}, 1), std::hypot(3, 2.5));
}

TEST(Indicator, BesideASideOfTheGridTakesTheCellsOwnValue) {
  const double b = 2, c = 4;
  EXPECT_DOUBLE_EQ(of(Indicator::jump, {{nullptr, &b, &c}}, {0.5}, 1), 0.5);
  EXPECT_DOUBLE_EQ(of(Indicator::above, {{nullptr, &b, &c}}, {0.5}, 1), 2);
}

TEST(Marks, OfRowsAreThoseOfTheIndicatorsOfTheirCells) {
  EXPECT_EQ(wrongMarks<1>(), 0);
  EXPECT_EQ(wrongMarks<2>(), 0);
  EXPECT_EQ(wrongMarks<3>(), 0);
}

TEST(MarkedBlocks, AreThoseThatSignalsCanReachUntilTheNextLook) {
  const grid::Grid grid(row());
  MarkedBlocks near(grid, 1, 1);  // one cell that signals cross, and one more
  near.add(grid.level(0), {{13, 0, 0}}, 2);
  EXPECT_EQ(levelsOfLeaves(near.tree()), (std::vector<int>{0, 1, 1, 0, 0}));
  MarkedBlocks far(grid, 8, 1);  // 8 cells of the finest level are 2 of the coarsest
  far.add(grid.level(0), {{13, 0, 0}}, 2);
  EXPECT_EQ(levelsOfLeaves(far.tree()), (std::vector<int>{0, 1, 1, 1, 1, 0}));
}

TEST(MarkedBlocks, GoAroundAPeriodicSide) {
  const grid::Grid grid(row(true));
  MarkedBlocks marked(grid, 1, 1);
  marked.add(grid.level(0), {{0, 0, 0}}, 2);
  EXPECT_EQ(levelsOfLeaves(marked.tree()), (std::vector<int>{1, 1, 0, 0, 1, 1}));
}

TEST(MarkedBlocks, GoAroundOnceHoweverLongTheInterval) {
  for (const bool isPeriodic : {false, true}) {
    const grid::Grid grid(row(isPeriodic));
    MarkedBlocks marked(grid, 2147483647, 2147483647);
    marked.add(grid.level(0), {{0, 0, 0}}, 2);
    EXPECT_EQ(levelsOfLeaves(marked.tree()), std::vector<int>(8, 1));
  }
}

TEST(MarkedBlocks, StayWhereTheyAreMarkedAndBecomeCoarserOneLevelAtATime) {
  grid::Grid grid(row());
  grid.refine(grid.cut(grid.tree().regridded({{0, {{1, 0, 0}}}, {1, {{2, 0, 0}}}}, {})));
  EXPECT_EQ(levelsOfLeaves(grid.tree()), (std::vector<int>{1, 1, 2, 2, 1, 0, 0}));  // the first for 2:1
  const MarkedBlocks nothing(grid, 1, 1);
  EXPECT_EQ(levelsOfLeaves(nothing.tree()), (std::vector<int>{0, 1, 1, 0, 0}));
  MarkedBlocks kept(grid, 1, 1);
  kept.add(grid.level(2), {{36, 0, 0}}, 1);
  EXPECT_EQ(kept.tree(), grid.tree());
}

namespace {

/// Returns the levels of the leaves after one cell is marked, and checks that none is more than one level finer.
std::vector<int> refinedOnce(const grid::Grid& grid, int interval, int level, int cell) {
  MarkedBlocks marked(grid, interval, 1);
  marked.add(grid.level(level), {{cell, 0, 0}}, 2);
  const grid::BlockTree tree = marked.tree();
  for (const grid::BlockId& leaf : tree.leaves()) EXPECT_LE(leaf.level, grid.tree().levelAt(leaf) + 1);
  return levelsOfLeaves(tree);
}

}  // namespace

TEST(MarkedBlocks, NeverMakeACellTwoLevelsFinerAtOnce) {
  grid::Grid grid(row());
  grid.refine(grid.cut(grid.tree().regridded({{0, {{1, 0, 0}}}}, {})));
  EXPECT_EQ(refinedOnce(grid, 8, 1, 30), (std::vector<int>{0, 1, 2, 2, 1, 1, 0}));  // the coarse block behind
}

TEST(MarkedBlocks, NeverMakeACellTwoLevelsFinerAtOnceHoweverFarSignalsReach) {
  grid::Domain domain = row();
  domain.refinement.levels = 4;
  grid::Grid grid(domain);
  grid.refine(grid.cut(grid.tree().regridded({{0, {{1, 0, 0}}}, {1, {{3, 0, 0}}}}, {})));
  EXPECT_EQ(levelsOfLeaves(grid.tree()), (std::vector<int>{0, 1, 2, 2, 1, 1, 0}));
  // The cell 17 cells before the first one of level 2 belongs to level 0, on the other side of a block of level 1.
  EXPECT_EQ(refinedOnce(grid, 32, 2, 48), (std::vector<int>{1, 1, 2, 2, 3, 3, 3, 3, 2, 2, 1, 0}));
}

namespace {

/// A grid of 4 x 3 x 2 blocks of 8 cells along its axes, up to 3 levels, with random refinement.
std::unique_ptr<grid::Grid> refinedByChance(int dimension, bool isPeriodic, std::mt19937& random) {
  grid::Domain domain;
  const std::array<int, 3> cells{32, 24, 16};
  for (int d = 0; d < 3; ++d) {
    domain.upper[d] = d < dimension ? 1 : 0;
    domain.resolution[d] = d < dimension ? cells[static_cast<std::size_t>(d)] : 1;
    domain.periodic[d] = d < dimension && isPeriodic;
  }
  domain.refinement.levels = 3;
  auto grid = std::make_unique<grid::Grid>(domain);
  for (int level = 0; level < 2; ++level) {
    MarkedBlocks marked(*grid, 1, 0);
    for (const grid::Patch& patch : grid->patches())
      if (random() % 2 == 0) marked.add(patch.level(), patch.cells().lower, 2);
    grid->refine(grid->cut(marked.tree()));
  }
  return grid;
}

}  // namespace

TEST(MarkedBlocks, OfPatchesAreThoseOfTheirCells) {
  std::mt19937 random(3);
  int changed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto grid = refinedByChance(1 + trial % 3, trial % 2 == 0, random);
    const std::array<int, 3> intervals{1, 8, 40};
    const int interval = intervals[static_cast<std::size_t>(trial / 6) % 3];
    MarkedBlocks byPatch(*grid, interval, 1), byCell(*grid, interval, 1);
    for (const grid::Patch& patch : grid->patches()) {
      const grid::Box stored = patch.cells().grown(1, grid->dimension());
      std::vector<int> marks(stored.size(), 2);  // those beyond the patch count for other patches
      grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
        const int mark = random() % 50 == 0 ? 1 + static_cast<int>(random() % 2) : 0;
        marks[stored.offset(cell)] = mark;
        byCell.add(patch.level(), cell, mark);
      });
      byPatch.add(patch, marks.data(), stored);
    }
    EXPECT_EQ(byPatch.tree(), byCell.tree()) << trial;
    changed += byPatch.tree() == MarkedBlocks(*grid, interval, 1).tree() ? 0 : 1;
  }
  EXPECT_GT(changed, 30);  // in one dimension few cells are marked
}

namespace {

struct Gas {
  std::string name;
};
const std::vector<Gas> gas{{"gas"}};
constexpr CellLabel<double> heatOfGas{"c.heatOfGas", "J", "heat of a gas in a cell"};

class CoolingGas : public test::Cooling {
 public:
  void scheduleInitialize(TaskList& tasks) const override {
    Cooling::scheduleInitialize(tasks);
    tasks.perMaterial(
        "warm", [](const Patch&, const Gas&, CellView<double>) {}, gas, computes(heatOfGas));
  }
  void scheduleTimeAdvance(TaskList& tasks) const override {
    Cooling::scheduleTimeAdvance(tasks);
    tasks.perMaterial(
        "cool", [](const Patch&, const Gas&, CellView<const double>, CellView<double>) {}, gas, requiresOld(heatOfGas),
        computes(heatOfGas));
  }
};

}  // namespace

TEST(Regridding, HasGhostsOfAllCellsThatOutliveAStep) {
  const grid::Grid grid(row());
  Phases phases(CoolingGas{}, {});
  data::VariableTable table;
  RegridSettings regrid;
  regrid.adaptive = true;

  phases.compile({}, {{std::string(heatOfGas.name), "", {}, {}}}, grid, table, regrid);

  EXPECT_EQ(table.ghost(table.find("c.heat", -1)), 1);
  EXPECT_EQ(table.ghost(table.find("c.heatOfGas", 0)), 1);
}

namespace {

/// Cooling cells that mark one on the left for refinement, and fill new cells with 7 J.
class MarkingItself : public test::Cooling {
 public:
  void scheduleErrorEstimate(TaskList& tasks) const override {
    tasks.perPatch(
        "mark",
        [](const Patch& patch, CellView<const double> warm, Marks marks) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) {
            if (patch.level().number() == 0 && cell[0] == 3 && warm[cell] < 1) marks.refine(cell);
          });
        },
        requiresOld(test::heat, 1), tasks::marks());
  }
  void scheduleRefine(TaskList& tasks) const override {
    tasks.perPatch(
        "fill",
        [](const Patch&, const std::vector<Box>& cells, CellView<double> warm) {
          for (const Box& box : cells) forEach<1>(box, [&](const Index<1>& cell) { warm[cell] += 6.5; });
        },
        newCells(), modifies(test::heat));
  }
};

/// Returns the heat of all cells in the order of the curve.
std::vector<double> heatOf(RunState& run) {
  std::vector<double> all;
  for (const grid::Patch& patch : run.problem.grid->patches()) {
    const data::Variable warm = run.warehouse.variable(data::Generation::old, run.table.find("c.heat", -1), patch.id());
    grid::forEach<3>(patch.cells(), [&](const Index3& cell) {
      all.push_back(reinterpret_cast<const double*>(warm.values)[warm.stored.offset(cell)]);
    });
  }
  return all;
}

}  // namespace

TEST(Regridding, RefinesWhereAComponentMarksAndFillsNewCellsAsItSays) {
  Problem problem = test::cooling();
  problem.grid = std::make_unique<grid::Grid>(row());
  problem.component = std::make_unique<MarkingItself>();
  problem.regrid.adaptive = true;
  problem.regrid.interval = 1;
  problem.regrid.dilation = 0;
  test::CoolingRun run(std::move(problem));
  Regridder regridder(run);
  run.initialize();
  EXPECT_FALSE(regridder.refinedStart());  // all cells are warm

  run.step();
  regridder.regridIfDue();

  EXPECT_EQ(levelsOfLeaves(run.problem.grid->tree()), (std::vector<int>{1, 1, 0, 0, 0}));
  std::vector<double> expected(40, 0.5);
  std::fill_n(expected.begin(), 16, 7);
  EXPECT_EQ(heatOf(run), expected);
}

namespace {

constexpr NodeLabel<double> corner{"g.corner", "1", "a number of each node"};

class WithNodes : public test::Cooling {
 public:
  void scheduleDiagnostics(TaskList& tasks) const override {
    tasks.perPatch(
        "number", [](const Patch&, NodeView<double> numbers) { numbers.fill(1); }, computes(corner));
  }
};

/// An analysis that looks at nodes in a window.
class NodesOfAWindow : public Analysis {
 public:
  void schedule(tasks::TaskList&) const override {}
  void setTime(double, double) override {}
  std::vector<SaveRequest> samples() const override { return {{"g.corner", "", {"a.ups", 3, 4}, {}}}; }
  std::vector<collect::Window> windows() const override { return {{}}; }
};

}  // namespace

TEST(Levels, ShowNoNodesInPartsOfTheGrid) {
  std::vector<std::unique_ptr<Analysis>> analyses;
  analyses.push_back(std::make_unique<NodesOfAWindow>());
  const grid::Grid one(test::domain({{8, 1, 1}})), several(row());
  for (const grid::Grid* grid : {&one, &several}) {
    Phases phases(WithNodes{}, analyses);
    data::VariableTable table;
    std::string problem;
    try {
      phases.compile(analyses, {}, *grid, table);
    } catch (const InputError& error) {
      problem = error.problems().front().sentence;
    }
    EXPECT_EQ(problem, grid == &one ? ""
                                    : "'g.corner' is a node variable; on several levels only cell and particle "
                                      "variables are saved");
  }
}

TEST(MarkedBlocks, KeepRegionsOfTheScene) {
  grid::Domain domain = row();
  domain.refinement.regions.push_back({1, Vec3(0.3, 0, 0), Vec3(0.4, 0, 0)});
  const grid::Grid grid(domain);
  EXPECT_EQ(levelsOfLeaves(MarkedBlocks(grid, 8, 1).tree()), (std::vector<int>{0, 1, 1, 0, 0}));
}

}  // namespace tushar::simulation
