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

}  // namespace tushar::simulation
