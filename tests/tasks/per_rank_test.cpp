#include <gtest/gtest.h>

#include "core/core.hpp"
#include "core/tasks/place.hpp"
#include "tests/support/run.hpp"

// Tasks that see all patches of a rank at once.

namespace tushar::tasks {

namespace {

constexpr CellLabel<double> number{"c.number", "1", "number of the cell"},
    running{"c.running", "1", "sum up to the cell"};
constexpr CellLabel<double> ofMaterial{"c.ofMaterial", "1", "a value of each material"};
constexpr data::ReductionLabel<Sum> total{"total", "1", "sum"}, calls{"calls", "1", "how often the body ran"};

struct Material {
  std::string name;
  double value;
};
const std::vector<Material> two{{"steel", 1}, {"air", 10}};

void fill(const Patch& patch, CellView<double> field) {
  forEach<1>(patch.cells(), [&](const Index<1>& cell) { field[cell] = 1 + cell[0]; });
}

/// An operation that needs all patches of a rank: each cell gets the sum of all cells up to it.
void accumulate(const RankPatches& patches, const std::vector<CellView<const double>>& from,
                const std::vector<CellView<double>>& to, Sum& ran) {
  double sum = 0;
  for (std::size_t p = 0; p < patches.size(); ++p)
    forEach<1>(patches[p]->cells(), [&](const Index<1>& cell) { to[p][cell] = sum += from[p][cell]; });
  ran.add(1);
}

void fillMaterial(const Patch& patch, const Material& material, CellView<double> field) {
  forEach<1>(patch.cells(), [&](const Index<1>& cell) { field[cell] = material.value; });
}
void sumMaterials(const RankPatches& patches, const std::vector<Material>& materials,
                  const std::vector<std::vector<CellView<const double>>>& field, Sum& sum) {
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (std::size_t m = 0; m < materials.size(); ++m)
      forEach<1>(patches[p]->cells(), [&](const Index<1>& cell) { sum.add(field[p][m][cell] * materials[m].value); });
}

}  // namespace

TEST(PerRank, RunsOnceAndSeesEveryPatchInOrder) {
  test::Runner run(test::domain({{8, 1, 1}}, {{3, 1, 1}}));
  TaskList list;
  list.perPatch("fill", fill, computes(number));
  list.perRank("accumulate", accumulate, requiresNew(number), computes(running), computes(calls));
  TaskGraph graph = run.compile(list, {"c.running", "calls"});

  run.step(graph);

  const int last = run.grid.patches().back().id();
  const data::Variable held = run.warehouse.variable(data::Generation::old, run.table.find("c.running", -1), last);
  EXPECT_EQ(reinterpret_cast<const double*>(held.values)[held.stored.offset({{7, 0, 0}})], 36);
  EXPECT_EQ(run.warehouse.reductionValues(run.table.find("calls", -1)).at(0), 1);
}

TEST(PerRank, SeesGhostsOfEachPatchFilled) {
  test::Runner run(test::domain({{8, 1, 1}}, {{4, 1, 1}}));
  TaskList list;
  list.perPatch("fill", fill, computes(number));
  const auto sumWithGhosts = [](const RankPatches& patches, const std::vector<CellView<const double>>& field,
                                Sum& sum) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      forEach<1>(field[p].box(), [&](const Index<1>& cell) { sum.add(field[p][cell]); });
  };
  list.perRank("sum", sumWithGhosts, requiresNew(number, 1), computes(total));
  TaskGraph graph = run.compile(list, {"total"});

  run.step(graph);

  // Of the cells 1…8 in patches of two, all but the first and the last are the ghost of one neighbour.
  EXPECT_EQ(run.warehouse.reductionValues(run.table.find("total", -1)).at(0), 36 + (2 + 3 + 4 + 5 + 6 + 7));
}

TEST(PerRank, SeesEveryMaterialOfEveryPatch) {
  test::Runner run(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  list.perMaterial("fill", fillMaterial, two, computes(ofMaterial));
  list.perRankAcrossMaterials("sum", sumMaterials, two, requiresNew(ofMaterial), computes(total));
  TaskGraph graph = run.compile(list, {"total"});

  run.step(graph);

  EXPECT_EQ(run.warehouse.reductionValues(run.table.find("total", -1)).at(0), 8 * (1 * 1 + 10 * 10));
}

TEST(PerRank, IsPlacedOnceAndNamedInErrorsWithoutAPatch) {
  test::Runner run(test::domain({{8, 1, 1}}, {{3, 1, 1}}));
  TaskList list;
  list.perRank(
      "solve",
      [](const RankPatches&, const std::vector<CellView<double>>&) {
        throw NumericalError("the solve failed", "a smaller step");
      },
      computes(number));
  TaskGraph graph = run.compile(list, {"c.number"});

  EXPECT_EQ(graph.placements(), (std::vector<Placement>{{0, -1, -1}}));
  try {
    run.step(graph);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "the solve failed (task solve, step 7, time 0.5 s)");
  }
}

TEST(PerRank, RefusesAValueThatBreaksItsBound) {
  constexpr CellLabel<double> positive{"c.positive", "1", "a value", data::Bound::positive};
  test::Runner run(test::domain({{4, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  const auto fillNegative = [](const RankPatches&, const std::vector<CellView<double>>& fields) {
    for (const CellView<double>& field : fields) field.fill(-1);
  };
  list.perRank("solve", fillNegative, computes(positive));
  TaskGraph graph = run.compile(list, {"c.positive"});

  EXPECT_THROW(run.step(graph), NumericalError);
}

}  // namespace tushar::tasks
