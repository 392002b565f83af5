#include "core/simulation/level_steps.hpp"

#include <gtest/gtest.h>

namespace tushar::simulation {

TEST(LevelSteps, FillACoarserStepByTwoUpToAnEighthBeyondTheLimit) {
  const double stable = 0.1;
  for (const double rest : {0.02, 0.1, 0.1 * (1 + 1e-12)}) EXPECT_EQ(stepsThatFill(rest, stable, true), 1) << rest;
  for (const double rest : {0.11, 0.2, 0.224}) EXPECT_EQ(stepsThatFill(rest, stable, true), 2) << rest;
  for (const double rest : {0.226, 0.337}) EXPECT_EQ(stepsThatFill(rest, stable, true), 3) << rest;
}

TEST(LevelSteps, FillTheRestOfACoarserStepByOneUpToAnEighthBeyondTheLimit) {
  const double stable = 0.1;
  for (const double rest : {0.02, 0.1, 0.112}) EXPECT_EQ(stepsThatFill(rest, stable, false), 1) << rest;
  for (const double rest : {0.114, 0.224}) EXPECT_EQ(stepsThatFill(rest, stable, false), 2) << rest;
}

TEST(LevelSteps, AreOneWhereNothingLimitsThem) {
  EXPECT_EQ(stepsThatFill(0.1, std::numeric_limits<double>::infinity(), true), 1);
}

}  // namespace tushar::simulation
