#include "core/grid/block_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <stdexcept>

#include "core/grid/box.hpp"

namespace tushar::grid {

namespace {

using Blocks = std::vector<BlockId>;

/// A grid to refine, small enough for every block of the finest level to be checked.
struct Case {
  int dimension;
  Index3 roots, periodic;
  int levels;

  BlockTree tree() const { return {dimension, roots, periodic, levels}; }
};

const std::vector<Case> cases = {
    {1, {{5, 1, 1}}, {{0, 0, 0}}, 5}, {1, {{3, 1, 1}}, {{1, 0, 0}}, 5}, {1, {{1, 1, 1}}, {{1, 0, 0}}, 6},
    {2, {{3, 2, 1}}, {{0, 0, 0}}, 4}, {2, {{2, 3, 1}}, {{1, 0, 0}}, 5}, {2, {{1, 1, 1}}, {{1, 1, 0}}, 5},
    {3, {{2, 1, 3}}, {{0, 0, 0}}, 4}, {3, {{1, 2, 1}}, {{1, 0, 1}}, 4}, {3, {{1, 1, 1}}, {{1, 1, 1}}, 4},
};

/// Returns random blocks of any level but the last, unsorted and with possible repetitions.
Blocks chosen(const BlockTree& tree, int count, std::mt19937& random) {
  Blocks blocks;
  for (int k = 0; k < count; ++k) {
    BlockId block{static_cast<int>(random() % static_cast<unsigned>(tree.levels() - 1)), {}};
    const Index3 all = tree.blocksOf(block.level);
    for (int d = 0; d < 3; ++d) block.at[d] = static_cast<int>(random() % static_cast<unsigned>(all[d]));
    blocks.push_back(block);
  }
  return blocks;
}

/// Returns the blocks of the finest level that a block covers.
Box finestOf(const BlockTree& tree, const BlockId& block) {
  Box finest{{}, Index3::filled(1)};
  const int factor = 1 << (tree.levels() - 1 - block.level);
  for (int d = 0; d < tree.dimension(); ++d) {
    finest.lower[d] = block.at[d] * factor;
    finest.upper[d] = finest.lower[d] + factor;
  }
  return finest;
}

/// The level of the leaf at each block of the finest level; -1 where there is none, -2 where there are several.
struct Map {
  explicit Map(const BlockTree& of) : tree(of), all{{}, of.blocksOf(of.levels() - 1)}, levels(all.size(), -1) {
    for (const BlockId& leaf : tree.leaves())
      forEach<3>(finestOf(tree, leaf), [&](const Index3& at) {
        int& level = levels[all.offset(at)];
        level = level == -1 ? leaf.level : -2;
      });
  }

  /// Calls `visit(place, neighbour)` for neighbours across faces, edges and corners, periodic images included.
  template <class Visit>
  void forEachNeighbour(const Index3& periodic, Visit&& visit) const {
    forEach<3>(all, [&](const Index3& at) {
      const Box around = Box{at, at + Index3::filled(1)}.grown(1, tree.dimension());
      forEach<3>(around, [&](const Index3& beside) {
        Index3 image = beside;
        for (int d = 0; d < 3; ++d)
          if (periodic[d]) image[d] = (beside[d] + all.upper[d]) % all.upper[d];
        if (all.contains(image)) visit(at, image);
      });
    });
  }

  int at(const Index3& place) const { return levels[all.offset(place)]; }

