#include "core/base/even_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tushar {

TEST(EvenOrder, SharesCosts) {
  const std::vector<double> costs{1, 2, 3, 6, 1, 1};
  EXPECT_EQ(greatestLoad(costs, {0, 1, 2, 3, 4, 5}, 2), 8);
  const std::vector<int> order = evenOrder(costs, 2);
  EXPECT_EQ(order, (std::vector<int>{3, 4, 5, 2, 1, 0}));
  EXPECT_EQ(greatestLoad(costs, order, 2), 8);  // three iterations for each: 6 + 1 + 1
  EXPECT_EQ(greatestLoad({.7, 1, 1.1, 1.7}, {0, 1, 2, 3}, 2), 1.1 + 1.7);
  EXPECT_EQ(greatestLoad({.7, 1, 1.1, 1.7}, evenOrder({.7, 1, 1.1, 1.7}, 2), 2), 1.7 + .7);
}

TEST(EvenOrder, ContainsEachIterationOnce) {
  for (const int threads : {1, 2, 3, 8})
    for (int count = 0; count < 12; ++count) {
      std::vector<double> costs;
      for (int k = 0; k < count; ++k) costs.push_back((7 * k) % 5);
      std::vector<int> order = evenOrder(costs, threads);
      std::sort(order.begin(), order.end());
      for (int k = 0; k < count; ++k) EXPECT_EQ(order.at(k), k) << threads << " threads";
      EXPECT_EQ(order.size(), costs.size());
    }
}

}  // namespace tushar
