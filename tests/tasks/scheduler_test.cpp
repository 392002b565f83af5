#include "core/tasks/scheduler.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/base/error.hpp"
#include "tests/support/run.hpp"

namespace tushar::tasks {

namespace {

using data::CellLabel;
using data::CellView;
using data::NodeLabel;
using data::NodeView;
using data::Sum;
using grid::forEach;
using grid::Patch;

constexpr CellLabel<double> number{"c.number", "1", "number of the cell"}, doubled{"c.doubled", "1", "twice that"};
constexpr NodeLabel<double> nodeNumber{"g.number", "1", "number of the node"};
constexpr data::ReductionLabel<Sum> wrong{"wrong", "1", "ghosts that differ from what their owner has"};

double numberOf(const Index3& at) { return 1 + at[0] + 1000 * at[1] + 1000000 * at[2]; }

template <int D>
Index3 wide(const Index<D>& at) {
  Index3 index;
  for (int d = 0; d < D; ++d) index[d] = at[d];
  return index;
}

template <int D>
void fillCells(const Patch& patch, CellView<double> field) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { field[cell] = numberOf(wide(cell)); });
}
template <int D>
void fillNodes(const Patch& patch, NodeView<double> field) {
  forEach<D>(patch.nodes(), [&](const Index<D>& node) { field[node] = numberOf(wide(node)); });
}
template <int D>
void checkGhosts(const Patch&, CellView<const double> cells, NodeView<const double> nodes, Sum& differing) {
  forEach<D>(cells.box(), [&](const Index<D>& at) { differing.add(cells[at] != numberOf(wide(at))); });
  forEach<D>(nodes.box(), [&](const Index<D>& at) { differing.add(nodes[at] != numberOf(wide(at))); });
}

template <int D>
void fillOwnNodes(const Patch&, NodeView<double> field) {
  forEach<D>(field.box(), [&](const Index<D>& node) { field[node] = numberOf(wide(node)); });
}

/// Checks the nodes that each patch owns and writes, and their number.
template <int D>
std::pair<double, std::size_t> differingOwnNodes(const Index3& resolution, const Index3& patches, int nodesBeyond = 0) {
  grid::Domain domain = test::domain(resolution, patches);
  domain.nodesBeyond = nodesBeyond;
  test::Runner run(domain, 2);
  TaskList list;
  list.perPatch("fillCells", fillCells<D>, computes(number));
  list.perPatch("fillOwnNodes", fillOwnNodes<D>, computesOwn(nodeNumber));
  list.perPatch("check", checkGhosts<D>, requiresNew(number), requiresNew(nodeNumber, 1), computes(wrong));
  TaskGraph graph = run.compile(list, {"wrong"});
  run.step(graph);
  std::size_t written = 0;
  for (const Patch& patch : run.grid.patches()) written += run.grid.ownNodes(patch.id()).size();
  return {run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0), written};
}

template <int D>
double differingGhosts(const Index3& resolution, const Index3& patches, int width, int threads = 1) {
  test::Runner run(test::domain(resolution, patches), threads);
  TaskList list;
  list.perPatch("fillCells", fillCells<D>, computes(number));
  list.perPatch("fillNodes", fillNodes<D>, computes(nodeNumber));
  list.perPatch("check", checkGhosts<D>, requiresNew(number, width), requiresNew(nodeNumber, width), computes(wrong));
  TaskGraph graph = run.compile(list, {"wrong"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("wrong", -1)).at(0);
}

void twice(const Patch& patch, CellView<const double> from, CellView<double> to) {
  forEach<1>(patch.cells(), [&](const Index<1>& cell) { to[cell] = 2 * from[cell]; });
}

}  // namespace

TEST(Scheduler, FillsGhostCellsAndNodesFromTheirOwnersCornersIncluded) {
  for (const int width : {1, 2, 3}) {
    for (const int patches : {1, 2, 7, 20}) EXPECT_EQ(differingGhosts<1>({{20, 1, 1}}, {{patches, 1, 1}}, width), 0);
    EXPECT_EQ(differingGhosts<2>({{9, 7, 1}}, {{3, 2, 1}}, width), 0);
    EXPECT_EQ(differingGhosts<2>({{6, 5, 1}}, {{6, 5, 1}}, width), 0);
    EXPECT_EQ(differingGhosts<3>({{5, 4, 6}}, {{3, 2, 2}}, width), 0);
    EXPECT_EQ(differingGhosts<3>({{3, 3, 3}}, {{3, 3, 3}}, width), 0);
    EXPECT_EQ(differingGhosts<2>({{9, 7, 1}}, {{3, 2, 1}}, width, 4), 0);
  }
}

