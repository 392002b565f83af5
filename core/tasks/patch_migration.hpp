#pragma once

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// The variables that migrate with a patch: the particles of the materials, and the old values of variables.
struct MigratedVariables {
  int materials = 0;
  std::vector<int> variables;
};

/// Redistributes the patches of the grid over the ranks, each with its variables. Ghosts are left to the next exchange;
/// all other values of patches are lost. All ranks that share the grid call it, between two steps.
void migratePatches(grid::Grid& grid, data::Warehouse& warehouse, const MigratedVariables& migrated,
                    const grid::RankOffsets& offsets);

}  // namespace tushar::tasks