  BlockTree tree;
  Box all;
  std::vector<int> levels;
};

BlockId blockAround(const BlockTree& tree, Index3 finest, int level) {
  for (int d = 0; d < tree.dimension(); ++d) finest[d] >>= tree.levels() - 1 - level;
  return {level, finest};
}

/// The places that must be refined, found by brute force: ancestors, then repeatedly the coarser of two leaves that
/// touch and differ by more than one level.
std::vector<int> slowLevels(const Case& grid, const Blocks& refined) {
  Map map(grid.tree());
  const auto refine = [&](const BlockId& block) {
    for (int level = 0; level <= block.level; ++level) {
      const Index3 corner = finestOf(map.tree, block).lower;
      forEach<3>(finestOf(map.tree, blockAround(map.tree, corner, level)), [&](const Index3& at) {
        int& now = map.levels[map.all.offset(at)];
        now = std::max(now, level + 1);
      });
    }
  };
  for (const BlockId& block : refined) refine(block);
  for (bool changes = true; changes;) {
    changes = false;
    map.forEachNeighbour(grid.periodic, [&](const Index3& a, const Index3& b) {
      if (map.at(a) - map.at(b) <= 1) return;
      refine(blockAround(map.tree, b, map.at(b)));
      changes = true;
    });
  }
  return map.levels;
}

/// A tree after two random sets of marks, so that there is something to coarsen.
BlockTree treeByChance(const Case& grid, std::mt19937& random) {
  const BlockTree first = grid.tree().regridded(chosen(grid.tree(), 3, random), {});
  return first.regridded(chosen(first, 1, random), chosen(first, 20, random));
}

}  // namespace

TEST(BlockTree, BeginsWithTheCoarsestBlocksAlongTheCurve) {
  const BlockTree tree(2, {{3, 2, 1}}, {}, 3);

  const std::vector<BlockId> expected = {{0, {{0, 0, 0}}}, {0, {{1, 0, 0}}}, {0, {{0, 1, 0}}},
                                         {0, {{1, 1, 0}}}, {0, {{2, 0, 0}}}, {0, {{2, 1, 0}}}};
  EXPECT_EQ(tree.leaves(), expected);
  EXPECT_EQ(tree.blocksOf(2), (Index3{{12, 8, 1}}));
}

TEST(BlockTree, RefinesABlockIntoTwoAlongEachAxis) {
  const BlockTree tree = BlockTree(2, {{2, 1, 1}}, {}, 3).regridded({{0, {{0, 0, 0}}}}, {});

  const std::vector<BlockId> expected = {
      {1, {{0, 0, 0}}}, {1, {{1, 0, 0}}}, {1, {{0, 1, 0}}}, {1, {{1, 1, 0}}}, {0, {{1, 0, 0}}}};
  EXPECT_EQ(tree.leaves(), expected);
}

TEST(BlockTree, KeepsLeavesThatTouchWithinOneLevelAndEachPlaceInOneLeaf) {
  std::mt19937 random(3);
  for (const Case& grid : cases)
    for (int trial = 0; trial < 5; ++trial) {
      const Map map(treeByChance(grid, random));

      EXPECT_GE(*std::min_element(map.levels.begin(), map.levels.end()), 0);
      int apart = 0;
      map.forEachNeighbour(grid.periodic, [&](const Index3& a, const Index3& b) {
        apart = std::max(apart, std::abs(map.at(a) - map.at(b)));
      });
      EXPECT_LE(apart, 1);
    }
}

TEST(BlockTree, RefinesOverACornerAndOverAPeriodicSide) {
  const Blocks corner = {{2, {{3, 3, 0}}}};  // its neighbour over the corner lies in another root
  const BlockTree walls = BlockTree(2, {{2, 2, 1}}, {}, 4).regridded(corner, {});
  EXPECT_EQ(walls.levelAt({0, {{1, 1, 0}}}), 1);
  EXPECT_EQ(walls.levelAt({2, {{4, 4, 0}}}), 2);

  const Blocks side = {{2, {{0, 5, 0}}}};
  EXPECT_EQ(BlockTree(2, {{3, 3, 1}}, {}, 4).regridded(side, {}).levelAt({2, {{11, 5, 0}}}), 0);
  EXPECT_EQ(BlockTree(2, {{3, 3, 1}}, {{1, 0, 0}}, 4).regridded(side, {}).levelAt({2, {{11, 5, 0}}}), 2);
}

TEST(BlockTree, RefinesNothingButWhatFollows) {
  std::mt19937 random(5);
  for (const Case& grid : cases) {
    const BlockTree before = treeByChance(grid, random);
    const Blocks wanted = chosen(before, 2, random), kept = chosen(before, 10, random);
    Blocks refined = wanted;
    for (const BlockId& block : kept)
      if (before.isRefined(block)) refined.push_back(block);

    EXPECT_EQ(Map(before.regridded(wanted, kept)).levels, slowLevels(grid, refined));
  }
}

TEST(BlockTree, StaysAsItIsWithTheSameMarks) {
  std::mt19937 random(11);
  for (const Case& grid : cases) {
    const BlockTree before = treeByChance(grid, random);
    const Blocks wanted = chosen(before, 3, random), kept = chosen(before, 20, random);
    const BlockTree once = before.regridded(wanted, kept);

    EXPECT_NE(once, before.regridded({}, {}));
    EXPECT_EQ(once.regridded(wanted, kept), once);
  }
}

TEST(BlockTree, CoarsensWhereNothingIsWantedOrKept) {
  std::mt19937 random(13);
  for (const Case& grid : cases) {
    const BlockTree tree = grid.tree().regridded(chosen(grid.tree(), 3, random), {});

    EXPECT_NE(tree, grid.tree());
    EXPECT_EQ(tree.regridded({}, {}), grid.tree());
  }
}

TEST(BlockTree, KeepsWhatIsRefinedAndRefinesNothingForIt) {
  const BlockTree coarse(2, {{2, 2, 1}}, {}, 3);
  const Blocks block = {{0, {{1, 0, 0}}}};

  EXPECT_EQ(coarse.regridded({}, block), coarse);
  EXPECT_EQ(coarse.regridded(block, {}).regridded({}, block), coarse.regridded(block, {}));
}

TEST(BlockTree, PassesOverTheLastLevelAndWhatIsOutside) {
  const BlockTree tree(2, {{2, 2, 1}}, {{1, 0, 0}}, 2);

  EXPECT_EQ(tree.regridded({{1, {{1, 1, 0}}}, {5, {{1, 1, 0}}}, {0, {{0, 2, 0}}}, {0, {{0, -1, 0}}}}, {}), tree);
  EXPECT_EQ(tree.regridded({{0, {{-1, 1, 0}}}}, {}), tree.regridded({{0, {{1, 1, 0}}}}, {}));
}

TEST(BlockTree, DependsNeitherOnTheOrderOfMarksNorOnHowOftenEachIsThere) {
  std::mt19937 random(17);
  for (const Case& grid : cases) {
    Blocks marks = chosen(grid.tree(), 5, random);
    const BlockTree tree = grid.tree().regridded(marks, {});
    for (int trial = 0; trial < 5; ++trial) {
      std::shuffle(marks.begin(), marks.end(), random);
      marks.push_back(marks.front());
      EXPECT_EQ(grid.tree().regridded(marks, {}), tree);
    }
  }
}

TEST(BlockTree, OrdersLeavesAlongTheCurveAndFindsThemThere) {
  std::mt19937 random(19);
  for (const Case& grid : cases) {
    const BlockTree tree = treeByChance(grid, random);
    const std::vector<BlockId>& leaves = tree.leaves();

    EXPECT_TRUE(std::is_sorted(leaves.begin(), leaves.end()));
    EXPECT_TRUE(std::is_sorted(tree.keys().begin(), tree.keys().end()));
    for (std::size_t place = 0; place < leaves.size(); ++place) {
      EXPECT_EQ(tree.placeOf(leaves[place]), static_cast<int>(place));
      EXPECT_EQ(tree.levelAt(leaves[place]), leaves[place].level);
      EXPECT_FALSE(tree.isRefined(leaves[place]));
    }
  }
}

TEST(BlockTree, KnowsTheLevelAtEachPlace) {
  std::mt19937 random(23);
  for (const Case& grid : cases) {
    const Map map(treeByChance(grid, random));
    for (int level = 0; level < grid.levels; ++level)
      forEach<3>({{}, map.tree.blocksOf(level)}, [&](const Index3& at) {
        const BlockId block{level, at};
        const int there = map.at(finestOf(map.tree, block).lower);
        EXPECT_EQ(map.tree.levelAt(block), std::min(there, level + 1));
        EXPECT_EQ(map.tree.isRefined(block), there > level);
      });
  }
}

TEST(BlockTree, CountsImagesAlongPeriodicAxesOnly) {
  const BlockTree tree = BlockTree(2, {{3, 2, 1}}, {{1, 0, 0}}, 3).regridded({{0, {{2, 1, 0}}}}, {});

  EXPECT_EQ(tree.levelAt({0, {{-1, 1, 0}}}), 1);
  EXPECT_EQ(tree.levelAt({0, {{-7, 0, 0}}}), 0);
  EXPECT_TRUE(tree.isRefined({0, {{5, 1, 0}}}));
  EXPECT_EQ(tree.levelAt({0, {{2, 2, 0}}}), -1);
  EXPECT_EQ(tree.levelAt({0, {{2, -1, 0}}}), -1);
  EXPECT_EQ(tree.levelAt({0, {{2, 1, 1}}}), -1);
  EXPECT_FALSE(tree.isRefined({0, {{2, 2, 0}}}));
}

TEST(BlockTree, ComesBackFromItsKeys) {
  std::mt19937 random(29);
  for (const Case& grid : cases) {
    const BlockTree tree = treeByChance(grid, random);

    EXPECT_EQ(BlockTree::fromKeys(grid.dimension, grid.roots, grid.periodic, grid.levels, tree.keys()), tree);
  }
}

TEST(BlockTree, RefusesKeysThatAreNotItsLeaves) {
  std::mt19937 random(31);
  for (const Case& grid : cases) {
    const std::vector<std::uint64_t> good = grid.tree().regridded(chosen(grid.tree(), 3, random), {}).keys();
    const auto isRefused = [&](const std::vector<std::uint64_t>& keys) {
      try {
        BlockTree::fromKeys(grid.dimension, grid.roots, grid.periodic, grid.levels, keys);
        return false;
      } catch (const std::invalid_argument&) {
        return true;
      }
    };
    EXPECT_TRUE(isRefused({}));
    for (std::size_t place = 0; place < good.size(); ++place) {
      auto gap = good, twice = good, otherLevel = good, outside = good;
      gap.erase(gap.begin() + static_cast<std::ptrdiff_t>(place));
      twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(place), good[place]);
      otherLevel[place] ^= 1;
      outside[place] |= std::uint64_t{1} << 62;
      EXPECT_TRUE(isRefused(gap) && isRefused(twice) && isRefused(otherLevel) && isRefused(outside)) << place;
    }
    auto unsorted = good;
    std::swap(unsorted.front(), unsorted.back());
    EXPECT_TRUE(isRefused(unsorted));
  }
}

