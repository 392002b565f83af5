#include "core/simulation/outputs.hpp"

#include <gtest/gtest.h>

#include "tests/simulation/cooling.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::simulation {

namespace fs = std::filesystem;

using test::newFolder;

namespace {

inline constexpr CellLabel<double> warmth{"c.warmth", "J", "heat of a cell, as a diagnostic"};

/// Looks every third step at a variable of its task; counts how often the first patch had it.
class Glance : public Analysis {
 public:
  explicit Glance(int* computed) : computed_(computed) {}
  void schedule(TaskList& tasks) const override {
    tasks.perPatch(
        "glance::warmth",
        [](const Patch& patch, int* computed, CellView<const double> heat, CellView<double> warm) {
          if (patch.id() == 0) ++*computed;
          forEach<1>(patch.cells(), [&](const Index<1>& cell) { warm[cell] = heat[cell]; });
        },
        tasks::with(computed_), requiresOld(test::heat), computes(warmth));
  }
  void setTime(double, double) override {}
  std::vector<SaveRequest> samples() const override { return {{std::string(warmth.name), "", {}, {}}}; }
  bool isSampleDue(int step) const override { return step > 0 && step % 3 == 0; }
  void sample(const std::vector<output::Snapshot>& parts, const fs::path&) override {
    for (const output::FieldBlock& field : parts.front().fields)
      seen.push_back(std::get<std::vector<double>>(field.array.values).front());
  }

  std::vector<double> seen;

 private:
  int* computed_;
};

}  // namespace

TEST(Outputs, OfASceneThatSavesNothingMakeNoArchive) {
  const fs::path folder = newFolder("nothing");
  test::CoolingRun run;
  run.initialize();
  Outputs outputs(run, folder);

  outputs.open();
  outputs.saveStart();
  outputs.save();

  EXPECT_EQ(outputs.folder(), "");
  EXPECT_EQ(outputs.archive(), nullptr);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Outputs, AreWrittenAfterEachSecondStepWhereTheSceneAsksForThat) {
  Problem problem = test::cooling();
  problem.archive.saves = {{"c.heat", "", {}, {}}};
  problem.archive.outputTimestepInterval = 2;
  test::CoolingRun run(std::move(problem));
  run.initialize();
  Outputs outputs(run, newFolder("steps"));
  outputs.open();

  std::vector<int> last;
  for (int step = 1; step <= 3; ++step) {
    run.step();
    outputs.saveIfDue();
    last.push_back(outputs.archive()->lastStep());
  }

  EXPECT_EQ(last, (std::vector<int>{-1, 2, 2}));
}

TEST(Outputs, ComputeWhatAModuleLooksAtInTheStepsInWhichItIsDueAlone) {
  int computed = 0;
  auto owned = std::make_unique<Glance>(&computed);
  const Glance& glance = *owned;
  Problem problem = test::cooling();
  problem.time.maxTime = 100;
  problem.analyses.push_back(std::move(owned));
  test::CoolingRun run(std::move(problem));
  run.initialize();
  Outputs outputs(run, newFolder("glance"));
  outputs.open();

  outputs.saveStart();
  for (int step = 1; step <= 7; ++step) {
    run.step();
    outputs.saveGlobals();
  }

  EXPECT_EQ(glance.seen, (std::vector<double>{1. / 8, 1. / 64}));
  EXPECT_EQ(computed, 2);
}

TEST(Outputs, PassTheTimesOfTheRunBefore) {
  Problem problem = test::cooling();
  problem.archive.outputInterval = 0.2;
  test::CoolingRun run(std::move(problem));
  Outputs outputs(run, "");
  EXPECT_DOUBLE_EQ(outputs.nextTime(), 0.2);

  run.time.resume(7, 0.5, 0.01);
  outputs.passMilestones();

  EXPECT_DOUBLE_EQ(outputs.nextTime(), 0.6);
}

}  // namespace tushar::simulation
