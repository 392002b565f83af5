#include "core/grid/shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace tushar::grid {

namespace {

/// Returns the smallest possible maximum load of a rank, by trying all cuts from `first` on.
double leastOfAll(const std::vector<double>& costs, std::size_t first, int ranks) {
  double share = 0, least = std::numeric_limits<double>::infinity();
  if (ranks == 1) return std::accumulate(costs.begin() + static_cast<std::ptrdiff_t>(first), costs.end(), 0.0);
  for (std::size_t end = first; end <= costs.size(); ++end) {
    least = std::min(least, std::max(share, leastOfAll(costs, end, ranks - 1)));
    if (end < costs.size()) share += costs[end];
  }
  return least;
}

}  // namespace

TEST(EvenShares, GiveTheBusiestRankAsLittleAsConsecutivePatchesAllow) {
  std::mt19937 random(7);
  for (const int ranks : {1, 2, 3, 4})
    for (const std::size_t patches : {1U, 2U, 5U, 9U}) {
      std::vector<double> costs;
      for (std::size_t k = 0; k < patches; ++k) costs.push_back(static_cast<double>(random() % 10));
      const RankOffsets shares = evenShares(costs, ranks);

      EXPECT_EQ(shares.size(), static_cast<std::size_t>(ranks) + 1);
      EXPECT_EQ(shares.front(), 0);
      EXPECT_EQ(shares.back(), static_cast<int>(patches));
      EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
      EXPECT_DOUBLE_EQ(greatestShare(costs, shares), leastOfAll(costs, 0, ranks));
    }
}

TEST(EvenShares, LeaveTheFirstRankAPatchWhateverItCosts) {
  EXPECT_EQ(evenShares({9, 1, 1}, 2), (RankOffsets{0, 1, 3}));
  EXPECT_EQ(evenShares({0, 0, 0}, 2)[0], 0);
  EXPECT_GT(evenShares({0, 0, 0}, 2)[1], 0);
}

}  // namespace tushar::grid
