#pragma once

#include "components/euler/tasks/initialize.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// How far, in cells, a cell that bodies fill in part looks for a gas where its middle has none.
inline constexpr int gasNearby = 3;

/// The gas of a cell with some room: that at its centre or, as scenes leave out the bodies' shapes, at the nearest
/// centre of a cell that has one. Throws InputError if there is none.
template <int D>
euler::State<D> gasOf(const Level& level, const euler::Settings& settings, const Index<D>& cell) {
  const auto at = [&](const Index<D>& of) {
    return euler::stateAt<D>(level, settings, level.expandPoint<D>(level.cellCentre<D>(of)));
  };
  if (const auto own = at(cell)) return *own;
  std::optional<euler::State<D>> nearest;
  int least = std::numeric_limits<int>::max();
  forEach<D>(level.clipCells(cellsAround<D>(cell, gasNearby)), [&](const Index<D>& other) {
    int apart = 0;
    for (int d = 0; d < D; ++d) apart += (other[d] - cell[d]) * (other[d] - cell[d]);
    if (apart >= least) return;
    if (const auto state = at(other)) {
      nearest = state;
      least = apart;
    }
  });
  if (!nearest) euler::refuseUncovered(settings, level.expandPoint<D>(level.cellCentre<D>(cell)));
  return *nearest;
}

/// The gas of a scene in the free part of cells.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<const double> free, CellView<double> density,
                CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  if (patch.id() == 0) euler::checkObjects<D>(patch.level(), settings.gas);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    density[cell] = totalEnergy[cell] = 0;
    momentum[cell] = Vec<D>::Zero();
    if (free[cell] < leastFreeVolume) return;
    const euler::State<D> state = gasOf<D>(patch.level(), settings.gas, cell);
    density[cell] = free[cell] * state[euler::kDensity];
    for (int d = 0; d < D; ++d) momentum[cell][d] = free[cell] * state[euler::kVelocity(d)];
    totalEnergy[cell] = free[cell] * state[euler::kPressure<D>];
  });
}

}  // namespace tushar::mpmice
