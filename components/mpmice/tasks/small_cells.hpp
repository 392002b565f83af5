#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "components/mpmice/free_space.hpp"
#include "components/mpmice/near_bodies.hpp"
#include "components/mpmice/surroundings.hpp"

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
/// not limit the time step, and cells may appear and vanish. Where several neighbours suit equally well, a cell
/// shares an equal part of its content and volume with each of them, so that mirrored scenes stay mirrored.
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
    marks.forEachIn(rows, [&](const Index<D>& cell) { choices_[offsetIn<D>(box, cell)] = choiceOfSmall(cell); });
    return marks;
  }

  /// Whether a cell keeps its own gas, so that it may receive gas from others.
  bool isTarget(const Index<D>& cell) const { return choiceOf(cell) == none; }
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

  /// Calls `visit(target, part)` for each cell with which a cell shares its content, and the part of the content and
  /// the volume that it shares with it: neighbours with enough free volume, otherwise those that have more free volume
  /// than the cell and do not give away their own gas. If there are none, it is the cell itself.
  template <class Visit>
  void forEachTarget(const Index<D>& cell, Visit&& visit) const {
    const Targets targets = targetsOf(cell);
    Around::forEachOf(targets.cells, cell, [&](const Index<D>& at) { visit(at, targets.partOf(at, cell)); });
  }
  /// The content of a cell after merging, and whether it shares with others. `contentOf(cell, part)` is a part of the
  /// content of a cell before; contents are Pool or alike: they have a volume, and can be added and scaled.
  template <class ContentOf>
  auto merged(const Index<D>& cell, ContentOf&& contentOf) const {
    const Targets targets = targetsOf(cell);
    bool shares = false;
    auto content = Around::sum(targets.cells, cell, [&](const Index<D>& target) {
      if (target == cell && targets.keeps) return contentOf(cell, targets.kept);
      const Choice members = givers(target) | Around::bitOf(target, target);
      shares |= !(target == cell) || std::popcount(members) > 1;
      auto pool = Around::sum(members, target, [&](const Index<D>& at) {
        return contentOf(at, at == target ? 1.0 : partOfEach(choiceOf(at)));
      });
      if (pool.volume > 0) pool *= targets.part * state_.free[cell] / pool.volume;
      return pool;
    });
    return std::pair(content, shares);
  }

 private:
  using Around = Surroundings<D>;
  using Choice = typename Around::Set;
  static constexpr Choice none = Around::none;

  /// The cells with which a cell shares its content.
  struct Targets {
    Choice cells;
    double part;  ///< what each neighbour of these gets
    double kept;  ///< what the cell keeps
    bool keeps;   ///< whether it keeps that alone, instead of sharing it with others that give to it

    double partOf(const Index<D>& at, const Index<D>& cell) const { return at == cell ? kept : part; }
  };
  Targets targetsOf(const Index<D>& cell) const {
    const Choice choice = choiceOf(cell);
    if (choice == none) return {Around::bitOf(cell, cell), 1, 1, false};
    Targets targets{none, partOfEach(choice), 0, false};
    Around::forEachOf(choice, cell, [&](const Index<D>& at) {
      if (isTarget(at))
        targets.cells |= Around::bitOf(cell, at);
      else
        targets.kept += targets.part;
    });
    targets.keeps = targets.kept > 0;
    if (targets.keeps) targets.cells |= Around::bitOf(cell, cell);
    return targets;
  }
  /// The small cells that give their gas to a cell.
  Choice givers(const Index<D>& centre) const {
    Choice giving = none;
    if (isTarget(centre))
      forEachAround(centre, [&](const Index<D>& at) {
        if (const Choice choice = choiceOf(at); choice != none && (choice & Around::bitOf(at, centre)) != 0)
          giving |= Around::bitOf(centre, at);
      });
    return giving;
  }

  static double partOfEach(Choice choice) { return choice == none ? 1.0 : 1.0 / std::popcount(choice); }
  Choice choiceOf(const Index<D>& cell) const {
    if (!isSmall(cell)) return none;
    return known_.contains(cell) ? choices_[offsetIn<D>(known_, cell)] : choiceOfSmall(cell);
  }
  /// The neighbours that suit best, except for round-off. Behind closed faces, a cell with gas chooses only one, so
  /// that gas does not pass through it.
  Choice choiceOfSmall(const Index<D>& cell) const {
    double most = unsuited;
    forEachAround(cell, [&](const Index<D>& at) { most = std::max(most, scoreOf(cell, at)); });
    if (most == unsuited) return none;
    const bool isFull = state_.free[cell] < leastFreeVolume;  // it gives all that it holds, and gets nothing back
    Choice all = none;
    Index<D> first = cell;
    forEachAround(cell, [&](const Index<D>& at) {
      const double score = scoreOf(cell, at);
      if (score == unsuited || score < most - offRoundShares) return;
      if (isFull || facesApart(cell, at) > 1 || openingTo(cell, at) > 0) all |= Around::bitOf(cell, at);
      if (first == cell || comesFirst(at, first, cell)) first = at;
    });
    return all != none ? all : Around::bitOf(cell, first);
  }
  /// Whether a neighbour of a cell is preferred to another one that is equally suitable, if neither is open to the
  /// cell: the one that is apart from the cell along the first axis, otherwise along the next one. Of two neighbours on
  /// opposite sides, it is the lower one.
  static bool comesFirst(const Index<D>& at, const Index<D>& other, const Index<D>& cell) {
    for (int d = 0; d < D; ++d)
      if ((at[d] == cell[d]) != (other[d] == cell[d])) return other[d] == cell[d];
    return false;
  }
  /// The score of a neighbour with more free volume, by more than round-off. Neighbours that are not small have the
  /// highest scores.
  double scoreOf(const Index<D>& cell, const Index<D>& at) const {
    const double room = state_.free[at], own = state_.free[cell];
    if (!(room > own + offRoundShares) || room < leastFreeVolume) return unsuited;
    if (room < smallFreeVolume && state_.held.density[at] == 0) return unsuited;  // an empty hole
    const double score = room >= smallFreeVolume ? 100 : 0;
    if (facesApart(cell, at) > 1) return score + 1e-4 * room;
    const double bothFree = std::max(0.0, 1 - (1 - own) - (1 - room));
    return score + 2 * openingTo(cell, at) + 1e-2 * bothFree + 1e-3 * room;
  }
  /// The open share of the face between a cell and a neighbour; 0 if they share no face.
  double openingTo(const Index<D>& cell, const Index<D>& at) const {
    if (facesApart(cell, at) != 1) return 0;
    int axis = 0;
    while (at[axis] == cell[axis]) ++axis;
    const Index<D>& above = at[axis] > cell[axis] ? at : cell;
    return openShare(state_.coverage[above][axis], state_.free[at], state_.free[cell], thin_walls_);
  }
  /// The number of axes along which two cells differ.
  static int facesApart(const Index<D>& cell, const Index<D>& at) {
    int apart = 0;
    for (int d = 0; d < D; ++d) apart += at[d] != cell[d];
    return apart;
  }

  static constexpr double unsuited = -1;  ///< the score of a neighbour that gets nothing
  const Level& level_;
  bool thin_walls_;
  const Unshared<D>& state_;
  Box known_;                                             ///< the cells for which findChoices was called
  std::vector<Choice, euler::Unfilled<Choice>> choices_;  ///< what the small ones of these cells chose
};

}  // namespace tushar::mpmice
