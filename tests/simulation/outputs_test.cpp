#include "core/simulation/outputs.hpp"

#include <gtest/gtest.h>

#include "tests/simulation/cooling.hpp"
#include "tests/support/temporary.hpp"

namespace tushar::simulation {

namespace fs = std::filesystem;

using test::newFolder;

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
