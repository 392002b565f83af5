#pragma once

#include "components/euler/tasks/initialize.hpp"
#include "components/ice/mixture/tasks.hpp"
#include "components/mpmice/tasks/share_small_cells.hpp"

namespace tushar::mpmice {

/// Calls `visit(cell, distance squared)` for the cells around a given one until `isFound()`: first for those within 3
/// cells, then for those farther away, and if necessary for all.
template <int D, class Visit, class IsFound>
void searchAround(const Level& level, const Index<D>& cell, Visit&& visit, IsFound&& isFound) {
  int extent = 1;
  for (int d = 0; d < D; ++d) extent = std::max(extent, level.cells().extent(d));
  for (int layers = 3; !isFound(); layers *= 4) {
    forEach<D>(level.clipCells(cellsAround<D>(cell, layers)), [&](const Index<D>& other) {
      int apart = 0;
      for (int d = 0; d < D; ++d) apart += (other[d] - cell[d]) * (other[d] - cell[d]);
      visit(other, apart);
    });
    if (layers > extent) return;
  }
}

/// Whether no body is in a cell or in the cells around it. There, scenes have no reason to leave out the gas.
template <int D>
bool isAwayFromBodies(const Level& level, CellView<const double> free, const Index<D>& cell) {
  bool isAway = true;
  forEach<D>(level.clipCells(cellsAround<D>(cell, 1)),
             [&](const Index<D>& near) { isAway = isAway && free[near] > 1 - leastFreeVolume; });
  return isAway;
}

/// The initial gas of a cell with some free volume: the gas at its centre or, if there is none, at the nearest cell
/// centre that has gas, since scenes cut out the shapes of bodies. Throws InputError if no cell centre has gas, or if
/// there is none at this one, although no body is near.
template <int D>
euler::State<D> gasOf(const Level& level, const euler::Settings& settings, CellView<const double> free,
                      const Index<D>& cell) {
  const auto at = [&](const Index<D>& of) {
    return euler::stateAt<D>(level, settings, level.expandPoint<D>(level.cellCentre<D>(of)));
  };
  if (const auto own = at(cell)) return *own;
  const auto refuse = [&] { euler::refuseUncovered(settings, level.expandPoint<D>(level.cellCentre<D>(cell))); };
  if (isAwayFromBodies<D>(level, free, cell)) refuse();
  std::optional<euler::State<D>> nearest;
  int least = std::numeric_limits<int>::max();
  const auto take = [&](const Index<D>& other, int apart) {
    if (apart >= least) return;
    if (const auto state = at(other)) {
      nearest = state;
      least = apart;
    }
  };
  searchAround<D>(level, cell, take, [&] { return nearest.has_value(); });
  if (!nearest) refuse();
  return *nearest;
}

/// Fills the free part of cells with the initial gas of the scene.
template <int D>
void initialize(const Patch& patch, const Settings& settings, CellView<const double> free, CellView<double> density,
                CellView<Vec<D>> momentum, CellView<double> totalEnergy) {
  // A gas that only burning creates need not be anywhere at the start.
  if (patch.id() == 0 && !settings.burning) euler::checkObjects<D>(patch.level(), settings.gas);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    density[cell] = totalEnergy[cell] = 0;
    momentum[cell] = Vec<D>::Zero();
    if (free[cell] < leastFreeVolume) return;
    const euler::State<D> state = gasOf<D>(patch.level(), settings.gas, free, cell);
    density[cell] = free[cell] * state[euler::kDensity];
    for (int d = 0; d < D; ++d) momentum[cell][d] = free[cell] * state[euler::kVelocity(d)];
    totalEnergy[cell] = free[cell] * state[euler::kPressure<D>];
  });
}

/// The initial gases of a cell: those in it or, if there are none at its centre, at the nearest cell centre that has
/// gas, since scenes cut out the shapes of bodies. Throws InputError if no cell centre has gas, if there is none at
/// this one, although no body is near, or if the gases do not fill the cell.
template <int D>
ice::MixtureStart<D> gasesOf(const Level& level, const std::vector<euler::Settings>& gases, CellView<const double> free,
                             const Index<D>& cell) {
  const auto pointOf = [&](const Index<D>& of) { return level.expandPoint<D>(level.cellCentre<D>(of)); };
  Vec3 point = pointOf(cell);
  auto start = ice::MixtureStart<D>::in(level, gases, cell);
  int least = start.filled > 0 ? 0 : std::numeric_limits<int>::max();
  const auto take = [&](const Index<D>& other, int apart) {
    if (apart >= least) return;
    const auto there = ice::MixtureStart<D>::at(level, gases, pointOf(other));
    if (!(there.filled > 0)) return;
    start = there;
    point = pointOf(other);
    least = apart;
  };
  if (!isAwayFromBodies<D>(level, free, cell)) searchAround<D>(level, cell, take, [&] { return start.filled > 0; });
  start.check(gases, point);
  return start;
}

/// Sets the initial state of several gases.
template <int D>
void initializeGases(const Patch& patch, const Settings& settings, CellView<const double> free,
                     const NewContent<D>& fresh) {
  const Level& level = patch.level();
  const auto& held = fresh.held;
  if (patch.id() == 0)
    for (std::size_t k = 0; k < settings.gases.size(); ++k)  // what a body burns to may be nowhere yet
      if (!settings.burning || settings.burning->gas != k) euler::checkObjects<D>(level, settings.gases[k]);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const bool hasRoom = !(free[cell] < leastFreeVolume);
    const auto start = hasRoom ? gasesOf<D>(level, settings.gases, free, cell) : ice::MixtureStart<D>{.share = {1}};
    held.density[cell] = free[cell] * start.sum[euler::kDensity];
    for (int d = 0; d < D; ++d) held.momentum[cell][d] = free[cell] * start.sum[euler::kVelocity(d)];
    held.totalEnergy[cell] = free[cell] * start.sum[euler::kPressure<D>];
    for (std::size_t k = 0; k < settings.gases.size(); ++k) {
      held.masses[k][cell] = free[cell] * start.mass[k];
      held.shares[k][cell] = start.share[k];
    }
  });
}

}  // namespace tushar::mpmice
