#pragma once

#include <memory>

#include "core/grid/grid.hpp"
#include "core/tasks/patch_migration.hpp"

namespace tushar::tasks {

/// The costs of a cell and of a particle, in any unit.
struct PatchCosts {
  double ofCell = 1, ofParticle = 1;
};

/// Changes the tree of a grid of several levels, and transfers the old values of cell variables to its new patches:
/// copied where the level is the same, averaged where cells become coarser, interpolated (see prolong) where they
/// become finer. Their ghosts, one layer at least, must be there. No cell becomes more than one level finer, and k
/// levels coarser only in blocks of a multiple of 2^k cells; all other values of patches are lost. The shares of ranks
/// are as equal in costs as whole patches allow. All ranks that share the grid call it, between two steps.
void regrid(grid::Grid& grid, grid::BlockTree tree, data::Warehouse& warehouse, const MigratedVariables& variables,
            const PatchCosts& costs = {});

/// Cuts a grid of one level elsewhere, and transfers the particles and the old values of cell variables to its new
/// patches. All other values of patches are lost. All ranks that share the grid call it, between two steps.
void recut(grid::Grid& grid, std::unique_ptr<grid::Tiling> next, data::Warehouse& warehouse,
           const MigratedVariables& variables, const PatchCosts& costs = {});

}  // namespace tushar::tasks
