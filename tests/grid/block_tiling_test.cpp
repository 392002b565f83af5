#include "core/grid/block_tiling.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tushar::grid {

namespace {

constexpr int roots = 3;

/// A tree in which one corner is refined in each level, so that the finest levels have few blocks.
BlockTree refinedAtACorner(int dimension, int levels) {
  BlockTree tree(dimension, {{roots, dimension > 1 ? roots : 1, dimension > 2 ? roots : 1}}, {}, levels);
  std::vector<BlockId> wanted;
  for (int level = 0; level + 1 < levels; ++level) {
    wanted.push_back({level, {{1, dimension > 1 ? 1 : 0, 0}}});
    tree = tree.regridded(wanted, {});
  }
  return tree;
}

std::vector<int> idsOf(const std::vector<Tile>& tiles) {
  std::vector<int> ids;
  for (const Tile& tile : tiles) ids.push_back(tile.id);
  return ids;
}

}  // namespace

TEST(BlockTiling, FindsEachPatchThatABoxOverlapsOnceInTheirOrder) {
  std::mt19937 random(5);
  for (const int dimension : {1, 2, 3})
    for (const int most : {4, 12}) {
      constexpr int levels = 5;
      Index3 block = Index3::filled(1), size = block;
      for (int d = 0; d < dimension; ++d) block[d] = 4, size[d] = most;
      const BlockTiling tiling(refinedAtACorner(dimension, levels), block, size);
      for (int level = 0; level < levels; ++level)
        for (int trial = 0; trial < 50; ++trial) {
          Box box{{}, Index3::filled(1)};
          for (int d = 0; d < dimension; ++d) {
            const auto cells = static_cast<unsigned>(tiling.tree().blocksOf(level)[d] * block[d]);
            const auto lower = static_cast<unsigned>(random() % cells);
            box.lower[d] = static_cast<int>(lower);
            box.upper[d] = static_cast<int>(lower + 1 + random() % (cells - lower));
          }
          std::vector<int> expected;
          for (int id = 0; id < tiling.count(); ++id)
            if (tiling.tile(id).level == level && !tiling.tile(id).cells.intersect(box).empty()) expected.push_back(id);
          EXPECT_EQ(idsOf(tiling.overlapping(level, box)), expected);
        }
    }
}

TEST(BlockTiling, FindsThePatchOfEachCell) {
  constexpr int levels = 5;
  const BlockTiling tiling(refinedAtACorner(2, levels), {{4, 4, 1}}, {{12, 12, 1}});
  for (int id = 0; id < tiling.count(); ++id)
    forEach<3>(tiling.tile(id).cells,
               [&](const Index3& cell) { EXPECT_EQ(tiling.tileOf(tiling.tile(id).level, cell).id, id); });
  EXPECT_EQ(tiling.tileOf(levels - 1, {{(roots * 4 << (levels - 1)) - 1, 0, 0}}).id, -1);
}

}  // namespace tushar::grid
