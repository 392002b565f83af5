#pragma once

#include "core/data/warehouse.hpp"
#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

/// The mean flux of the finer faces of `copy.from` over each face of the coarser piece that the copy fills, one after
/// the other: in pairs along the first axis of the face, then the second. `fluxes` are those of `copy.from`, one of
/// this rank's patches.
void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to);

}  // namespace tushar::tasks
