#pragma once

#include "components/euler/gas.hpp"
#include "components/euler/labels.hpp"
#include "components/euler/tasks/diagnose.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::euler {

/// Errors of density, velocity, pressure and internal energy of the cells against the exact means over them.
template <int D>
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, CellView<const double> density, CellView<const Vec<D>> momentum,
                      CellView<const double> totalEnergy, Norm& rho, Norm& u, Norm& pressure, Norm& energy) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const reference::GasState mean = reference::cellMean<D>(*exact, level, cell, clock->time);
    const double internal = internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]);
    const Vec<D> velocity = momentum[cell] / density[cell];
    rho.add(density[cell] - mean.density, mean.density);
    u.add((level.expandDirection<D>(velocity) - mean.velocity).norm(), mean.velocity.norm());
    pressure.add(gas.pressure(internal) - mean.pressure, mean.pressure);
    energy.add(internal / density[cell] - mean.energy, mean.energy);
  });
}

}  // namespace tushar::euler
