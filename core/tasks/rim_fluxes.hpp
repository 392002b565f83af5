#pragma once

#include "core/data/warehouse.hpp"
#include "core/tasks/ghost_plan.hpp"

namespace tushar::tasks {

/// The means of the finer fluxes of `copy.from` for each face of the coarser piece that the copy fills: in pairs along
/// the first axis of the face, then along the second. `fluxes` are those of `copy.from`, one of this rank's patches.
void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to);

}  // namespace tushar::tasks
