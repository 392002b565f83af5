#include "core/grid/block_patches.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tushar::grid {

namespace {

constexpr int everything = 1 << 20;

/// A tree with randomly chosen blocks refined.
BlockTree refinedByChance(int dimension, const Index3& roots, const Index3& periodic, unsigned seed) {
  std::mt19937 random(seed);
  const BlockTree tree(dimension, roots, periodic, 4);
  std::vector<BlockId> wanted;
  for (const int level : {0, 1, 2}) {
    BlockId block{level, {}};
    for (int d = 0; d < 3; ++d)
      block.at[d] = static_cast<int>(random() % static_cast<unsigned>(tree.blocksOf(level)[d]));
    wanted.push_back(block);
  }
  return tree.regridded(wanted, {});
}

std::vector<BlockTree> trees() {
  std::vector<BlockTree> all;
  for (const unsigned seed : {1U, 2U, 3U}) {
    all.push_back(refinedByChance(1, {{5, 1, 1}}, {{1, 0, 0}}, seed));
    all.push_back(refinedByChance(2, {{3, 2, 1}}, {{0, 1, 0}}, seed));
    all.push_back(refinedByChance(3, {{2, 1, 2}}, {{1, 0, 0}}, seed));
  }
  return all;
}

Index3 cellsPerBlock(const BlockTree& tree) {
  Index3 cells = Index3::filled(1);
  for (int d = 0; d < tree.dimension(); ++d) cells[d] = 2 + 2 * (d % 2);
  return cells;
}

/// Returns the number of patches that contain each cell of the finest level, in lexicographic order.
std::vector<int> timesCovered(const BlockTree& tree, const std::vector<PatchBox>& patches) {
  Box all{{}, tree.blocksOf(tree.levels() - 1)};
  for (int d = 0; d < 3; ++d) all.upper[d] *= cellsPerBlock(tree)[d];
  std::vector<int> times(all.size(), 0);
  for (const PatchBox& patch : patches) {
    Box finest = patch.cells;
    for (int d = 0; d < tree.dimension(); ++d) {
      finest.lower[d] <<= tree.levels() - 1 - patch.level;
      finest.upper[d] <<= tree.levels() - 1 - patch.level;
    }
    EXPECT_EQ(finest.intersect(all), finest);
    forEach<3>(finest, [&](const Index3& at) { ++times[all.offset(at)]; });
  }
  return times;
}

std::size_t cellsIn(const std::vector<PatchBox>& patches, int level) {
  std::size_t cells = 0;
  for (const PatchBox& patch : patches) cells += patch.level == level ? patch.cells.size() : 0;
  return cells;
}

}  // namespace

TEST(BlockPatches, HoldTheCellsOfABlock) {
  EXPECT_EQ(cellsOf({2, {{3, 1, 0}}}, {{8, 4, 1}}, 2), (Box{{{24, 4, 0}}, {{32, 8, 1}}}));
  EXPECT_EQ(cellsOf({0, {{1, 0, 0}}}, {{16, 1, 1}}, 1), (Box{{{16, 0, 0}}, {{32, 1, 1}}}));
}

TEST(BlockPatches, CoverEachCellOfTheFinestLevelOnceWhateverTheirSize) {
  for (const BlockTree& tree : trees()) {
    const Index3 block = cellsPerBlock(tree);
    const std::vector<PatchBox> single = patchesOf(tree, block, block);
    EXPECT_EQ(single.size(), tree.leaves().size());
    for (const int most : {4, 5, 8, 16, everything}) {
      const std::vector<PatchBox> patches = patchesOf(tree, block, Index3::filled(most));

      for (const int times : timesCovered(tree, patches)) ASSERT_EQ(times, 1);
      for (int level = 0; level < tree.levels(); ++level) EXPECT_EQ(cellsIn(patches, level), cellsIn(single, level));
      for (const PatchBox& patch : patches)
        for (int d = 0; d < tree.dimension(); ++d) EXPECT_LE(patch.cells.extent(d), most);
    }
    EXPECT_LT(patchesOf(tree, block, Index3::filled(everything)).size(), single.size());
  }
}

TEST(BlockPatches, OfOneBlockEachAreTheLeavesInTheirOrder) {
  for (const BlockTree& tree : trees()) {
    const Index3 block = cellsPerBlock(tree);
    std::vector<PatchBox> leaves;
    for (const BlockId& leaf : tree.leaves()) leaves.push_back({leaf.level, cellsOf(leaf, block, tree.dimension())});

    EXPECT_EQ(patchesOf(tree, block, block), leaves);
  }
}

TEST(BlockPatches, AreOneWhereNothingIsRefinedAndThereIsNoLimit) {
  for (const Index3& roots : {Index3{{1, 1, 1}}, Index3{{3, 5, 2}}, Index3{{8, 4, 4}}}) {
    const BlockTree tree(3, roots, Index3::filled(1), 3);
    const PatchBox all{0, {{}, {{roots[0] * 8, roots[1] * 8, roots[2] * 8}}}};

    EXPECT_EQ(patchesOf(tree, Index3::filled(8), Index3::filled(everything)), std::vector<PatchBox>{all});
  }
}

TEST(BlockPatches, GrowAlongXThenYAroundWhatIsRefined) {
  const BlockTree tree = BlockTree(2, {{3, 3, 1}}, {}, 2).regridded({{0, {{1, 1, 0}}}}, {});

  const std::vector<PatchBox> expected = {
      {0, {{{0, 0, 0}}, {{12, 4, 1}}}},   // the row below
      {0, {{{0, 4, 0}}, {{4, 12, 1}}}},   // left of it, and above that
      {1, {{{8, 8, 0}}, {{16, 16, 1}}}},  // what is refined
      {0, {{{8, 4, 0}}, {{12, 12, 1}}}},  // right of it, and above that
      {0, {{{4, 8, 0}}, {{8, 12, 1}}}},   // above
  };
  EXPECT_EQ(patchesOf(tree, {{4, 4, 1}}, Index3::filled(everything)), expected);
}

TEST(BlockPatches, EndAtMostCellsAlongAnAxis) {
  const BlockTree tree(2, {{5, 2, 1}}, {}, 1);

  const std::vector<PatchBox> patches = patchesOf(tree, {{4, 4, 1}}, {{11, 4, 1}});
  ASSERT_EQ(patches.size(), 6U);
  EXPECT_EQ(patches[0].cells, (Box{{{0, 0, 0}}, {{8, 4, 1}}}));
  EXPECT_EQ(patches[1].cells, (Box{{{0, 4, 0}}, {{8, 8, 1}}}));
  EXPECT_EQ(patches[4].cells, (Box{{{16, 0, 0}}, {{20, 4, 1}}}));
}

}  // namespace tushar::grid
