#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/tasks/task_list.hpp"
#include "tests/support/run.hpp"

// Materials with variables of their own, and tasks that read those of other materials: marks weigh the bodies around
// them, and add what they find to the bodies' nodes.

namespace tushar::tasks {

namespace {

using data::Generation;
using data::NodeLabel;
using data::NodeView;
using data::ParticleLabel;
using data::ParticleView;
using grid::Patch;

constexpr ParticleLabel<Vec<1>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mass{"p.mass", "kg", "mass"}, weight{"p.weight", "kg", "mass around a mark"};
constexpr NodeLabel<double> gathered{"g.mass", "kg", "mass"};
constexpr data::ReductionLabel<data::Sum> total{"total", "kg", "sum of the weights"};

struct Named {
  std::string name;
};
const std::vector<Named> bodies{{"body"}, {"other"}};
const std::vector<Named> marks{{"mark"}};
constexpr MaterialRange ofBodies{0, 2}, ofMarks{2, 3};

/// A particle in the middle of each cell.
void fill(const Patch& patch, const Named& material, ParticleMaker& maker, std::vector<Vec<1>>& at,
          std::vector<double>& masses) {
  grid::forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    maker.add(cell, cell[0]);
    at.push_back(patch.level().cellCentre<1>(cell));
    masses.push_back(material.name == "body" ? 1 + cell[0] : 100);
  });
}
/// A mark in each third cell.
void mark(const Patch& patch, const Named& material, ParticleMaker& maker, std::vector<Vec<1>>& at) {
  EXPECT_EQ(material.name, "mark");
  grid::forEach<1>(patch.cells(), [&](const Index<1>& cell) {
    if (cell[0] % 3 != 0) return;
    maker.add(cell, cell[0]);
    at.push_back(patch.level().cellCentre<1>(cell));
  });
}
void gather(const Patch&, const Named&, ParticleView<const Vec<1>> at, ParticleView<const double> masses,
            NodeView<double> sums) {
  sums.fill(0);
  at.forEachOccupied<1>(at.cells(), [&](const Index<1>& cell, const data::ParticleRange& range) {
    for (const int p : range)
      for (const Index<1>& node : {cell, cell + Index<1>::unit(0)})
        if (sums.box().contains(node)) sums[node] += masses[p];
  });
}
void weigh(const Patch& patch, const Named& material, const std::vector<NodeView<const double>>& sums,
           ParticleView<const Vec<1>> at, ParticleView<double> weights) {
  EXPECT_EQ(material.name, "mark");
  EXPECT_EQ(sums.size(), 2U);
  at.forEachOccupied<1>(patch.cells(), [&](const Index<1>& cell, const data::ParticleRange& range) {
    for (const int p : range) weights[p] = sums[0][cell] + sums[1][cell + Index<1>::unit(0)];
  });
}
/// Adds the weight of each mark to the second body's node to its left, which may belong to another patch.
void giveBack(const Patch&, const std::vector<Named>&, const std::vector<ParticleView<const double>>& weights,
              const std::vector<NodeView<double>>& sums) {
  ASSERT_EQ(weights.size(), 1U);
  weights[0].forEachOccupied<1>(weights[0].cells(), [&](const Index<1>& cell, const data::ParticleRange& range) {
    for (const int p : range)
      if (sums[1].box().contains(cell)) sums[1][cell] += 1000 * weights[0][p];
  });
}
void advance(const Patch&, const Named&, ParticleView<const Vec<1>> old, ParticleView<Vec<1>> at) {
  for (int p = 0; p < at.owned(); ++p) at[p] = old[p] + Vec<1>::Constant(1);
}
void addUp(const Patch&, const Named&, ParticleView<const Vec<1>> at, NodeView<const double> sums, data::Sum& sum) {
  at.forEachOccupied<1>(at.cells(), [&](const Index<1>& cell, const data::ParticleRange& range) {
    for (int k = 0; k < range.size(); ++k) sum.add(sums[cell]);
  });
}

struct Lists {
  TaskList start, step;

  Lists() {
    start.newParticles("mark", mark, following(bodies, marks), creates(x));
    start.newParticles("fill", fill, bodies, creates(x), creates(mass));
    step.perMaterial("gather", gather, bodies, requiresOld(x, 1), requiresOld(mass, 1), computes(gathered));
    step.perMaterial("weigh", weigh, following(bodies, marks), ofMaterials(ofBodies, requiresNew(gathered)),
                     requiresOld(x), computes(weight));
    step.acrossMaterials("give back", giveBack, bodies, ofMaterials(ofMarks, requiresNew(weight, 1)),
                         modifies(gathered));
    step.perMaterial("add up", addUp, bodies, requiresOld(x), requiresNew(gathered), computes(total));
    step.perMaterial("advance marks", advance, following(bodies, marks), requiresOld(x), computes(x));
    step.perMaterial("advance", advance, bodies, requiresOld(x), computes(x));
    step.relocate(x, following(bodies, marks));
  }
};

