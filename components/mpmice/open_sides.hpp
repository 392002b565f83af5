#pragma once

#include "components/euler/boundary.hpp"
#include "components/mpmice/box_images.hpp"
#include "components/mpmice/settings.hpp"

namespace tushar::mpmice {

/// A side of the grid: its axis, and the direction out of the grid, 1 or -1.
struct WayOut {
  int axis = -1, direction = 0;

  bool isOne() const { return direction != 0; }
};

/// Whether gas may pass through the face of a cell on a side of the grid: the side is no wall and no symmetry plane.
template <int D>
bool isOpenSide(const Level& level, const euler::Gas& gas, const Index<D>& cell, int axis, int side) {
  if (level.isPeriodic(axis)) return false;
  return !euler::isWall<D>({.level = level, .axis = axis, .side = side, .part = level.partAt<D>(axis, side, cell)},
                           gas);
}

/// The first open side at which a cell is, along an axis with several cells.
template <int D>
WayOut openSideAt(const Level& level, const euler::Gas& gas, const Index<D>& cell) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      const bool isAt = cell[d] == (side == 0 ? level.cells().lower[d] : level.cells().upper[d] - 1);
      if (isAt && level.cells().extent(d) > 1 && isOpenSide<D>(level, gas, cell, d, side))
        return {d, side == 0 ? -1 : 1};
    }
  return {};
}

/// Whether bodies may leave the grid through any side, or a part of one: it is open, and the grid has several cells
/// along its axis.
template <int D>
bool hasOpenSide(const Level& level, const euler::Gas& gas) {
  bool any = false;
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (level.isPeriodic(d) || level.cells().extent(d) < 2) continue;
      for (int part = grid::restOfSide; part < std::ssize(level.parts(d, side)); ++part)
        any = any || !euler::isWall<D>({.level = level, .axis = d, .side = side, .part = part}, gas);
    }
  return any;
}

/// Sets what the gas must know about the sides of the grid.
template <int D>
void lookAtSides(const Level& level, Settings& settings) {
  settings.endsAtPlane = hasUpperPlane(level);
  settings.opensAtSides = hasOpenSide<D>(level, settings.gas.gas);
}

}  // namespace tushar::mpmice