TEST(Scheduler, SharesTheNodesThatOnePatchOfARankWritesForAll) {
  EXPECT_EQ(differingOwnNodes<1>({{20, 1, 1}}, {{7, 1, 1}}), std::pair(0.0, std::size_t{21}));
  EXPECT_EQ(differingOwnNodes<2>({{9, 7, 1}}, {{3, 2, 1}}), std::pair(0.0, std::size_t{10 * 8}));
  EXPECT_EQ(differingOwnNodes<3>({{5, 4, 6}}, {{3, 2, 2}}), std::pair(0.0, std::size_t{6 * 5 * 7}));
  EXPECT_EQ(differingOwnNodes<3>({{9, 8, 6}}, {{3, 2, 2}}, 1), std::pair(0.0, std::size_t{12 * 11 * 9}));
  EXPECT_EQ(differingOwnNodes<2>({{3, 3, 1}}, {{3, 3, 1}}, 1).first, 0)
      << "patches as thin as the layers beyond the grid";
}

TEST(Scheduler, SumsToTheSameBitsOnAnyThreads) {
  const auto total = [](int threads) {
    test::Runner run(test::domain({{60, 1, 1}}, {{20, 1, 1}}), threads);
    TaskList list;
    list.perPatch(
        "add",
        [](const Patch& patch, Sum& sum) {
          for (int k = 0; k < 100; ++k) sum.add(std::exp(patch.id() * 1.7 + k) * (k % 2 ? -1 : 1));
        },
        computes(wrong));
    TaskGraph graph = run.compile(list, {"wrong"});
    run.step(graph);
    const auto bytes = run.warehouse.reductionBytes(run.table.find("wrong", -1));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
  };

  const auto onOne = total(1);
  for (int repeat = 0; repeat < 5; ++repeat) EXPECT_EQ(total(4), onOne);
}

TEST(Scheduler, TellsTheErrorOfTheFirstCellOrElsePatchOnAnyThreads) {
  const auto failure = [](int threads, bool withCells) {
    test::Runner run(test::domain({{60, 1, 1}}, {{20, 1, 1}}), threads);
    TaskList list;
    list.perPatch(
        "fail",
        [withCells](const Patch& patch, CellView<double>) {
          if (patch.id() >= 5)
            throw NumericalError("x", "", "x", withCells ? 100u - static_cast<unsigned>(patch.id()) : 0u);
        },
        computes(number));
    TaskGraph graph = run.compile(list, {"c.number"});
    try {
      run.step(graph);
    } catch (const NumericalError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };

  for (const int threads : {1, 4}) {
    EXPECT_EQ(failure(threads, false), "x (task fail, patch 5, step 7, time 0.5 s)");
    EXPECT_EQ(failure(threads, true), "x (task fail, patch 19, step 7, time 0.5 s)");
  }
}

TEST(Scheduler, HandsTheNewStateToTheNextStepAsOld) {
  test::Runner run(test::domain({{8, 1, 1}}, {{3, 1, 1}}));
  TaskList start, advance;
  start.perPatch("fill", fillCells<1>, computes(number));
  advance.perPatch("double", twice, requiresOld(number), computes(number));
  TaskGraph begin = run.compile(start, {"c.number"}), step = run.compile(advance, {"c.number"}, true);

  run.step(begin);
  run.step(step);
  run.step(step);

  const int last = run.grid.patches().back().id();
  const data::Variable held = run.warehouse.variable(data::Generation::old, run.table.find("c.number", -1), last);
  const auto* values = reinterpret_cast<const double*>(held.values);
  EXPECT_EQ(values[held.stored.offset({{7, 0, 0}})], 4 * numberOf({{7, 0, 0}}));
}

TEST(Scheduler, TellsTaskPatchStepAndTimeOfANumericalErrorAndKeepsTheOldState) {
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList start, advance;
  start.perPatch("fill", fillCells<1>, computes(number));
  advance.perPatch(
      "fail",
      [](const Patch& patch, CellView<const double>, CellView<double>) {
        if (patch.id() == 1) throw NumericalError("c.number became nan", "less");
      },
      requiresOld(number), computes(number));
  TaskGraph begin = run.compile(start, {"c.number"}), step = run.compile(advance, {"c.number"}, true);
  run.step(begin);

  try {
    run.step(step);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "c.number became nan (task fail, patch 1, step 7, time 0.5 s)");
    EXPECT_EQ(error.advice(), "less");
  }
  const data::Variable held = run.warehouse.variable(data::Generation::old, run.table.find("c.number", -1), 0);
  EXPECT_EQ(reinterpret_cast<const double*>(held.values)[0], numberOf({{0, 0, 0}}));
}