TEST(BlockTree, RefusesKeysOfLeavesTooFarApart) {
  const auto leaves = BlockTree(1, {{2, 1, 1}}, {}, 3).regridded({{1, {{0, 0, 0}}}}, {}).keys();

  EXPECT_NO_THROW(BlockTree::fromKeys(1, {{2, 1, 1}}, {}, 3, leaves));
  EXPECT_THROW(BlockTree::fromKeys(1, {{2, 1, 1}}, {{1, 0, 0}}, 3, leaves), std::invalid_argument);
}

TEST(BlockTree, HoldsUpToAMillionBlocksAlongAnAxis) {
  EXPECT_NO_THROW(BlockTree(3, {{32, 1, 32}}, {}, 16));
  EXPECT_THROW(BlockTree(3, {{1, 33, 1}}, {}, 16), std::invalid_argument);
  EXPECT_THROW(BlockTree(1, {{1, 1, 1}}, {}, 17), std::invalid_argument);
  EXPECT_THROW(BlockTree(1, {{1, 1, 1}}, {}, 0), std::invalid_argument);
  EXPECT_THROW(BlockTree(1, {{4, 2, 1}}, {}, 2), std::invalid_argument);
  EXPECT_THROW(BlockTree(2, {{4, 0, 1}}, {}, 2), std::invalid_argument);
  EXPECT_THROW(BlockTree(4, {{1, 1, 1}}, {}, 2), std::invalid_argument);

  const BlockTree most(3, {{32, 32, 32}}, {}, 16);
  const BlockTree refined = most.regridded({{14, {{(1 << 19) - 1, (1 << 19) - 1, (1 << 19) - 1}}}}, {});
  const int last = (1 << 20) - 1;
  EXPECT_EQ(refined.leaves().back(), (BlockId{15, {{last, last, last}}}));
  EXPECT_EQ(BlockTree::fromKeys(3, {{32, 32, 32}}, {}, 16, refined.keys()), refined);
}

TEST(BlockId, IsOrderedDepthFirstAlsoOutsideTheGrid) {
  const std::vector<BlockId> curve = {
      {0, {{-1, -1, 0}}}, {1, {{-1, -1, 0}}}, {0, {{0, 0, 0}}}, {1, {{0, 0, 0}}}, {2, {{0, 0, 0}}},
      {2, {{1, 0, 0}}},   {2, {{0, 1, 0}}},   {1, {{1, 0, 0}}}, {1, {{0, 1, 0}}}, {1, {{0, 0, 1}}},
      {0, {{1, 0, 0}}},   {0, {{0, 1, 0}}},   {0, {{0, 0, 1}}}, {0, {{2, 0, 0}}}, {1, {{4, 0, 0}}},
  };
  for (std::size_t a = 0; a < curve.size(); ++a)
    for (std::size_t b = 0; b < curve.size(); ++b) EXPECT_EQ(curve[a] < curve[b], a < b) << a << ' ' << b;
}

}  // namespace tushar::grid
