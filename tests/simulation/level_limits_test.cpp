#include "core/simulation/level_limits.hpp"

#include <gtest/gtest.h>

#include "core/core.hpp"
#include "core/simulation/phases.hpp"
#include "tests/simulation/cooling.hpp"

namespace tushar::simulation {

namespace {

using tasks::Task;
using tasks::TaskList;

constexpr CellLabel<double> value{"c.value", "1", "a number in each cell"};
constexpr NodeLabel<double> corner{"g.corner", "1", "a number on each node"};

struct Gas {
  std::string name;
};
const std::vector<Gas> gases{{"gas"}};

void readCells(const Patch&, CellView<const double>) {}
void readNodes(const Patch&, NodeView<const double>) {}
void readNodesOfGas(const Patch&, const Gas&, NodeView<const double>) {}
void readAll(const tasks::RankPatches&, const std::vector<CellView<const double>>&) {}
void readAllOfGas(const tasks::RankPatches&, const std::vector<Gas>&,
                  const std::vector<std::vector<CellView<const double>>>&) {}
void flow(const Patch&, CellView<double>, RimFlux<double>) {}
void flowOfGas(const Patch&, const Gas&, CellView<double>, RimFlux<double>) {}

/// A strip of blocks of 4 x 8 cells.
grid::Domain strip(int levels) {
  grid::Domain domain;
  domain.upper = {1, 1, 0};
  domain.resolution = {{16, 16, 1}};
  domain.refinement.levels = levels;
  domain.refinement.blockCells = {{4, 8, 1}};
  return domain;
}

/// Returns the problems of the tasks on a grid of several levels, one per line.
std::string problemsOf(const TaskList& list, int levels = 2) {
  std::string text;
  for (const InputProblem& problem : problemsOnLevels(list.tasks(), grid::Grid(strip(levels)), {"a.ups", 7, 3}))
    text += problem.text() + "\n";
  return text;
}

}  // namespace

TEST(LevelLimits, AskForBlocksThatHaveTheGhostsOfATask) {
  TaskList narrow, wide;
  narrow.perPatch("near", readCells, requiresOld(value, 2));
  wide.perPatch("far", readCells, requiresOld(value, 3));
  EXPECT_EQ(problemsOf(narrow), "");
  EXPECT_EQ(problemsOf(wide),
            "a.ups:7:3: task far reads c.value up to 3 cells outside a patch, so blocks need 6 cells along each axis, "
            "but have 4 along x; give <min_patch_size> in <Regridder> of <AMR>\n");
  EXPECT_EQ(problemsOf(wide, 1), "");
}

TEST(LevelLimits, RefuseNodesOfTheStepBefore) {
  TaskList ofNone, ofGas;
  ofNone.perPatch("read", readNodes, requiresOld(corner));
  ofGas.perMaterial("read", readNodesOfGas, gases, requiresOld(corner));
  const std::string refused =
      "a.ups:7:3: task read reads g.corner of nodes from the previous step, which needs a grid of one level\n";
  EXPECT_EQ(problemsOf(ofNone), refused);
  EXPECT_EQ(problemsOf(ofGas), refused);
  EXPECT_EQ(problemsOf(ofGas, 1), "");
}

TEST(LevelLimits, RefuseGhostsOfNodesButAroundParticles) {
  TaskList own, beyond, ofGas;
  own.perPatch("own", readNodes, requiresNew(corner));
  beyond.perPatch("beyond", readNodes, requiresNew(corner, 1));
  ofGas.perMaterial("ofGas", readNodesOfGas, gases, requiresNew(corner, 1));
  EXPECT_EQ(problemsOf(own), "");
  EXPECT_EQ(problemsOf(beyond),
            "a.ups:7:3: task beyond reads g.corner of nodes outside a patch, which needs a grid of one level\n");
  EXPECT_EQ(problemsOf(ofGas), "");
  EXPECT_EQ(problemsOf(beyond, 1), "");
}

TEST(LevelLimits, RefuseTasksThatSeeAllPatchesOfMaterials) {
  TaskList solve, solveFar, solveGas, ofNone, ofGas;
  solve.perRank("solve", readAll, requiresOld(value));
  solveFar.perRank("solve", readAll, requiresOld(value, 3));
  solveGas.perRankAcrossMaterials("solve", readAllOfGas, gases, requiresOld(value));
  ofNone.perPatch("flow", flow, computes(value), keepsFlux(value));
  ofGas.perMaterial("flow", flowOfGas, gases, computes(value), keepsFlux(value));
  EXPECT_EQ(problemsOf(solve), "");
  EXPECT_TRUE(problemsOf(solveFar).starts_with("a.ups:7:3: task solve reads c.value up to 3 cells outside a patch"));
  EXPECT_EQ(problemsOf(solveGas), "a.ups:7:3: task solve needs all patches at once, and hence a grid of one level\n");
  EXPECT_EQ(problemsOf(ofNone) + problemsOf(ofGas), "");
  EXPECT_EQ(problemsOf(solveGas, 1) + problemsOf(ofGas, 1), "");
}

namespace {

void limit(const Patch&, CellView<const double>, Minimum&) {}
void sumUp(const Patch&, CellView<const double>, Sum&) {}

/// Returns the reason that tasks cannot use smaller steps on finer levels.
std::string problemOfSteps(const TaskList& list) {
  const auto problem = problemOfSmallerSteps(list.tasks(), {"a.ups", 7, 3});
  return problem ? problem->text() : "";
}

}  // namespace

TEST(LevelLimits, SmallerStepsAreForTasksThatReadTheOldStateAndTheirOwnCells) {
  constexpr ReductionLabel<Sum> all{"TotalValue", "1", "of all cells"};
  TaskList fit;
  fit.perPatch("limit", limit, requiresOld(value, 2), computes(delT));
  fit.perPatch("own", readCells, requiresNew(value));
  fit.perPatch("flow", flow, computes(value), keepsFlux(value));
  EXPECT_EQ(problemOfSteps(fit), "");
  TaskList far, sums, solve, nodes;
  far.perPatch("far", readCells, requiresNew(value, 1));
  sums.perPatch("sum", sumUp, requiresOld(value), computes(all));
  solve.perRank("solve", readAll, requiresOld(value));
  nodes.perPatch("turn", readNodes, requiresNew(corner));
  const std::string end = ": all levels must take the same time step, as by default";
  const std::string start = "a.ups:7:3: AMR/useLockStep: task ";
  EXPECT_EQ(
      problemOfSteps(far),
      start + "far reads the new c.value outside a patch, where another level may not have computed it yet" + end);
  EXPECT_EQ(problemOfSteps(sums), start + "sum computes TotalValue over the whole grid" + end);
  EXPECT_EQ(problemOfSteps(solve), start + "solve needs all patches at once" + end);
  EXPECT_EQ(problemOfSteps(nodes), start + "turn uses nodes (g.corner)" + end);
}

TEST(LevelLimits, OneSentenceSaysWhichTaskRulesSmallerStepsOutAndHowManyOthers) {
  TaskList list;
  list.perPatch("own", readCells, requiresNew(value));
  for (const char* name : {"first", "second", "third"}) {
    list.perPatch(name, readCells, requiresNew(value, 1));
    const std::string text = problemOfSteps(list), others = text.substr(std::min(text.size(), text.find(", and")));
    EXPECT_NE(text.find("task first reads the new c.value"), std::string::npos) << text;
    EXPECT_EQ(others.substr(0, others.find(':')), name == std::string("first") ? ""
                                                  : name == std::string("second")
                                                      ? ", and 1 other task also rules out smaller steps"
                                                      : ", and 2 other tasks also rule out smaller steps");
  }
}

namespace {

/// A component that reads distant cells.
class FarCooling : public test::Cooling {
 public:
  void scheduleTimeAdvance(TaskList& tasks) const override {
    tasks.perPatch(
        "cooling::cool", [](const Patch&, CellView<const double>, CellView<double>) {}, requiresOld(test::heat, 3),
        computes(test::heat));
  }
};

}  // namespace

TEST(LevelLimits, AreToldOnceWhenListsAreCompiled) {
  const grid::Grid grid(strip(2));
  Phases phases(FarCooling{}, {});
  data::VariableTable table;
  RegridSettings regrid;
  regrid.where = {"far.ups", 12, 5};
  try {
    phases.compile({}, {}, grid, table, regrid);
    FAIL() << "blocks of 4 cells have no three ghosts";
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 1u);
    EXPECT_TRUE(error.problems()[0].text().starts_with("far.ups:12:5: task cooling::cool reads c.heat up to 3 cells"))
        << error.problems()[0].text();
  }
}

}  // namespace tushar::simulation
