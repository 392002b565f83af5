#pragma once

#include "components/mpmice/free_space.hpp"
#include "components/mpmice/near_bodies.hpp"

namespace tushar::mpmice {

/// Number of layers of cells around a patch that determine with which neighbours the cells of the patch are merged, and
/// what they exchange.
inline constexpr int shareReach = 3;

/// Views of the state after a step and the free volume, before small cells are merged.
template <int D>
struct Unshared {
  euler::MixtureViews<D, const double> held;  ///< for several gases, the volumes in place of the volume fractions
  CellView<const double> free;
  CellView<const Vec<D>> coverage;

  static Unshared from(auto& take, std::size_t gases) {
    const auto ofEach = [&](const auto& labels) {
      return viewsOfGases(take, gases, [&](std::size_t k) { return requiresNew(labels[k], 2); });
    };
    return {.held = {{take(requiresNew(c::unsharedDensity, shareReach)), take(requiresNew(c::unsharedMomentum<D>, 2)),
                      take(requiresNew(c::unsharedEnergy, 2))},
                     ofEach(c::unsharedMass),
                     ofEach(c::unsharedVolume)},
            .free = take(requiresNew(c::unfilledVolume, shareReach)),
            .coverage = take(requiresNew(c::coverage<D>, shareReach))};
  }
};

/// The rule by which cells are merged. A cell with little free volume gives its content to the neighbour with the
/// widest opening to it, possibly across a corner, and gets back a part in proportion to its volume. So small cells do
/// not limit the time step, and cells may appear and vanish.
template <int D>
class SmallCells {
 public:
  SmallCells(const Level& level, bool thinWalls, const Unshared<D>& state)
      : level_(level), thin_walls_(thinWalls), state_(state) {}

  /// Finds the choices of the small cells of a box, so that they need not be found again and again; all small cells are
  /// near bodies. Returns the marks of these cells.
  CellMarks<D> findChoices(const NearBodies<D>& near, const Box& box) {
    CellMarks<D> marks(box);
    const Box rows = box.intersect(near.rows());
    forEachRow<D>(rows, [&](const Index<D>& first, int count) {
      std::uint8_t* row = marks.row(first);
      const double *free = &state_.free[first], *mass = &state_.held.density[first];
      const double* energy = &state_.held.totalEnergy[first];
#pragma GCC ivdep
      for (int i = 0; i < count; ++i)
        row[i] = static_cast<std::uint8_t>((free[i] < smallFreeVolume) & ((mass[i] != 0) | (energy[i] != 0)));
    });
    known_ = box;
    choices_.resize(box.size());
    marks.forEachIn(rows, [&](const Index<D>& cell) {
      const Index<D> best = choiceOfSmall(cell);
      int code = 0;
      for (int d = D - 1; d >= 0; --d) code = 3 * code + best[d] - cell[d] + 1;
      choices_[offsetIn<D>(box, cell)] = static_cast<std::uint8_t>(code);
    });
    return marks;
  }

  /// The neighbour that receives the gas of a small cell: one with enough free volume, otherwise one that has more free
  /// volume than the cell and does not give away its own gas. If there is none, it is the cell itself.
  Index<D> targetOf(const Index<D>& cell) const {
    const Index<D> chosen = choiceOf(cell);
    return isTarget(chosen) ? chosen : cell;
  }
  /// Whether a cell may receive gas from others, because it keeps its own gas.
  bool isTarget(const Index<D>& cell) const { return choiceOf(cell) == cell; }
  /// Whether a small cell gives its gas to a given neighbour that may receive it.
  bool gives(const Index<D>& cell, const Index<D>& to) const { return isSmall(cell) && choiceOf(cell) == to; }
  /// Whether a cell has little free volume, and some content: where a wall closes a cell, the work of the wall may
  /// remain without the gas.
  bool isSmall(const Index<D>& cell) const {
    return state_.free[cell] < smallFreeVolume &&
           (state_.held.density[cell] != 0 || state_.held.totalEnergy[cell] != 0);
  }

  /// Calls `visit(neighbour)` for the surrounding cells that are on the grid.
  template <class Visit>
  void forEachAround(const Index<D>& cell, Visit&& visit) const {
    forEach<D>(level_.clipCells(cellsAround<D>(cell, 1)), [&](const Index<D>& at) {
      if (!(at == cell)) visit(at);
    });
  }

  /// Calls `visit(member)` for the cells that share their content through the target `centre`, which comes first.
  /// Returns whether `cell`, whose target this is, shares with others.
  template <class Visit>
  bool forEachInPool(const Index<D>& cell, const Index<D>& centre, Visit&& visit) const {
    visit(centre);
    bool shares = !(centre == cell);
    if (isTarget(centre))
      forEachAround(centre, [&](const Index<D>& at) {
        if (!gives(at, centre)) return;
        visit(at);
        shares = true;
      });
    return shares;
  }

