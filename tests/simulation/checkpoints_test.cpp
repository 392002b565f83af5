#include "core/simulation/checkpoints.hpp"

#include <gtest/gtest.h>

#include "core/collect/gather.hpp"
#include "tests/simulation/cooling.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::simulation {

namespace {

Problem withCheckpoints(int everySteps) {
  Problem problem = test::cooling();
  problem.archive.checkpoint.emplace().timestepInterval = everySteps;
  return problem;
}

/// Counts the requests to complete its files.
class Flushed : public Analysis {
 public:
  explicit Flushed(int& count) : count_(&count) {}
  void schedule(tasks::TaskList&) const override {}
  void setTime(double, double) override {}
  void flush() override { ++*count_; }

 private:
  int* count_;
};

std::string printOf(RunState& run) { return collect::fingerprint(run.warehouse, run.phases.state(), run.materials()); }

}  // namespace

TEST(Checkpoints, AreDueWhereTheSceneAsksForThem) {
  for (const bool asks : {false, true}) {
    test::CoolingRun run(asks ? withCheckpoints(2) : test::cooling());
    Outputs outputs(run, "");
    const Checkpoints checkpoints(run, outputs);
    run.time.resume(1, 0.25, 0.25);
    EXPECT_FALSE(checkpoints.isDue());
    run.time.resume(2, 0.5, 0.25);
    EXPECT_EQ(checkpoints.isDue(), asks);
  }
}

TEST(Checkpoints, HoldStateTimeAndTotalsOfTheStart) {
  test::CoolingRun written(withCheckpoints(1));
  written.initialize();
  Outputs outputs(written, test::temporaryFolder() + "checkpoints");
  outputs.open();
  written.step();
  written.step();
  Checkpoints(written, outputs).write();
  Problem rest = withCheckpoints(1);
  rest.restart.emplace();
  rest.restart->archive = outputs.folder();
  rest.restart->step = 2;
  test::CoolingRun read(std::move(rest));
  Outputs outputsOfRest(read, "");

  Checkpoints(read, outputsOfRest).resume();

  EXPECT_EQ(read.time.step(), 2);
  EXPECT_EQ(read.time.time(), 0.5);
  EXPECT_EQ(read.totalsAtStart, (Totals{{8}}));
  EXPECT_EQ(printOf(read), printOf(written));
}

TEST(Checkpoints, AreWrittenOnceAnalysesHaveCompletedTheirFiles) {
  int count = 0;
  Problem problem = withCheckpoints(1);
  problem.analyses.push_back(std::make_unique<Flushed>(count));
  test::CoolingRun run(std::move(problem));
  run.initialize();
  Outputs outputs(run, test::temporaryFolder() + "flushed");
  outputs.open();
  Checkpoints checkpoints(run, outputs);
  run.step();

  checkpoints.write();
  EXPECT_EQ(count, 1);
  checkpoints.write();  // this step has one
  EXPECT_EQ(count, 1);
  outputs.flush();
  EXPECT_EQ(count, 2);
}

}  // namespace tushar::simulation
