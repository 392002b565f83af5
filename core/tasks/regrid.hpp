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
/// copied on the same level, averaged where cells become coarser, and interpolated (see prolong) where they become
/// finer. At least one layer of ghosts must be valid. No cell may become more than one level finer. A cell may become k
/// levels coarser only if the cells of a block along each axis are a multiple of 2^k. All other values of patches are
/// lost. The costs of ranks are as equal as whole patches allow. All ranks of the grid call it, between two steps.
void regrid(grid::Grid& grid, grid::BlockTree tree, data::Warehouse& warehouse, const MigratedVariables& variables,
            const PatchCosts& costs = {});

/// Moves the cuts of a grid of one level, and transfers the particles and the old values of cell variables to the new
/// patches. All other values of patches are lost. All ranks that share the grid call it, between two steps.
void recut(grid::Grid& grid, std::unique_ptr<grid::Tiling> next, data::Warehouse& warehouse,
           const MigratedVariables& variables, const PatchCosts& costs = {});

}  // namespace tushar::tasks
