#pragma once

#include "components/mpmice/tasks/small_cells.hpp"

namespace tushar::mpmice {

/// Views of the new content of cells: after a step, or at the start of the run.
template <int D>
struct NewContent {
  euler::MixtureViews<D, double> held;

  static NewContent from(auto& take, std::size_t gases) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, gases, [&](std::size_t k) { return computes(labels[k]); });
    };
    return {{{take(computes(c::density)), take(computes(c::momentum<D>)), take(computes(c::totalEnergy))},
             ofEach(c::massOfGas),
             ofEach(c::shareOfGas)}};
  }
};
/// Views of the state after a step.
template <int D>
struct NewGas {
  euler::MixtureViews<D, double> held;
  CellView<double> free;

  static NewGas from(auto& take, std::size_t gases) {
    NewContent<D> content = NewContent<D>::from(take, gases);
    return {.held = std::move(content.held), .free = take(computes(c::freeVolume))};
  }
};

/// The density of a mixture over that of one of its gases above which the volume of this gas is round-off.
inline constexpr double greatestRarity = 1e8;

/// The sum of the contents of several cells, and of their free volumes.
template <int D>
struct Pool {
  double volume = 0, mass = 0, energy = 0;
  Vec<D> momentum = Vec<D>::Zero();
  std::size_t gases = 0;                                  ///< number of gases, if there are several
  std::array<double, euler::kMostGases> masses, volumes;  ///< mass and volume of each of them

  /// A part of the content of a cell.
  Pool(const Unshared<D>& state, const Index<D>& cell, double part)
      : volume(part * state.free[cell]),
        mass(part * state.held.density[cell]),
        energy(part * state.held.totalEnergy[cell]),
        momentum(part * state.held.momentum[cell]),
        gases(state.held.masses.size()) {
    for (std::size_t k = 0; k < gases; ++k) {
      masses[k] = part * state.held.masses[k][cell];
      volumes[k] = part * state.held.shares[k][cell];
    }
  }
  Pool& operator+=(const Pool& other) {
    volume += other.volume;
    mass += other.mass;
    energy += other.energy;
    momentum += other.momentum;
    for (std::size_t k = 0; k < gases; ++k) {
      masses[k] += other.masses[k];
      volumes[k] += other.volumes[k];
    }
    return *this;
  }
  Pool& operator*=(double factor) {
    volume *= factor;
    mass *= factor;
    energy *= factor;
    momentum *= factor;
    for (std::size_t k = 0; k < gases; ++k) {
      masses[k] *= factor;
      volumes[k] *= factor;
    }
    return *this;
  }
  /// Sets the volume fractions of several gases; in cells without gas, that of the first gas is 1. No fraction outlives
  /// its mass: where bodies close a cell, volumes are round-off, of which a gas that is not there must get no part.
  void setShares(const Index<D>& cell, const euler::MixtureViews<D, double>& fresh) const {
    if (gases == 0) return;
    double sum = 0;
    for (std::size_t k = 0; k < gases; ++k) sum += std::max(0.0, volumes[k]);
    double rest = sum > 0 ? 0 : 1;  // what no gas has
    std::size_t heaviest = 0;
    for (std::size_t k = 0; k < gases; ++k) {
      const double share = sum > 0 ? std::max(0.0, volumes[k]) / sum : 0;
      const double most = mass > 0 ? greatestRarity * std::max(0.0, masses[k]) / mass : 1;
      fresh.shares[k][cell] = std::min(share, most);
      if (share > most) rest += share - most;
      if (masses[k] > masses[heaviest]) heaviest = k;
    }
    if (rest > 0) fresh.shares[heaviest][cell] += rest;
  }
};

