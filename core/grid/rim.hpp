#pragma once

#include <cstddef>
#include <vector>

#include "core/grid/patch.hpp"

namespace tushar::grid {

class Grid;

/// Faces between a patch and one patch of the next finer or coarser level.
struct RimPiece {
  int axis, side;     ///< side 0: lower faces of `cells`, 1: upper faces
  Box cells;          ///< of the patch
  int other;          ///< the patch behind
  Index3 shift;       ///< in cells of the coarser of the two levels: `other` is this image of it
  bool isFiner;       ///< whether the other level is the finer one
  std::size_t first;  ///< place of the first face among those of the patch

  /// Faces whose fluxes a patch keeps: its own and, where the other level is finer, the means of theirs behind them.
  std::size_t size() const { return cells.size() * (isFiner ? 2 : 1); }
};

/// Where a patch meets other levels: by axis, side and number of the other patch. Any patch of the grid.
std::vector<RimPiece> rimsOf(const Grid& grid, const Patch& patch);

/// Number of values that a patch keeps for its pieces.
std::size_t sizeOf(const std::vector<RimPiece>& pieces);

}  // namespace tushar::grid
