#pragma once

#include "components/euler/gas.hpp"
#include "components/euler/labels.hpp"
#include "components/euler/tasks/diagnose.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::euler {

/// Computes the errors of the cells in density, velocity, pressure and internal energy, relative to the exact cell
/// means.
template <int D>
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, CellView<const double> density, CellView<const Vec<D>> momentum,
                      CellView<const double> totalEnergy, const reference::ErrorNorms& errors) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    const double internal = internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]);
    const Vec<D> velocity = momentum[cell] / density[cell];
    errors.add({.density = density[cell],
                .velocity = level.expandDirection<D>(velocity),
                .pressure = gas.pressure(density[cell], internal),
                .energy = internal / density[cell]},
               reference::cellMean<D>(*exact, level, cell, clock->time), level.weight());
  });
}

}  // namespace tushar::euler
