#pragma once

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// The variables that migrate with a patch: the particles of the materials, and the old values of variables.
struct MigratedVariables {
  int materials = 0;
  std::vector<int> variables;
};

/// Redistributes the patches of the grid over the ranks, each with its variables. The next exchange fills the ghosts;
/// values that are not in `migrated` are lost, except reductions. All ranks that share the grid call it, between two
/// steps.
void migratePatches(grid::Grid& grid, data::Warehouse& warehouse, const MigratedVariables& migrated,
                    const grid::RankOffsets& offsets);

}  // namespace tushar::tasks
