#pragma once

#include "components/mpmice/open_sides.hpp"
#include "components/mpmice/tasks/wall_force.hpp"

namespace tushar::mpmice {

/// The fraction of a face from which on bodies that move through it determine how its walls move. If they take less of
/// it, the velocity of the nodes also counts, so that a box that touches a face by round-off decides nothing.
inline constexpr double sureArea = 1e-4;

/// Views of the effects of bodies on the gas in a step: by their walls, and by changes of free volumes and faces.
template <int D>
struct BodiesInStep {
  KnownWalls<D> walls;
  CellView<const double> newFree;
  CellView<const Vec<D>> swept, sweptBy;
  std::optional<CellView<const Vec<D>>> leaving = {};  ///< if a side of the grid is open

  static BodiesInStep from(auto& take, bool hasFriction, bool opensAtSides) {
    return {.walls = KnownWalls<D>::from(take, 0, hasFriction),
            .newFree = take(requiresNew(c::unfilledVolume, 3)),
            .swept = take(requiresNew(c::swept<D>, 2)),
            .sweptBy = take(requiresNew(c::sweptBy<D>, 2)),
            .leaving = take(when(opensAtSides, requiresNew(c::leaving<D>, 2)))};
  }

  /// The displacement of the walls at the lower face of a cell, in cells: that of the bodies that move through the face
  /// or, if these take hardly any of its area, in part that of the nodes, `ofNodes()`.
  template <class OfNodes>
  double shiftAt(const Index<D>& above, int axis, OfNodes&& ofNodes) const {
    const double by = sweptBy[above][axis];
    const double part = by == c::notSwept ? 0 : std::abs(swept[above][axis]) / (sureArea * std::abs(by));
    if (part >= 1) return by;
    const double other = ofNodes();
    return part > 0 ? other + part * (by - other) : other;
  }
  /// Whether a cell is a hole in a body: it has little free volume, and no cell up to two cells away is mostly free.
  bool isClosedPore(const Level& level, const Index<D>& cell) const {
    if (!(newFree[cell] < narrowFreeVolume)) return false;
    bool closed = true;
    forEach<D>(level.clipCells(cellsAround<D>(cell, 2)),
               [&](const Index<D>& at) { closed &= !(newFree[at] > smallFreeVolume); });
    return closed;
  }
};

/// What the gas of a cell gives to walls in a step, per cell volume.
template <int D>
struct Given {
  Vec<D> impulse = Vec<D>::Zero();  ///< impulse per volume of the cell [N s/m³]
  double work = 0;                  ///< work per volume of the cell [J/m³]
};

/// The smallest fraction of its gas that a donor keeps, so that round-off makes no amount negative.
inline constexpr double roundOffOfShares = 1e-12;
/// The volume that follows walls, per cell volume, below which it is round-off. Below the second number, none follows
/// into a cell without gas: it would bring a trace of gas to one of two mirrored cells, and none to the other.
inline constexpr double roundOffOfSweeps = 1e-15, roundOffOfEdges = 1e-12;
/// The volume, per cell volume, of gases in a full cell, in which they keep their fractions.
inline constexpr double hardlyRoom = 1e-200;

}  // namespace tushar::mpmice
