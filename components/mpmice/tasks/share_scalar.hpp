#pragma once

#include "components/mpmice/tasks/share_small_cells.hpp"

namespace tushar::mpmice {

/// Computes a scalar after a step, times the mass per cell volume. Where small cells are merged with neighbours, this
/// product is distributed in the same way as the mass. `density` is the density after merging.
template <int D>
void shareScalar(const Patch& patch, const Settings& settings, const Unshared<D>& state,
                 CellView<const double> unshared, CellView<const double> density, CellView<double> held) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { held[cell] = unshared[cell]; });
  const NearBodies<D> near(patch.cells(), shareReach, state.free, state.held.density);
  SmallCells<D> small(patch.level(), settings.thinWalls, state);
  small.findChoices(near, patch.level().clipCells(patch.cells().grown(2, D)));
  near.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    const Index<D> centre = small.targetOf(cell);
    double volume = 0, sum = 0;
    const bool shares = small.forEachInPool(cell, centre, [&](const Index<D>& at) {
      volume += state.free[at];
      sum += unshared[at];
    });
    if (shares && volume > 0) held[cell] = sum * (state.free[cell] / volume);
    if (density[cell] == 0) held[cell] = 0;
  });
}

}  // namespace tushar::mpmice
