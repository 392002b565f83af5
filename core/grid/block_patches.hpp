#pragma once

#include <vector>

#include "core/grid/block_tree.hpp"
#include "core/grid/box.hpp"

namespace tushar::grid {

/// A patch of a refined grid: a box of cells of one level.
struct PatchBox {
  int level = 0;
  Box cells;

  friend bool operator==(const PatchBox&, const PatchBox&) = default;
};

/// The cells of a block, as indices on its level. `blockCells`: cells of a block along the kernel axes. Axes beyond the
/// dimension hold the single index 0.
Box cellsOf(const BlockId& block, const Index3& blockCells, int dimension);

/// Groups blocks into patches. Along the curve, the first leaf without a patch starts a new patch. The patch grows by
/// layers of blocks along x as often as possible, then y, then z, as long as all blocks of the next layer are leaves of
/// the same level without a patch, and up to `most` cells along an axis. It grows upwards only: blocks below the first
/// leaf along an axis come earlier on the curve, so they already have a patch. No patch extends over a periodic side.
///
/// Patches are returned in the order of their first leaves on the curve. `blockCells`: cells of a block along the
/// kernel axes (1 beyond the dimension); `most` must not be smaller.
std::vector<PatchBox> patchesOf(const BlockTree& tree, const Index3& blockCells, const Index3& most);

}  // namespace tushar::grid