/// Gives a cell its share of the content of the cells with which it is merged. Returns the largest free volume of the
/// cells through which it shares: its own if it is merged with none.
template <int D>
double shareAt(const SmallCells<D>& small, const Unshared<D>& state, const Index<D>& cell,
               const euler::MixtureViews<D, double>& fresh) {
  const auto contentOf = [&](const Index<D>& at, double part) { return Pool<D>(state, at, part); };
  const auto [content, shares] = small.merged(cell, contentOf);
  if (shares || state.free[cell] < 1) content.setShares(cell, fresh);
  double room = 0;
  small.forEachTarget(cell, [&](const Index<D>& at, double) { room = std::max(room, state.free[at]); });
  if (!shares) return room;
  fresh.density[cell] = content.mass;
  fresh.momentum[cell] = content.momentum;
  fresh.totalEnergy[cell] = content.energy;
  for (std::size_t k = 0; k < fresh.masses.size(); ++k) fresh.masses[k][cell] = content.masses[k];
  return room;
}

/// Checks the content of a cell after a step. Throws NumericalError if it is impossible, so that the step is repeated
/// with a smaller time step.
template <int D>
void checkGas(const Level& level, const euler::Gas& gas, const Index<D>& cell, const NewGas<D>& fresh) {
  const double free = fresh.free[cell], mass = fresh.held.density[cell];
  if (mass == 0 && fresh.held.totalEnergy[cell] == 0) return;
  const double internal = euler::internalEnergyIn<D>(fresh.held, cell);
  if (free < leastFreeVolume && mass > 0 && (internal >= 0 || gas.law)) return;
  const double density = mass / free, last = gas.last(density, internal / free), stiff = gas.heat(density, last);
  if (density > 0 && stiff > 0 && std::isfinite(stiff)) return;
  if (free < leastFreeVolume) refuseHole<D>(level, cell, mass, internal);
  refuseGas<D>(level, gas, cell, free, density, last);
}

/// The mass per cell volume below which a mass counts as 0 [kg/m³]. Without it, the content of a hole could be halved
/// without end.
inline constexpr double nothingLeft = 1e-100;

/// The energy per cell volume below which the energy of a cell without mass counts as 0 [J/m³].
inline constexpr double noEnergyLeft = 1e-60;

/// The fraction of the content of a cell next to a hole below which a negative content of the hole is round-off.
inline constexpr double roundOffOfHoles = 1e-18;

/// Whether the mass of a hole is negative, but negligible compared with the gas next to it, like its energy.
template <int D>
bool isRoundOff(const SmallCells<D>& small, const Unshared<D>& state, const Index<D>& cell, double mass,
                double energy) {
  if (!(mass < 0) || !(state.free[cell] < leastFreeVolume)) return false;
  double mostMass = 0, mostEnergy = 0;
  small.forEachAround(cell, [&](const Index<D>& at) {
    mostMass = std::max(mostMass, state.held.density[at]);
    mostEnergy = std::max(mostEnergy, std::abs(state.held.totalEnergy[at]));
  });
  return -mass <= roundOffOfHoles * mostMass && std::abs(energy) <= roundOffOfHoles * mostEnergy;
}

/// Empties a cell in which almost nothing is left. A cell without mass that has energy keeps it; checkGas refuses it.
template <int D>
void emptyIfNothingLeft(const SmallCells<D>& small, const Unshared<D>& state, const Index<D>& cell,
                        const euler::MixtureViews<D, double>& held) {
  const double mass = held.density[cell], energy = held.totalEnergy[cell];
  const bool isEmpty = std::abs(mass) < nothingLeft && std::abs(energy) < noEnergyLeft;
  if (!isEmpty && !isRoundOff(small, state, cell, mass, energy)) return;
  held.density[cell] = held.totalEnergy[cell] = 0;
  held.momentum[cell] = Vec<D>::Zero();
  for (const auto& ofGas : held.masses) ofGas[cell] = 0;
}

/// References to the totals of shareSmallCells: the number of merged cells, and the smallest free volume with gas.
struct SmallCellTotals {
  Sum& merged;
  Minimum& leastFree;

  static SmallCellTotals from(auto& take) {
    return {.merged = take(computes(total::mergedCells)), .leastFree = take(computes(total::leastFreeVolume))};
  }
};