 private:
  Index<D> choiceOf(const Index<D>& cell) const {
    if (!isSmall(cell)) return cell;
    if (!known_.contains(cell)) return choiceOfSmall(cell);
    int code = choices_[offsetIn<D>(known_, cell)];
    Index<D> chosen = cell;
    for (int d = 0; d < D; ++d, code /= 3) chosen[d] += code % 3 - 1;
    return chosen;
  }
  Index<D> choiceOfSmall(const Index<D>& cell) const {
    Index<D> best = cell;
    double most = -1;
    forEachAround(cell, [&](const Index<D>& at) {
      const double score = scoreOf(cell, at);
      const bool isLevel = score >= 0 && std::abs(score - most) <= offRoundShares;
      if (isLevel ? comesFirst(at, best, cell) : score > most) best = at;
      most = std::max(most, score);
    });
    return best;
  }
  /// Whether a neighbour of a cell is preferred to another one that is equally suitable, so that mirrored cells prefer
  /// mirrored neighbours: the one that is apart from the cell along the first axis, otherwise along the next one. Of
  /// two neighbours on opposite sides, it is the lower one.
  static bool comesFirst(const Index<D>& at, const Index<D>& other, const Index<D>& cell) {
    for (int d = 0; d < D; ++d)
      if ((at[d] == cell[d]) != (other[d] == cell[d])) return other[d] == cell[d];
    return false;
  }
  /// The score of a neighbour with more free volume, by more than round-off; -1 for others. Neighbours that are not
  /// small have the highest scores.
  double scoreOf(const Index<D>& cell, const Index<D>& at) const {
    const double room = state_.free[at], own = state_.free[cell];
    if (!(room > own + offRoundShares) || room < leastFreeVolume) return -1;
    if (room < smallFreeVolume && state_.held.density[at] == 0) return -1;  // an empty hole
    double score = room >= smallFreeVolume ? 100 : 0;
    int apart = 0, axis = 0;
    for (int d = 0; d < D; ++d)
      if (at[d] != cell[d]) {
        ++apart;
        axis = d;
      }
    if (apart > 1) return score + 1e-4 * room;
    const Index<D>& above = at[axis] > cell[axis] ? at : cell;
    const double open = openShare(state_.coverage[above][axis], room, own, thin_walls_);
    return score + 2 * open + 1e-2 * std::max(0.0, 1 - (1 - own) - (1 - room)) + 1e-3 * room;
  }

  const Level& level_;
  bool thin_walls_;
  const Unshared<D>& state_;
  Box known_;  ///< the cells for which findChoices was called
  /// The places of the neighbours that the small ones of these cells chose, in base 3.
  std::vector<std::uint8_t, euler::Unfilled<std::uint8_t>> choices_;
};

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

/// The sum of the contents of several cells, and of their free volumes.
template <int D>
struct Pool {
  double volume = 0, mass = 0, energy = 0;
  Vec<D> momentum = Vec<D>::Zero();
  std::array<double, euler::kMostGases> masses{}, volumes{};  ///< mass and volume of each of several gases

  void add(const Unshared<D>& state, const Index<D>& cell) {
    volume += state.free[cell];
    mass += state.held.density[cell];
    momentum += state.held.momentum[cell];
    energy += state.held.totalEnergy[cell];
    for (std::size_t k = 0; k < state.held.masses.size(); ++k) {
      masses[k] += state.held.masses[k][cell];
      volumes[k] += state.held.shares[k][cell];
    }
  }
  /// Sets the volume fractions of several gases; in cells without gas, that of the first gas is 1.
  void setShares(const Index<D>& cell, const euler::MixtureViews<D, double>& fresh) const {
    double sum = 0;
    for (const double of : volumes) sum += std::max(0.0, of);
    for (std::size_t k = 0; k < fresh.shares.size(); ++k)
      fresh.shares[k][cell] = sum > 0 ? std::max(0.0, volumes[k]) / sum : k == 0 ? 1.0 : 0.0;
  }
};

/// Gives a cell its share of the content of the cells that are merged with the cell `centre`.
template <int D>
void shareAt(const SmallCells<D>& small, const Unshared<D>& state, const Index<D>& cell, const Index<D>& centre,
             const euler::MixtureViews<D, double>& fresh) {
  Pool<D> pool;
  const bool shares = small.forEachInPool(cell, centre, [&](const Index<D>& at) { pool.add(state, at); });
  if (shares || state.free[cell] < 1) pool.setShares(cell, fresh);
  if (!shares || !(pool.volume > 0)) return;
  const double part = state.free[cell] / pool.volume;
  fresh.density[cell] = pool.mass * part;
  fresh.momentum[cell] = pool.momentum * part;
  fresh.totalEnergy[cell] = pool.energy * part;
  for (std::size_t k = 0; k < fresh.masses.size(); ++k) fresh.masses[k][cell] = pool.masses[k] * part;
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
      const Index<D> centre = small.targetOf(cell);
      // A full cell may have a mass of round-off, and give it away.
      if (!(centre == cell) && !(state.free[cell] < leastFreeVolume)) totals.merged.add(1);
      shareAt<D>(small, state, cell, centre, fresh.held);
      // A hole keeps its contents until there is room.
      fresh.free[cell] = state.free[centre] < narrowFreeVolume ? 0 : state.free[cell];
    } else if (state.free[cell] < 1 && !fresh.held.shares.empty()) {
      Pool<D> own;
      own.add(state, cell);
      own.setShares(cell, fresh.held);
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
