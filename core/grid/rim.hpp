#pragma once

#include <cstddef>
#include <vector>

#include "core/grid/patch.hpp"

namespace tushar::grid {

class Grid;

/// Faces between a patch and one patch of the next finer or coarser level.
struct RimPiece {
  int axis, side;     ///< axis normal to the faces; side 0: lower faces of `cells`, 1: upper faces
  Box cells;          ///< cells of the patch that have these faces
  int other;          ///< index of the patch beyond the faces
  Index3 shift;       ///< shift of the periodic image of `other` [cells of the coarser level]
  bool isFiner;       ///< whether the other level is the finer one
  std::size_t first;  ///< index of the first face among all rim faces of the patch

  /// Number of fluxes that a patch stores: one for each face and, if the other level is finer, a second one: the mean
  /// of the fluxes on the finer side of the face.
  std::size_t size() const { return cells.size() * (isFiner ? 2 : 1); }
};

/// The faces at which a patch, which may be any patch of the grid, meets other levels, ordered by axis, side and index
/// of the other patch.
std::vector<RimPiece> rimsOf(const Grid& grid, const Patch& patch);

/// Number of values that a patch stores for its rim pieces.
std::size_t sizeOf(const std::vector<RimPiece>& pieces);

}  // namespace tushar::grid
