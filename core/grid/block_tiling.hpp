#pragma once

#include "core/grid/block_patches.hpp"
#include "core/grid/block_tree.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// The blocks of a level that contain cells of a box; the box must lie on the grid.
Box blocksOver(const Box& cells, const Index3& blockCells);

/// The patches of a grid of several levels: boxes of leaves of a block tree. Each rank stores all of them.
class BlockTiling : public Tiling {
 public:
  /// Divides blocks of `blockCells` cells along the kernel axes into patches of up to `most` cells along each axis.
  BlockTiling(BlockTree tree, const Index3& blockCells, const Index3& most);

  const BlockTree& tree() const { return tree_; }
  const Index3& blockCells() const { return block_cells_; }

  int count() const override { return static_cast<int>(patches_.size()); }
  Tile tile(int id) const override;
  Tile tileOf(int level, const Index3& cell) const override;
  std::vector<Tile> overlapping(int level, const Box& cells) const override;
  std::uint64_t cells() const override { return cells_before_.back(); }
  std::uint64_t cellsBefore(int id) const override { return cells_before_[id]; }
  int patchAfter(std::uint64_t cells) const override;

 private:
  /// The patch of a block, or -1 if the block is not a leaf.
  int patchOf(const BlockId& block) const;

  BlockTree tree_;
  Index3 block_cells_;
  std::vector<PatchBox> patches_;
  std::vector<int> patch_of_leaf_;                ///< index: position of the leaf on the curve
  std::vector<std::vector<int>> patch_of_block_;  ///< indices: level and block, x fastest; may be empty, see tablesOf
  std::vector<std::uint64_t> cells_before_;       ///< number of cells before each patch; the last element is the total
};

}  // namespace tushar::grid
