#pragma once

#include "core/data/warehouse.hpp"
#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

/// Computes, for each face of the coarser rim piece that `copy` fills, the mean of the finer fluxes through this face:
/// first in pairs along the first axis of the face, then along the second. `fluxes` are the finer fluxes of the patch
/// `copy.from`, which is on this rank; the means are written to `to`.
void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to);

}  // namespace tushar::tasks
