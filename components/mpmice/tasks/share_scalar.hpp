#pragma once

#include "components/mpmice/tasks/share_small_cells.hpp"

namespace tushar::mpmice {

/// The sum of a scalar, times mass, over several cells, and of their free volumes.
struct ScalarPool {
  double volume, amount;

  ScalarPool& operator+=(const ScalarPool& other) {
    volume += other.volume;
    amount += other.amount;
    return *this;
  }
  ScalarPool& operator*=(double factor) {
    volume *= factor;
    amount *= factor;
    return *this;
  }
};

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
    const auto contentOf = [&](const Index<D>& at, double part) {
      return ScalarPool{part * state.free[at], part * unshared[at]};
    };
    if (const auto [content, shares] = small.merged(cell, contentOf); shares) held[cell] = content.amount;
    if (density[cell] == 0) held[cell] = 0;
  });
}

}  // namespace tushar::mpmice
