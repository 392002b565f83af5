#include "core/grid/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/grid/grid.hpp"
#include "tests/support/levels.hpp"

namespace tushar::grid {

namespace {

RankOffsets offsetsOf(const Index3& cells, const Index3& patches, int ranks) {
  return Grid(test::domain(cells, patches), {0, ranks}).rankOffsets();
}

/// Returns the number of patches for which some rank assumes another owner than the offsets give.
int disagreements(const Index3& cells, const Index3& patches, int ranks) {
  const RankOffsets offsets = offsetsOf(cells, patches, ranks);
  int wrong = 0;
  for (int rank = 0; rank < ranks; ++rank) {
    const Grid grid(test::domain(cells, patches), {rank, ranks});
    for (int patch = 0; patch < grid.patchCount(); ++patch) {
      const auto behind = std::upper_bound(offsets.begin(), offsets.end(), patch);
      wrong += grid.ownerOf(patch) != static_cast<int>(behind - offsets.begin()) - 1;
    }
  }
  return wrong;
}

}  // namespace

TEST(Partition, GivesHalvesThatDifferByARowOfCellsToTwoRanks) {
  EXPECT_EQ(offsetsOf({{123, 1, 1}}, {{2, 1, 1}}, 2), (RankOffsets{0, 1, 2}));
  EXPECT_EQ(offsetsOf({{13, 11, 9}}, {{2, 2, 2}}, 2), (RankOffsets{0, 4, 8}));
  EXPECT_EQ(offsetsOf({{13, 11, 9}}, {{2, 2, 2}}, 8), (RankOffsets{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(Partition, CutsBetweenThePatchesThatAreNearestToEvenShares) {
  for (const int ranks : {2, 3, 5, 7}) {
    const Grid grid(test::domain({{103, 1, 1}}, {{20, 1, 1}}));
    const RankOffsets offsets = offsetsOf({{103, 1, 1}}, {{20, 1, 1}}, ranks);
    for (int rank = 1; rank < ranks; ++rank) {
      const double even = 103.0 * rank / ranks;
      const auto distance = [&](int patch) { return std::abs(grid.patch(patch).cells().lower[0] - even); };
      const int cut = offsets[static_cast<std::size_t>(rank)];
      EXPECT_LE(distance(cut), std::min(distance(cut - 1), cut < 19 ? distance(cut + 1) : 1e9)) << rank << '/' << ranks;
    }
  }
}

TEST(Partition, IsTheSameForAllRanksAndLeavesTheFirstOneAPatch) {
  for (const int ranks : {1, 2, 3, 5, 16})
    for (const Index3& patches : {Index3{{1, 1, 1}}, Index3{{2, 1, 1}}, Index3{{3, 2, 2}}}) {
      EXPECT_EQ(disagreements({{13, 11, 9}}, patches, ranks), 0) << ranks << " ranks";
      EXPECT_EQ(offsetsOf({{13, 11, 9}}, patches, ranks)[0], 0);
      EXPECT_GT(offsetsOf({{13, 11, 9}}, patches, ranks)[1], 0);
    }
}

}  // namespace tushar::grid
