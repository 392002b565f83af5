#include <gtest/gtest.h>

#include <sstream>

#include "core/base/error.hpp"
#include "core/tasks/lifetimes.hpp"
#include "core/tasks/task_graph.hpp"
#include "core/tasks/task_list.hpp"
#include "tests/support/levels.hpp"

// Each step of compiling a task list, on its own.

namespace tushar::tasks {

namespace {

using data::CellLabel;
using data::CellView;
using data::Generation;
using data::NodeLabel;
using data::NodeView;
using data::ParticleLabel;
using data::ParticleView;
using grid::Patch;

constexpr CellLabel<double> a{"c.a", "1", "a"}, b{"c.b", "1", "b"}, c{"c.c", "1", "c"};
constexpr ParticleLabel<Vec<1>> x{"p.x", "m", "position"};
constexpr ParticleLabel<double> mass{"p.mass", "kg", "mass"};

struct Material {
  std::string name;
};
const std::vector<Material> gas{{"gas"}};

void read(const Patch&, CellView<const double>) {}
void write(const Patch&, CellView<double>) {}
void readWrite(const Patch&, CellView<const double>, CellView<double>) {}
void writeX(const Patch&, const Material&, ParticleView<Vec<1>>) {}
void readMass(const Patch&, const Material&, ParticleView<const double>, CellView<double>) {}
void change(const Patch&, const Material&, ParticleView<const double>, ParticleView<double>) {}
void makeX(const Patch&, const Material&, ParticleMaker&, std::vector<Vec<1>>&) {}

std::string complaint(const TaskList& list, const Names& state = {}) {
  try {
    validate(list.tasks(), state);
  } catch (const TaskError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> names(const std::vector<Task>& tasks) {
  std::vector<std::string> result;
  for (const Task& task : tasks) result.push_back(task.name);
  return result;
}

}  // namespace

TEST(Validate, NamesTaskLabelAndNearestCandidateOfAMissingProducer) {
  constexpr CellLabel<double> temperature{"c.temperature", "K", "T"}, typo{"c.temprature", "K", "T"};
  TaskList list;
  list.perPatch("heat", write, computes(temperature));
  list.perPatch("look", read, requiresNew(typo));

  EXPECT_EQ(complaint(list),
            "task look: c.temprature is required, but no earlier task of the list computes it (did you mean "
            "'c.temperature'?)");
}

TEST(Validate, SaysWhatIsNeverInitialised) {
  TaskList list;
  list.perPatch("step", readWrite, requiresOld(a), computes(b));

  EXPECT_EQ(complaint(list),
            "task step: c.a is required at the start of the step, but no task of scheduleInitialize computes it");
  EXPECT_EQ(complaint(list, {"c.a"}), "");
}

TEST(Validate, RefusesTwoProducersAndUseWithAndWithoutAMaterial) {
  TaskList list;
  list.perPatch("first", write, computes(a));
  list.perPatch("second", write, computes(a));
  list.perMaterial("third", readMass, gas, requiresOld(mass), computes(a));

  EXPECT_EQ(complaint(list, {"p.mass"}),
            "task second: c.a is computed a second time; use modifies to change it\n"
            "task third: c.a is used both with and without a material; use two labels\n"
            "task third: c.a is computed a second time; use modifies to change it");
}

TEST(Validate, LetsTasksOfMaterialsUseWhatBelongsToNone) {
  const auto body = [](const auto&...) {};
  TaskList list;
  list.perPatch("makeA", write, computes(a));
  list.perMaterial("read", body, gas, withoutMaterial(requiresNew(a)), computes(b));
  list.acrossMaterials("write", body, gas, requiresNew(b), withoutMaterial(computes(c)));

  EXPECT_EQ(complaint(list), "");
}

TEST(Validate, RefusesToWriteOnceForEachMaterialWhatBelongsToNone) {
  TaskList list;
  list.perMaterial(
      "write", [](const auto&...) {}, gas, withoutMaterial(computes(c)));

  EXPECT_EQ(complaint(list),
            "task write: c.c is written once for each material, but belongs to none; use acrossMaterials");
}

TEST(Validate, RefusesATaskThatChangesParticlesWhichItsNeighboursRead) {
  const auto complaintAbout = [](int ghost) {
    TaskList list;
    list.perMaterial("weigh", change, gas, requiresOld(mass), computes(mass));
    list.perMaterial("smooth", change, gas, requiresNew(mass, ghost), modifies(mass));
    return complaint(list, {"p.mass"});
  };

  EXPECT_EQ(complaintAbout(0), "");
  EXPECT_EQ(complaintAbout(1),
            "task smooth: p.mass is read outside the patch and written by the same task; write to another label");
}

TEST(Validate, LetsTasksReadWhatARelocationBroughtAlong) {
  TaskList list;
  list.perMaterial("move", writeX, gas, computes(x));
  list.relocate(x, gas);
  list.perMaterial("look", readMass, gas, requiresNew(mass), computes(c));

  EXPECT_EQ(complaint(list, {"p.mass"}), "");
  EXPECT_NE(complaint(list, {}), "");
}

TEST(Prune, KeepsTheChainToAWantedVariableAndSaysWhyTheRestIsLeftOut) {
  TaskList list;
  list.perPatch("makeA", write, computes(a));
  list.perPatch("makeB", readWrite, requiresNew(a), computes(b));
  list.perPatch("makeC", readWrite, requiresNew(a), computes(c));

  const Pruned pruned = prune(list.tasks(), {"c.b"}, false);

  EXPECT_EQ(names(pruned.kept), (std::vector<std::string>{"makeA", "makeB"}));
  ASSERT_EQ(pruned.leftOut.size(), 1u);
  EXPECT_EQ(pruned.leftOut[0].task, "makeC");
  EXPECT_EQ(pruned.leftOut[0].reason, "nothing reads or saves c.c");
}

TEST(Prune, KeepsAllTasksThatAddToAReduction) {
  TaskList list;
  for (const char* name : {"limit", "limitFurther"})
    list.perPatch(
        name, [](const Patch&, data::Minimum& dt) { dt.add(1); }, computes(data::delT));

  EXPECT_EQ(names(prune(list.tasks(), {std::string(data::delT.name)}, false).kept),
            (std::vector<std::string>{"limit", "limitFurther"}));
}

TEST(Prune, KeepsAChangeOnlyWhereItIsSeen) {
  TaskList list;
  list.perPatch("makeA", write, computes(a));
  list.perPatch("useA", readWrite, requiresNew(a), computes(b));
  list.perPatch("changeA", write, modifies(a));

  EXPECT_EQ(names(prune(list.tasks(), {"c.b"}, false).kept), (std::vector<std::string>{"makeA", "useA"}));
  EXPECT_EQ(names(prune(list.tasks(), {"c.a"}, false).kept), (std::vector<std::string>{"makeA", "changeA"}));
}

TEST(Prune, KeepsWhatTheNextStepNeeds) {
  TaskList list;
  list.perPatch("makeA", readWrite, requiresOld(b), computes(a));
  list.perPatch("makeB", readWrite, requiresOld(b), computes(b));

  const Pruned once = prune(list.tasks(), {"c.a"}, false), repeated = prune(list.tasks(), {"c.a"}, true);

  EXPECT_EQ(names(once.kept), (std::vector<std::string>{"makeA"}));
  EXPECT_EQ(names(repeated.kept), (std::vector<std::string>{"makeA", "makeB"}));
  EXPECT_EQ(repeated.needed, (Names{"c.a", "c.b"}));
}

TEST(Connect, OrdersReadersAfterWritersAndWritersAfterReaders) {
  TaskList list;
  list.perPatch("write", write, computes(a));
  list.perPatch("read", readWrite, requiresNew(a), computes(b));
  list.perPatch("change", write, modifies(a));
  list.perPatch("readAgain", readWrite, requiresNew(a), computes(c));

  const std::vector<Dependency> expected{{0, 1, "c.a"}, {0, 2, "c.a"}, {1, 2, "c.a"}, {2, 3, "c.a"}};
  EXPECT_EQ(connect(list.tasks()), expected);
}

TEST(Connect, LetsReadersWaitForTheRelocationThatBringsTheirParticles) {
  TaskList list;
  list.perMaterial("move", writeX, gas, computes(x));
  list.relocate(x, gas);
  list.perMaterial("look", readMass, gas, requiresNew(mass), computes(c));

  const std::vector<Dependency> expected{{0, 1, "p.x"}, {1, 2, "p.mass"}};
  EXPECT_EQ(connect(list.tasks()), expected);
}

TEST(Place, RunsEachTaskOnEachPatchForEachMaterial) {
  const std::vector<Material> two{{"gas"}, {"steel"}};
  const grid::Grid grid(test::domain({{8, 1, 1}}, {{2, 1, 1}}));
  TaskList list;
  list.perPatch("write", write, computes(a));
  list.perMaterial("move", writeX, two, computes(x));

  const std::vector<Placement> expected{{0, 0, -1}, {0, 1, -1}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  EXPECT_EQ(place(list.tasks(), grid), expected);
}

TEST(Plan, FillsOldGhostsOnceBeforeTheFirstTaskThatNeedsAny) {
  TaskList list;
  list.perPatch("near", readWrite, requiresOld(a), computes(c));
  list.perPatch("first", readWrite, requiresOld(a, 1), computes(b));
  list.perPatch("later", read, requiresOld(b, 2));

  const std::vector<Stage> stages = plan(list.tasks());

  EXPECT_TRUE(stages[0].fills.empty());
  ASSERT_EQ(stages[1].fills.size(), 2u);
  EXPECT_EQ(stages[1].fills[0].label->name, "c.a");
  EXPECT_EQ(stages[1].fills[1].label->name, "c.b");
  EXPECT_EQ(stages[1].fills[1].generation, data::Generation::old);
  EXPECT_TRUE(stages[2].fills.empty());
}

TEST(Plan, FillsNewGhostsBeforeTheirReaderAndAgainAfterAChange) {
  TaskList list;
  list.perPatch("write", write, computes(a));
  list.perPatch("read", readWrite, requiresNew(a, 1), computes(b));
  list.perPatch("change", write, modifies(a));
  list.perPatch("readAgain", readWrite, requiresNew(a, 1), computes(c));

  const std::vector<Stage> stages = plan(list.tasks());

  EXPECT_EQ(stages[1].fills.size(), 1u);
  EXPECT_EQ(stages[3].fills.size(), 1u);
}

TEST(Plan, SendsWhatIsReadyWithAnEarlierExchange) {
  TaskList list;
  list.perPatch("writeA", write, computes(a));
  list.perPatch("writeB", write, computes(b));
  list.perPatch("readA", read, requiresNew(a, 1));
  list.perPatch("readB", read, requiresNew(b, 1));

  const std::vector<Stage> stages = plan(list.tasks());

  EXPECT_EQ(stages[2].fills.size(), 2u);
  EXPECT_TRUE(stages[3].fills.empty());
}

TEST(Plan, SendsAsSoonAsTheLastOfAStageIsComputed) {
  TaskList list;
  list.perPatch("readOld", read, requiresOld(a, 1));
  list.perPatch("writeA", write, computes(a));
  list.perPatch("writeB", write, computes(b));
  list.perPatch("useB", readWrite, requiresNew(b), computes(c));
  list.perPatch("readB", read, requiresNew(b, 1));
  list.perPatch("readA", read, requiresNew(a, 1));

  const std::vector<Stage> stages = plan(list.tasks());

  EXPECT_EQ(stages[0].ready, -1);
  ASSERT_EQ(stages[4].fills.size(), 2u);
  EXPECT_EQ(stages[4].ready, 2);
}

TEST(Plan, TakesNodesNearTheParticlesThatTheyWereComputedFrom) {
  constexpr NodeLabel<double> before{"g.before", "1", "of the old particles"}, after{"g.after", "1", "of the new ones"};
  const auto make = [](const Patch&, const Material&, NodeView<double>) {};
  const auto use = [](const Patch&, const Material&, NodeView<const double>) {};
  TaskList list;
  list.perMaterial("move", writeX, gas, computes(x));
  list.perMaterial("makeBefore", make, gas, computes(before));
  list.relocate(x, gas);
  list.perMaterial("useBefore", use, gas, requiresNew(before, 1));
  list.perMaterial("makeAfter", make, gas, computes(after));
  list.perMaterial("useAfter", use, gas, requiresNew(after, 1));

  const std::vector<Stage> stages = plan(list.tasks());

  ASSERT_EQ(stages[3].fills.size(), 1u);
  EXPECT_EQ(stages[3].fills[0].set, Generation::old);
  ASSERT_EQ(stages[5].fills.size(), 1u);
  EXPECT_EQ(stages[5].fills[0].set, Generation::fresh);
}

TEST(TaskGraph, SendsBeforeTheTaskAfterTheOneThatComputes) {
  const grid::Grid grid(test::domain({{8, 1, 1}}));
  data::VariableTable table;
  TaskList list;
  list.perPatch("writeA", write, computes(a));
  list.perPatch("writeB", write, computes(b));
  list.perPatch("readA", readWrite, requiresNew(a, 1), computes(c));

  const TaskGraph graph("step", prune(list.tasks(), {"c.b", "c.c"}, false), grid, table);

  EXPECT_EQ(graph.tasks()[0].sends, -1);
  EXPECT_EQ(graph.tasks()[1].sends, 2);
  EXPECT_EQ(graph.tasks()[2].sends, -1);
}

TEST(Lifetimes, EndWithTheLastReaderUnlessTheResultIsWanted) {
  TaskList list;
  list.perPatch("makeA", write, computes(a));
  list.perPatch("makeB", readWrite, requiresNew(a), computes(b));
  list.perPatch("makeC", readWrite, requiresNew(b), computes(c));

  const auto freed = lifetimes(prune(list.tasks(), {"c.c"}, false));

  const std::vector<std::vector<std::string>> expected{{}, {"c.a"}, {"c.b"}};
  EXPECT_EQ(freed, expected);
}

TEST(TaskGraph, RefusesNewParticlesWithoutWhatIsNeededLater) {
  const grid::Grid grid(test::domain({{8, 1, 1}}));
  data::VariableTable table;
  TaskList list;
  list.newParticles("make", makeX, gas, creates(x));

  try {
    TaskGraph("advance", prune(list.tasks(), {"p.x", "p.mass"}, false), grid, table);
    FAIL();
  } catch (const TaskError& error) {
    EXPECT_STREQ(error.what(), "task make makes new particles, but does not create p.mass, which is needed later");
  }
}

TEST(TaskGraph, PrintsTasksInOrderAndDependenciesForGraphviz) {
  const grid::Grid grid(test::domain({{8, 1, 1}}));
  data::VariableTable table;
  TaskList list;
  list.perPatch("makeA", write, computes(a));
  list.perPatch("makeB", readWrite, requiresNew(a, 1), computes(b));
  std::ostringstream text, dot;

  const TaskGraph graph("step", prune(list.tasks(), {"c.b"}, false), grid, table);
  graph.print(text);
  graph.printDot(dot);

  EXPECT_EQ(text.str(),
            "step\n   1  makeA\n      computes      c.a\n   2  makeB\n      requires new  c.a (ghost 1)\n"
            "      computes      c.b\n");
  EXPECT_NE(dot.str().find("t0 -> t1 [label=\"c.a\"];"), std::string::npos);
}

}  // namespace tushar::tasks
