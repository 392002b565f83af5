#include "core/tasks/ghost_plan.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tushar::tasks {

namespace {

using grid::BlockId;
using grid::Box;
using grid::Grid;
using grid::Patch;

/// Four blocks along each axis, up to 4 levels.
grid::Domain blocks(int dimension, int blockCells, bool isPeriodic) {
  grid::Domain domain;
  domain.upper = Vec3::Zero();
  domain.refinement.levels = 4;
  domain.refinement.blocksPerPatch = Index3::filled(2);
  domain.refinement.blockCells = Index3::filled(blockCells);
  for (int d = 0; d < dimension; ++d) {
    domain.upper[d] = 1;
    domain.resolution[d] = 4 * blockCells;
    domain.periodic[d] = isPeriodic;
  }
  return domain;
}

/// Refines some randomly chosen leaves.
void refineSome(Grid& grid, std::mt19937& random) {
  for (int level = 0; level + 1 < grid.levels(); ++level) {
    std::vector<BlockId> wanted;
    for (const BlockId& leaf : grid.tree().leaves()) {
      if (leaf.level > 0) wanted.push_back({leaf.level - 1, {{leaf.at[0] / 2, leaf.at[1] / 2, leaf.at[2] / 2}}});
      if (leaf.level == level && random() % 4 == 0) wanted.push_back(leaf);
    }
    grid.refine(grid.cut(grid.tree().regridded(wanted, {})));
  }
}

/// Counts how often each cell of a box is contained in other boxes.
class Cover {
 public:
  explicit Cover(const Box& all) : all_(all), counts_(all.size()) {}
  void add(const Box& part) {
    grid::forEach<3>(part, [&](const Index3& at) {
      if (all_.contains(at)) ++counts_[all_.offset(at)];
    });
  }
  /// Returns the number of cells of the box, outside a hole, that are not covered exactly once.
  int wrong(const Box& hole) const {
    int wrong = 0;
    grid::forEach<3>(all_, [&](const Index3& at) { wrong += counts_[all_.offset(at)] != (hole.contains(at) ? 0 : 1); });
    return wrong;
  }

 private:
  Box all_;
  std::vector<int> counts_;
};

/// Returns the number of ghosts, and of cells used to compute them, whose source is missing or not unique.
int wrongGhosts(const Grid& grid, int width) {
  const GhostPlan plan = planGhosts(grid, {data::Centring::cell, width});
  int wrong = 0;
  for (std::size_t place = 0; place < grid.patches().size(); ++place) {
    const Patch& patch = grid.patches()[place];
    Cover ghosts(patch.cellsWithin(width));
    std::vector<Cover> coarse;
    for (const CoarseGhosts& part : plan.coarse[place]) {
      ghosts.add(part.ghosts);
      coarse.emplace_back(part.cells);
    }
    for (const GhostCopy& copy : plan.into[place])
      (copy.coarse < 0 ? ghosts : coarse[static_cast<std::size_t>(copy.coarse)]).add(copy.box);
    wrong += ghosts.wrong(patch.cells());
    for (const Cover& part : coarse) wrong += part.wrong({});
  }
  return wrong;
}

/// Returns the sum of wrongGhosts over grids with random trees of blocks.
int wrongGhostsOfTrees(int dimension, int width, int blockCells) {
  std::mt19937 random(7);
  int wrong = 0;
  for (int tree = 0; tree < (dimension == 3 ? 2 : 20); ++tree) {
    Grid grid(blocks(dimension, blockCells, tree % 2 == 1));
    refineSome(grid, random);
    wrong += wrongGhosts(grid, width);
  }
  return wrong;
}

}  // namespace

TEST(GhostPlan, HasEachGhostOfLevelsOnceWhereBlocksHaveEnoughCells) {
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (int width = 1; width <= (dimension == 3 ? 2 : 5); ++width)
      EXPECT_EQ(wrongGhostsOfTrees(dimension, width, fewestCellsOfBlock(width)), 0) << dimension << "-D, " << width;
}

TEST(GhostPlan, LacksGhostsOfLevelsWhereBlocksHaveFewerCells) {
  EXPECT_EQ(fewestCellsOfBlock(2), 4);
  for (int width = 3; width <= 5; ++width)
    EXPECT_GT(wrongGhostsOfTrees(2, width, fewestCellsOfBlock(width) - 2), 0) << width;
}

}  // namespace tushar::tasks
