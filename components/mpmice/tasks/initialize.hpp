#pragma once

#include "components/euler/tasks/initialize.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// What the gas of a scene fills: the free part of cells.
template <int D>
void fillFreeSpace(const Patch& patch, CellView<const double> free, CellView<double> density, CellView<Vec<D>> momentum,
                   CellView<double> totalEnergy) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double room = free[cell] < leastFreeVolume ? 0 : free[cell];
    density[cell] *= room;
    momentum[cell] *= room;
    totalEnergy[cell] *= room;
  });
}

}  // namespace tushar::mpmice
