#include "core/simulation/run_report.hpp"

#include <gtest/gtest.h>

#include "tests/simulation/cooling.hpp"

namespace tushar::simulation {

TEST(RunReport, MeasuresStepsAndTheDriftOfTotals) {
  test::CoolingRun run;
  run.initialize();
  RunReport made(run);
  made.beginLoop(0);
  for (int step = 0; step < 2; ++step) {
    run.step();
    made.noteStep();
  }
  made.endLoop(0);

  const report::Report report = made.make();

  EXPECT_EQ(report.steps, 2);
  EXPECT_EQ(report.cells, 8);
  EXPECT_EQ(report.patches, 2);
  EXPECT_EQ(report.particles, 0);
  EXPECT_EQ(report.kept, (std::vector<std::string>{"cooling::limit", "cooling::cool"}));
  ASSERT_EQ(report.drifts.size(), 1u);
  EXPECT_EQ(report.drifts[0].name, "energy");
  EXPECT_EQ(report.drifts[0].start, 8);
  EXPECT_EQ(report.drifts[0].end, 2);
  EXPECT_EQ(report.drifts[0].change, -0.75);
}

TEST(RunReport, TellsWhatIsInMemory) {
  test::CoolingRun run;
  run.initialize();
  RunReport made(run);

  const report::MemoryOfRanks memory = made.make(4096).memoryOfRanks;

  EXPECT_GE(memory.sum.fields, 8 * sizeof(double));  // the heat of eight cells, with what aligns it
  EXPECT_LE(memory.sum.fields, 1000);
  EXPECT_EQ(memory.sum.particles, 0);
  EXPECT_EQ(memory.sum.files, 4096);
  EXPECT_EQ(memory.most.files, 4096);
  EXPECT_GT(memory.sum.peak, 1e6);
  EXPECT_GE(memory.sum.buffers, 0);
}

}  // namespace tushar::simulation
