#pragma once

#include <optional>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// A box in space with a minimum level of refinement.
struct FineRegion {
  int level = 1;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< lower and upper corner [m]
};

/// How a grid may be refined: its levels, and the number of cells in each of its blocks. The scene determines both.
/// Patches are boxes of blocks of one level, chosen for speed alone.
struct Refinement {
  int levels = 1;                ///< largest number of levels, including the coarsest
  Index3 blockCells{{8, 8, 8}};  ///< number of cells of a block along x, y, z
  /// Largest number of blocks in a patch along x, y, z; if not given, patches have at most 256 cells, 64 x 64, or 32 x
  /// 32 x 32, by dimension (see Grid).
  std::optional<Index3> blocksPerPatch;
  std::vector<FineRegion> regions;
};

}  // namespace tushar::grid
