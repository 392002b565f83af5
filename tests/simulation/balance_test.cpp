#include "core/simulation/balance.hpp"

#include <gtest/gtest.h>

namespace tushar::simulation {

using grid::RankOffsets;

TEST(Balance, LooksAtTheCostsAfter8And16And32StepsAndThenEvery64) {
  Balance balance(2);
  std::vector<int> looks;
  for (int step = 1; step <= 200; ++step)
    if (balance.isDue()) {
      looks.push_back(step);
      balance.better({1, 1}, {0, 1, 2}, step);
    }

  EXPECT_EQ(looks, (std::vector<int>{8, 16, 32, 64, 128, 192}));
}

TEST(Balance, NeverLooksOnOneRank) {
  Balance balance(1);
  for (int step = 1; step <= 100; ++step) EXPECT_FALSE(balance.isDue());
}

TEST(Balance, MovesPatchesWhereThatPaysAndReportsIt) {
  Balance balance(2);

  EXPECT_EQ(balance.better({8, 1, 1, 1, 1}, {0, 3, 5}, 40), (RankOffsets{0, 1, 5}));
  EXPECT_EQ(balance.report().times, 1);
  EXPECT_EQ(balance.report().step, 40);
  EXPECT_DOUBLE_EQ(balance.report().before, 10. / 6);
  EXPECT_DOUBLE_EQ(balance.report().after, 8. / 6);
}

TEST(Balance, LeavesThemWhereItGainsLessThanATenth) {
  Balance balance(2);

  EXPECT_EQ(balance.better({10, 1, 9}, {0, 2, 3}, 1), std::nullopt);
  EXPECT_EQ(balance.report().times, 0);
}

TEST(Balance, LeavesThemWhereTheChangeCostsMoreThanItSaves) {
  Balance balance(2);
  balance.noteChange(2.5);

  EXPECT_EQ(balance.better({8, 1, 1, 1, 1}, {0, 3, 5}, 1), std::nullopt);
  EXPECT_NE(balance.better({80, 10, 10, 10, 10}, {0, 3, 5}, 1), std::nullopt);
}

}  // namespace tushar::simulation