/// Copies the state of a patch before small cells are merged. Narrow holes get the free volume 0.
template <int D>
void copyUnshared(const Patch& patch, const Unshared<D>& state, const NewGas<D>& fresh) {
  forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
    const auto copy = [&](const auto& from, const auto& to) {
      std::copy_n(euler::rowOf(from, first, count), count, euler::rowOf(to, first, count));
    };
    for (std::size_t k = 0; k < fresh.held.masses.size(); ++k) {
      copy(state.held.masses[k], fresh.held.masses[k]);
      copy(state.held.shares[k], fresh.held.shares[k]);
    }
    copy(state.held.density, fresh.held.density);
    copy(state.held.momentum, fresh.held.momentum);
    copy(state.held.totalEnergy, fresh.held.totalEnergy);
    const double* free = euler::rowOf(state.free, first, count);
    double* open = euler::rowOf(fresh.free, first, count);
    for (int i = 0; i < count; ++i) open[i] = free[i] < narrowFreeVolume ? 0 : free[i];
  });
}

/// Marks the cells of a patch near bodies that have something to give, or can receive something when small cells are
/// merged.
template <int D>
CellMarks<D> markBusy(const Patch& patch, const NearBodies<D>& near, const Unshared<D>& state) {
  CellMarks<D> marks(patch.cells());
  forEachRow<D>(near.rows().intersect(patch.cells()), [&](const Index<D>& first, int count) {
    std::uint8_t* row = marks.row(first);
    const std::uint8_t* isNear = near.row(first);
    const double *free = &state.free[first], *mass = &state.held.density[first];
    const double *energy = &state.held.totalEnergy[first], *momentum = state.held.momentum[first].data();
    const std::uint8_t all = state.held.shares.empty() ? 0 : 1;
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
      bool any = (mass[i] != 0) | !(free[i] < smallFreeVolume) | (energy[i] != 0);
      for (int d = 0; d < D; ++d) any |= momentum[i * D + d] != 0;
      row[i] = static_cast<std::uint8_t>(isNear[i] & (all | any));
    }
  });
  return marks;
}

/// Computes the state after a step by merging small cells with neighbours.
template <int D>
void shareSmallCells(const Patch& patch, const Settings& settings, const Unshared<D>& state, const NewGas<D>& fresh,
                     const SmallCellTotals& totals) {
  const Level& level = patch.level();
  copyUnshared<D>(patch, state, fresh);
  // At the rim of a level, the flux of volume has been corrected.
  if (level.domain().refinement.levels > 1 && !fresh.held.shares.empty() && !areBlended(settings))
    euler::closeShares<D>(patch, settings.gases, fresh.held.shares);
  const NearBodies<D> near(patch.cells(), shareReach, state.free, state.held.density);
  SmallCells<D> small(level, settings.thinWalls, state);
  // Only small cells and the cells around them exchange anything.
  CellMarks<D> exchanging = small.findChoices(near, level.clipCells(patch.cells().grown(2, D)));
  exchanging.spread(1, near.rows().intersect(exchanging.box()));
  const CellMarks<D> busy = markBusy<D>(patch, near, state);
  busy.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    if (exchanging(cell)) {
      const double room = shareAt<D>(small, state, cell, fresh.held);
      // A full cell may have a mass of round-off, and give it away.
      if (room > state.free[cell] && !(state.free[cell] < leastFreeVolume)) totals.merged.add(1);
      // A hole keeps its contents until there is room.
      fresh.free[cell] = room < narrowFreeVolume ? 0 : state.free[cell];
    } else if (state.free[cell] < 1 && !fresh.held.shares.empty()) {
      Pool<D>(state, cell, 1).setShares(cell, fresh.held);
    }
    emptyIfNothingLeft<D>(small, state, cell, fresh.held);
  });
  totals.leastFree.add(1);
  busy.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    const double free = fresh.free[cell];
    checkGas<D>(level, lawAt<D>(settings, fresh.held, free, cell), cell, fresh);
    if (!(free < leastFreeVolume) && fresh.held.density[cell] > 0) totals.leastFree.add(free);
  });
}

}  // namespace tushar::mpmice
