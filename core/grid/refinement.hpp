#pragma once

#include <optional>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// A box in space with a minimum level of refinement.
struct FineRegion {
  int level = 1;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m
};

/// How a grid may be refined: in blocks of a fixed number of cells, which are a property of the scene. Patches are
/// boxes of blocks of one level, chosen for speed alone.
struct Refinement {
  int levels = 1;                        ///< the most levels, including the coarsest
  Index3 blockCells{{8, 8, 8}};          ///< cells of a block along x, y, z
  std::optional<Index3> blocksPerPatch;  ///< the most along x, y, z; none: as suits the threads and ranks
  std::vector<FineRegion> regions;
};

}  // namespace tushar::grid
