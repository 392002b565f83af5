#pragma once

#include "components/euler/tasks/add_gravity.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Accelerates the gas by gravity [m/s²], except in closed holes of bodies.
template <int D>
void addGravity(const Patch& patch, const Vec3& gravity, CellView<const double> free, CellView<const double> density,
                double dt, CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  const Vec<D> g = patch.level().template reduce<D>(gravity);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (free[cell] >= leastFreeVolume) euler::fall<D>(g, density[cell], dt, momentum[cell], totalEnergy[cell]);
  });
}

}  // namespace tushar::mpmice
