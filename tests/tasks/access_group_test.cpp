#include <gtest/gtest.h>

#include "core/core.hpp"
#include "tests/support/run.hpp"

// Accesses by name, and accesses and outputs that only some scenes have.

namespace tushar::tasks {

namespace {

constexpr CellLabel<double> first{"c.first", "1", "a value"}, second{"c.second", "1", "another"};
constexpr CellLabel<double> sum{"c.sum", "1", "of both"}, product{"c.product", "1", "of both, where it is read"};
constexpr data::ReductionLabel<Sum> total{"total", "1", "sum over all cells"};
constexpr int cells = 8;

struct Material {
  std::string name;
  double value;
};
const std::vector<Material> two{{"steel", 1}, {"air", 10}};

struct Factors {
  CellView<const double> first;
  std::optional<CellView<const double>> second;

  static Factors from(auto& take, bool hasSecond) {
    return {.first = take(requiresNew(tasks::first)), .second = take(when(hasSecond, requiresNew(tasks::second)))};
  }
};
struct Sums {
  Factors factors;
  CellView<double> sum;
  std::optional<CellView<double>> product;

  static Sums from(auto& take, bool hasSecond) {
    return {.factors = Factors::from(take, hasSecond),
            .sum = take(computes(tasks::sum)),
            .product = take(offers(tasks::product))};
  }
};

void fill(const Patch&, const Material& material, CellView<double> a, CellView<double> b) {
  a.fill(material.value);
  b.fill(3);
}
void add(const Patch& patch, const Material&, int by, const Sums& s) {
  forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    const double b = s.factors.second ? (*s.factors.second)[cell] : 0;
    s.sum[cell] = s.factors.first[cell] + b + by;
    if (s.product) (*s.product)[cell] = s.factors.first[cell] * b;
  });
}

/// Returns the task list of one step, with or without the second factor.
TaskList listOf(bool hasSecond) {
  TaskList list;
  list.perMaterial("fill", fill, two, computes(first), computes(second));
  list.perMaterial("add", add, two, with(100), all<Sums>(hasSecond));
  return list;
}

/// The value of `label` of a material in the first cell, after a step of a scene that requests only this variable.
double valueAfter(bool hasSecond, const CellLabel<double>& label, int material) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  const TaskList list = listOf(hasSecond);
  TaskGraph graph = run.compile(list, {std::string(label.name)});
  run.step(graph);
  const data::Variable held =
      run.warehouse.variable(data::Generation::old, run.table.find(std::string(label.name), material), 0);
  return reinterpret_cast<const double*>(held.values)[held.stored.offset({})];
}

double totalOf(const TaskList& list, test::Runner& run) {
  TaskGraph graph = run.compile(list, {"total"});
  run.step(graph);
  return run.warehouse.reductionValues(run.table.find("total", -1)).at(0);
}

}  // namespace

TEST(AccessGroup, GivesEachMemberItsView) {
  EXPECT_EQ(valueAfter(true, sum, 0), 1 + 3 + 100);
  EXPECT_EQ(valueAfter(true, sum, 1), 10 + 3 + 100);
}

TEST(AccessGroup, LeavesOutWhatASceneDoesNotHave) { EXPECT_EQ(valueAfter(false, sum, 1), 10 + 100); }

TEST(AccessGroup, DeclaresItsAccessesInTheOrderOfItsMembers) {
  std::vector<std::string> names;
  const TaskList list = listOf(true);
  for (const Access& access : list.tasks().back().accesses) names.emplace_back(access.label->name);

  EXPECT_EQ(names, (std::vector<std::string>{"c.first", "c.second", "c.sum", "c.product"}));
}

TEST(AccessGroup, BecomesOneForEachMaterialWhereATaskSeesAll) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  TaskList list = listOf(true);
  const auto addUp = [](const Patch& patch, const std::vector<Material>& materials, const std::vector<Factors>& of,
                        Sum& result) {
    for (std::size_t m = 0; m < materials.size(); ++m)
      forEach<1>(patch.cells(), [&](const Index<1>& cell) { result.add(of[m].first[cell] * (*of[m].second)[cell]); });
  };
  list.acrossMaterials("addUp", addUp, two, all<Factors>(true), computes(total));

  EXPECT_EQ(totalOf(list, run), cells * (1 * 3 + 10 * 3));
}

TEST(AccessGroup, BecomesOneForEachPatchAndMaterialWhereATaskSeesTheRank) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  TaskList list = listOf(true);
  const auto addUp = [](const RankPatches& patches, const std::vector<Material>& materials,
                        const std::vector<std::vector<Factors>>& of, Sum& result) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (std::size_t m = 0; m < materials.size(); ++m)
        forEach<1>(patches[p]->cells(), [&](const Index<1>& cell) { result.add(of[p][m].first[cell]); });
  };
  list.perRankAcrossMaterials("addUp", addUp, two, all<Factors>(true), computes(total));

  EXPECT_EQ(totalOf(list, run), cells * (1 + 10));
}