TEST(Scheduler, TurnsAnyOtherExceptionIntoATaskError) {
  test::Runner run(test::domain({{8, 1, 1}}));
  TaskList list;
  list.perPatch(
      "fail", [](const Patch&, CellView<double>) { throw std::out_of_range("no such thing"); }, computes(number));
  TaskGraph graph = run.compile(list, {"c.number"});

  try {
    run.step(graph);
    FAIL();
  } catch (const TaskError& error) {
    EXPECT_STREQ(error.what(), "no such thing (task fail, patch 0, step 7, time 0.5 s)");
  }
}

TEST(Scheduler, RefusesABodyThatLeavesWhatItDeclared) {
  if (!data::checked) GTEST_SKIP() << "views are checked in the dev preset only";
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  list.perPatch("fill", fillCells<1>, computes(number));
  list.perPatch(
      "reach",
      [](const Patch& patch, CellView<const double> field, CellView<double> to) {
        forEach<1>(patch.cells(), [&](const Index<1>& cell) { to[cell] = field[cell + Index<1>::unit(0)]; });
      },
      requiresNew(number), computes(doubled));
  TaskGraph graph = run.compile(list, {"c.doubled"});

  EXPECT_THROW(run.step(graph), TaskError);
}

TEST(Scheduler, NeverAllocatesWhatNobodyReads) {
  const auto allocations = [](const Names& wanted) {
    test::Runner run(test::domain({{8, 1, 1}}));
    TaskList list;
    list.perPatch("fill", fillCells<1>, computes(number));
    list.perPatch("double", twice, requiresNew(number), computes(doubled));
    TaskGraph graph = run.compile(list, wanted);
    run.step(graph);
    return run.warehouse.allocations();
  };

  EXPECT_EQ(allocations({"c.number"}), 1u);
  EXPECT_EQ(allocations({"c.doubled"}), 2u);
  EXPECT_EQ(allocations({}), 0u);
}

TEST(Scheduler, ValuesOnNewPatchesTakeTheMemoryOfThoseOnFormerOnes) {
  test::Runner run(test::domain({{4096, 1, 1}}));
  TaskList list;
  list.perPatch("fill", fillCells<1>, computes(number));
  list.perPatch("double", twice, requiresNew(number), computes(doubled));
  TaskGraph graph = run.compile(list, {"c.doubled", "c.number"});
  run.step(graph);
  const std::size_t before = run.warehouse.allocations();

  run.warehouse.startAnew(0);
  run.step(graph);

  EXPECT_GT(before, 0u);
  EXPECT_EQ(run.warehouse.allocations(), before);
}

TEST(Scheduler, UsesAsManyThreadsAsTheCellsAreWorthAlsoWhenTheseBecomeMore) {
  grid::Domain domain = test::domain({{32, 1, 1}});
  domain.refinement.levels = 2;
  domain.refinement.blocksPerPatch = Index3::filled(1);
  grid::Grid grid(domain);
  data::VariableTable table;
  data::Warehouse warehouse(grid, table);
  Scheduler given(warehouse, 4), asPay(warehouse, 4, 16);
  EXPECT_EQ(given.threads().count(), 4);
  EXPECT_EQ(asPay.threads().count(), 2);

  std::vector<grid::BlockId> all;
  for (int block = 0; block < 4; ++block) all.push_back({0, {{block, 0, 0}}});
  grid.refine(grid.cut(grid.tree().regridded(all, {})));
  asPay.forgetLayout();

  EXPECT_EQ(asPay.threads().count(), 4);
}

TEST(Scheduler, GivesEachThreadPatchesThatTakeEqualTimes) {
  test::Runner run(test::domain({{8, 1, 1}}, {{4, 1, 1}}), 2);
  TaskList list;
  list.perPatch(
      "wait",
      [](const Patch& patch, CellView<double> field) {
        fillCells<1>(patch, field);
        if (patch.id() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      },
      computes(number));
  TaskGraph graph = run.compile(list, {"c.number"});
  EXPECT_TRUE(run.scheduler.threads().order().empty());
  for (int k = 0; k < 20; ++k) run.step(graph);

  std::vector<int> order = run.scheduler.threads().order();
  ASSERT_EQ(order.size(), 4u);
  EXPECT_EQ(std::min(order[0], order[1]) + std::min(order[2], order[3]), 0 + 1);  // one of the slow patches for each
  run.scheduler.forgetLayout();
  EXPECT_TRUE(run.scheduler.threads().order().empty());
}

}  // namespace tushar::tasks