/// The totals of some steps, and the numbers of particles of each material at the end.
std::pair<std::vector<double>, std::vector<int>> runOn(const Index3& patches) {
  grid::Domain domain = test::domain({{12, 1, 1}}, patches);
  domain.upper[0] = 12;
  for (const int side : {0, 1}) domain.boundaries.face(0, side).clear();  // particles may leave
  test::Runner run(domain);
  const Lists lists;
  TaskGraph start = run.compile(lists.start, {"p.x", "p.mass", "p.particleID"});
  TaskGraph step = run.compile(lists.step, {"p.x", "p.mass", "total"}, true);
  run.step(start);
  std::pair<std::vector<double>, std::vector<int>> result;
  for (int k = 0; k < 4; ++k) {
    run.step(step);
    result.first.push_back(run.warehouse.reductionValues(run.table.find("total", -1)).at(0));
  }
  for (int m = 0; m < 3; ++m) {
    result.second.push_back(0);
    for (int patch = 0; patch < run.warehouse.patches(); ++patch)
      result.second.back() += run.warehouse.particles(Generation::old, m, patch).owned();
  }
  EXPECT_EQ(run.table.find("p.mass", 2), -1);
  EXPECT_EQ(run.table.find("p.weight", 0), -1);
  return result;
}

/// The masses of the bodies, which the list only carries, are no variables of the marks.
TEST(FollowingMaterials, CanBeMadeAnewDuringAStep) {
  grid::Domain domain = test::domain({{12, 1, 1}}, {{3, 1, 1}});
  domain.upper[0] = 12;
  for (const int side : {0, 1}) domain.boundaries.face(0, side).clear();
  test::Runner run(domain);
  TaskList step;
  step.perMaterial("advance marks", advance, following(bodies, marks), requiresOld(x), computes(x));
  step.perMaterial("advance", advance, bodies, requiresOld(x), computes(x));
  step.relocate(x, following(bodies, marks));
  step.newParticles("mark anew", mark, following(bodies, marks), creates(x));
  const Lists lists;
  TaskGraph start = run.compile(lists.start, {"p.x", "p.mass", "p.particleID"});
  TaskGraph graph = run.compile(step, {"p.x", "p.mass", "p.particleID"}, true);
  run.step(start);
  for (int k = 0; k < 3; ++k) run.step(graph);
  std::vector<int> counts(3);
  for (int m = 0; m < 3; ++m)
    for (int patch = 0; patch < run.warehouse.patches(); ++patch)
      counts[m] += run.warehouse.particles(Generation::old, m, patch).owned();
  EXPECT_EQ(counts, (std::vector<int>{9, 9, 4}));
}

}  // namespace

TEST(FollowingMaterials, haveTheirOwnVariablesAndActOnOthersOnAnyPatches) {
  const auto reference = runOn({{1, 1, 1}});
  EXPECT_EQ(reference.second, (std::vector<int>{8, 8, 3}));  // in four steps, the last cells and a mark leave
  for (const Index3& patches : {Index3{{2, 1, 1}}, Index3{{5, 1, 1}}}) {
    const auto other = runOn(patches);
    EXPECT_EQ(other.first, reference.first);
    EXPECT_EQ(other.second, reference.second);
  }
}

TEST(FollowingMaterials, mayComputeWhatOthersComputeForTheirMaterials) {
  TaskList list;
  list.perMaterial("one", advance, bodies, requiresOld(x), computes(x));
  list.perMaterial("two", advance, following(bodies, marks), requiresOld(x), computes(x));
  EXPECT_NO_THROW(validate(list.tasks(), {"p.x"}));
  list.perMaterial("three", advance, following(bodies, marks), requiresOld(x), computes(x));
  EXPECT_THROW(validate(list.tasks(), {"p.x"}), TaskError);
}

TEST(FollowingMaterials, areOnlyReadByTasksOfOthers) {
  TaskList list;
  list.acrossMaterials(
      "write", [](const Patch&, const std::vector<Named>&, const std::vector<ParticleView<Vec<1>>>&) {}, bodies,
      ofMaterials(ofMarks, computes(x)));
  try {
    validate(list.tasks(), {});
    FAIL();
  } catch (const TaskError& error) {
    EXPECT_NE(std::string(error.what()).find("may only read it"), std::string::npos);
  }
}

TEST(FollowingMaterials, standAloneInTheSchedule) {
  test::Runner run(test::domain({{12, 1, 1}}, {{1, 1, 1}}));
  std::ostringstream out;
  run.compile(Lists().start, {"p.x", "p.mass", "p.particleID"}).print(out);
  EXPECT_NE(out.str().find("mark [mark]"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("fill [body, other]"), std::string::npos) << out.str();
}

}  // namespace tushar::tasks