/// A view without a material among views with one.
struct Common {
  CellView<double> mean;

  static Common from(auto& take) { return {.mean = take(computes(sum))}; }
};

TEST(WithoutMaterial, IsOneViewAmongThoseOfMaterialsWithTheGhostsOfItsNeighbours) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{4, 1, 1}}));
  TaskList list;
  list.perMaterial("fill", fill, two, computes(first), computes(second));
  const auto mean = [](const Patch& patch, const std::vector<Material>& materials,
                       const std::vector<CellView<const double>>& of, const Common& common) {
    forEach<1>(patch.cells(), [&](const Index<1>& cell) {
      common.mean[cell] = patch.id();
      for (std::size_t m = 0; m < materials.size(); ++m) common.mean[cell] += 100 * of[m][cell];
    });
  };
  list.acrossMaterials("mean", mean, two, requiresNew(first), withoutMaterial(all<Common>()));
  const auto addUp = [](const Patch& patch, const std::vector<Material>&, CellView<const double> common, Sum& result) {
    const Box around = patch.level().clipCells(patch.cells().grown(1, 1));
    forEach<1>(around, [&](const Index<1>& cell) { result.add(common[cell]); });
  };
  list.acrossMaterials("addUp", addUp, two, withoutMaterial(requiresNew(sum, 1)), computes(total));

  const double patches = 2 * (0 + 1 + 2 + 3), ghosts = 1 + 0 + 2 + 1 + 3 + 2;
  EXPECT_EQ(totalOf(list, run), patches + ghosts + (cells + 6) * 1100);
}

TEST(WithoutMaterial, IsReadByEachMaterial) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  list.perPatch(
      "fill", [](const Patch&, CellView<double> field) { field.fill(2); }, computes(sum));
  const auto add = [](const Patch& patch, const Material& material, CellView<const double> common, Sum& result) {
    forEach<1>(patch.cells(), [&](const Index<1>& cell) { result.add(material.value * common[cell]); });
  };
  list.perMaterial("add", add, two, withoutMaterial(requiresNew(sum)), computes(total));

  EXPECT_EQ(totalOf(list, run), cells * 2 * (1 + 10));
}

TEST(When, SeesEveryMaterial) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  TaskList list = listOf(true);
  const auto addUp = [](const Patch& patch, const std::vector<Material>&,
                        const std::vector<std::optional<CellView<const double>>>& of,
                        const std::vector<std::optional<CellView<const double>>>& absent, Sum& result) {
    ASSERT_EQ(of.size(), 2U);
    ASSERT_EQ(absent.size(), 2U);
    for (std::size_t m = 0; m < of.size(); ++m) {
      EXPECT_FALSE(absent[m]);
      forEach<1>(patch.cells(), [&](const Index<1>& cell) { result.add((*of[m])[cell]); });
    }
  };
  list.acrossMaterials("addUp", addUp, two, when(true, requiresNew(first)), when(false, requiresNew(second)),
                       computes(total));

  EXPECT_EQ(totalOf(list, run), cells * (1 + 10));
}

TEST(When, SeesEveryPatchOfARank) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{4, 1, 1}}));
  TaskList list;
  list.perPatch(
      "fill", [](const Patch&, CellView<double> field) { field.fill(2); }, computes(first));
  const auto addUp = [](const RankPatches& patches, const std::vector<std::optional<CellView<const double>>>& of,
                        Sum& result) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      forEach<1>(patches[p]->cells(), [&](const Index<1>& cell) { result.add((*of[p])[cell]); });
  };
  list.perRank("addUp", addUp, when(true, requiresNew(first)), computes(total));

  EXPECT_EQ(totalOf(list, run), cells * 2);
}

TEST(Offers, AreComputedWhereSomethingReadsThem) { EXPECT_EQ(valueAfter(true, product, 1), 30); }

TEST(Offers, AreNotAllocatedWhereNothingReadsThem) {
  test::Runner run(test::domain({{cells, 1, 1}}, {{2, 1, 1}}));
  const TaskList list = listOf(true);
  TaskGraph graph = run.compile(list, {"c.sum"});
  run.step(graph);

  EXPECT_EQ(run.table.find("c.product", 0), -1);
  EXPECT_EQ(graph.tasks().back().task.accesses.back().kind, AccessKind::leftOut);
}

TEST(Offers, KeepTheirTask) {
  const TaskList list = listOf(true);

  EXPECT_EQ(prune(list.tasks(), {"c.product"}, false).kept.size(), 2U);
}

}  // namespace tushar::tasks
