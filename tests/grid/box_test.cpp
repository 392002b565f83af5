#include "core/grid/box.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace tushar::grid {

TEST(ForEachRow, VisitsEachRowOnceWithItsLengthInTheOrderOfTheCells) {
  const Box box{{{2, 5, 0}}, {{6, 7, 1}}};
  std::vector<std::pair<Index<2>, int>> rows;

  forEachRow<2>(box, [&](const Index<2>& first, int count) { rows.emplace_back(first, count); });

  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].first, (Index<2>{{2, 5}}));
  EXPECT_EQ(rows[1].first, (Index<2>{{2, 6}}));
  EXPECT_EQ(rows[0].second, 4);
  EXPECT_EQ(rows[1].second, 4);
}

TEST(ForEachRow, VisitsNothingOfAnEmptyBox) {
  int visits = 0;

  forEachRow<3>(Box{{{2, 5, 0}}, {{2, 7, 1}}}, [&](const Index3&, int) { ++visits; });

  EXPECT_EQ(visits, 0);
}

}  // namespace tushar::grid
