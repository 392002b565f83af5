#include "core/simulation/reported.hpp"

#include <gtest/gtest.h>

#include "core/simulation/checkpoints.hpp"
#include "core/simulation/run_report.hpp"
#include "tests/simulation/cooling.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::simulation {

namespace {

inline constexpr ReductionLabel<Sum> lostHeat{"LostHeat", "J", "heat that all cells lose in the step"};
inline constexpr ReductionLabel<Minimum> leastHeat{"LeastHeat", "J", "least heat of a cell after the step"};

/// Cells that cool down, and numbers for the report.
class Watched : public test::Cooling {
 public:
  void scheduleTimeAdvance(TaskList& tasks) const override {
    Cooling::scheduleTimeAdvance(tasks);
    tasks.perPatch(
        "watched::measure",
        [](const Patch& patch, CellView<const double> before, CellView<const double> after, Sum& lost, Minimum& least) {
          forEach<1>(patch.cells(), [&](const Index<1>& cell) {
            lost.add(before[cell] - after[cell]);
            least.add(after[cell]);
          });
        },
        requiresOld(test::heat), requiresNew(test::heat), computes(lostHeat), computes(leastHeat));
  }
  std::vector<Reported> reported() const override {
    using enum Reported::Over;
    return {{"lost", "heat lost", "J", &lostHeat, sum},
            {"lost_time", "heat lost, times time", "J s", &lostHeat, time},
            {"least", "least heat of a cell", "J", &leastHeat, least},
            {"left", "heat left", "J", &test::totalHeat, end},
            {"costly", "what nobody saves", "J", &lostHeat, sum, true}};
  }
};

Problem watched(int checkpointEvery = 0) {
  Problem problem = test::cooling();
  problem.component = std::make_unique<Watched>();
  if (checkpointEvery > 0) problem.archive.checkpoint.emplace().timestepInterval = checkpointEvery;
  return problem;
}

/// Takes some steps of .25 s and returns the report.
report::Report reportAfter(test::CoolingRun& run, int steps) {
  RunReport made(run);
  made.beginLoop(0);
  for (int step = 0; step < steps; ++step) {
    run.step();
    made.noteStep();
  }
  made.endLoop(0);
  return made.make();
}

using Numbers = std::vector<std::pair<std::string, std::vector<double>>>;

Numbers numbersOf(const report::Report& report) {
  Numbers numbers;
  for (const report::NumberOfRun& one : report.ofRun) numbers.emplace_back(one.key, one.value);
  return numbers;
}

}  // namespace

TEST(Reported, AddsUpIntegratesAndTakesTheLeastOfSteps) {
  test::CoolingRun run(watched());
  run.initialize();
  EXPECT_EQ(numbersOf(reportAfter(run, 2)),
            (Numbers{{"lost", {6}}, {"lost_time", {1.5}}, {"least", {0.25}}, {"left", {2}}}));
}

TEST(Reported, OfStepsIsAbsentBeforeTheFirst) {
  test::CoolingRun run(watched());
  run.initialize();
  EXPECT_EQ(numbersOf(reportAfter(run, 0)), (Numbers{{"left", {8}}}));
}

TEST(Reported, ThatIsCostlyIsShownIfItIsSaved) {
  Problem problem = watched();
  problem.archive.saves.push_back({"LostHeat", "", {}, {}});
  test::CoolingRun run(std::move(problem));
  run.initialize();
  EXPECT_EQ(numbersOf(reportAfter(run, 1)).back(), (Numbers::value_type{"costly", {4}}));
}

TEST(Reported, DoesNotChangeTheState) {
  test::CoolingRun plain, run(watched());
  EXPECT_EQ(run.phases.state(), plain.phases.state());
}

TEST(Reported, GoesOnAfterARestart) {
  test::CoolingRun written(watched(1));
  written.initialize();
  Outputs outputs(written, test::temporaryFolder() + "reported");
  outputs.open();
  reportAfter(written, 1);
  Checkpoints(written, outputs).write();
  outputs.flush();
  Problem rest = watched(1);
  rest.restart.emplace();
  rest.restart->archive = outputs.folder();
  rest.restart->step = 1;
  test::CoolingRun read(std::move(rest));
  Outputs outputsOfRest(read, "");
  Checkpoints(read, outputsOfRest).resume();

  EXPECT_EQ(numbersOf(reportAfter(read, 1)), numbersOf(reportAfter(written, 1)));
}

TEST(Reported, IsListedInTextAndJson) {
  report::Report report;
  EXPECT_EQ(toText(report).find("over the run"), std::string::npos);
  EXPECT_EQ(toJson(report).find("of_run"), std::string::npos);
  report.ofRun = {{"work", "work of the gas", "J", {1.5}}, {"impulse", "impulse of the gas", "N s", {1, 0, -2}}};
  EXPECT_NE(toText(report).find("over the run\n  work of the gas                                 1.5   J\n"
                                "  impulse of the gas                         1, 0, -2   N s\n"),
            std::string::npos)
      << toText(report);
  EXPECT_NE(toJson(report).find("\"work\": 1.5"), std::string::npos) << toJson(report);
}

}  // namespace tushar::simulation
