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

/// Groups blocks into patches: along the curve, the first leaf without a patch begins one. It grows by layers of blocks
/// along x, as often as it can, then y, then z, while all blocks in the layer beside it are leaves of its level without
/// a patch, up to `most` cells along an axis. It grows upwards only: what lies below the first leaf along an axis comes
/// before it on the curve, so it has a patch already. No patch reaches over a periodic side.
///
/// In the order of their first leaves on the curve. `blockCells`: cells of a block along the kernel axes (1 beyond the
/// dimension); `most`: no less than those.
std::vector<PatchBox> patchesOf(const BlockTree& tree, const Index3& blockCells, const Index3& most);

}  // namespace tushar::grid
