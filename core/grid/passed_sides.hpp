#pragma once

#include <array>

#include "core/grid/level.hpp"

namespace tushar::grid {

/// The sides through which a particle leaves a level that is not periodic, one per axis at most.
struct PassedSides {
  struct Side {
    int axis, side;
    int plane;  ///< index of the nodes of the side along the axis
  };
  std::array<Side, 3> sides{};
  int count = 0;
  bool arePastEdge = false;  ///< whether they are the walls of a re-entrant edge, neither of which was met alone

  const Side* begin() const { return sides.data(); }
  const Side* end() const { return sides.data() + count; }
  void add(const Side& one) { sides[static_cast<std::size_t>(count++)] = one; }
};

/// The sides through which a particle leaves that moves from a cell inside to a cell outside: those that it meets if it
/// moves along one axis alone. If it meets none, it moves past a re-entrant edge, and leaves through both walls.
template <int D>
PassedSides passedSides(const Level& level, const Index<D>& from, const Index<D>& to) {
  PassedSides passed;
  if (level.isInside<D>(to)) return passed;
  for (int d = 0; d < D; ++d) {
    const int side = to[d] > from[d] ? 1 : 0, step = side == 1 ? 1 : -1;
    Index<D> at = from;
    while (at[d] != to[d]) {
      at[d] += step;
      if (level.isInside<D>(at)) continue;
      passed.add({d, side, side == 1 ? at[d] : at[d] + 1});
      break;
    }
  }
  if (passed.count > 0) return passed;
  passed.arePastEdge = true;
  for (int d = 0; d < D; ++d)
    if (to[d] > from[d])
      passed.add({d, 1, to[d]});
    else if (to[d] < from[d])
      passed.add({d, 0, to[d] + 1});
  return passed;
}

/// The cell that contains a particle that was in the cell `from`, as Level::cellOf finds it in `found`, except that a
/// point on an upper inner side belongs to the last cell before it, as on a side of the grid.
template <int D>
Index<D> withUpperSides(const Level& level, const Index<D>& from, const Vec<D>& x, Index<D> found) {
  for (const PassedSides::Side& one : passedSides<D>(level, from, found))
    if (one.side == 1 && x[one.axis] == level.nodePosition(one.axis, one.plane)) found[one.axis] = one.plane - 1;
  return found;
}

}  // namespace tushar::grid
