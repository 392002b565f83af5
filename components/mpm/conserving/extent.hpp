#pragma once

#include <algorithm>
#include <array>

#include "core/core.hpp"

namespace tushar::mpm {

/// A particle that fills the interval [left, right] of a line of cells, and what it touches there.
///
/// Weights are means of the linear shape functions over the interval, w_i = 1/L integral S_i dx; parts are the shares
/// of the interval that lie in each cell. An interval of at most 2 h touches no more than 3 cells and 4 nodes.
struct Extent {
  static constexpr int most = 4;
  /// Cells beyond a patch whose particles touch its nodes: a particle may reach into the cell next to its own.
  static constexpr int reach = 2;

  int firstCell = 0;
  int cells = 0;                     ///< that the interval overlaps
  std::array<double, most> part{};   ///< of the interval, by cell from firstCell on; they sum to 1
  std::array<double, most + 1> weight{};  ///< by node from firstCell on; they sum to 1
  double left = 0, right = 0;        ///< m

  Extent(const Level& level, double centre, double length) {
    const int last = level.cells().upper[0] - 1;
    left = std::max(centre - 0.5 * length, level.nodePosition(0, 0));
    right = std::min(centre + 0.5 * length, level.nodePosition(0, last + 1));
    firstCell = std::clamp(level.cellAlong(0, left), 0, last);
    double from = left;
    for (int cell = firstCell; cells < most && (cells == 0 || from < right); ++cell, ++cells) {
      const double to = cell == last || cells == most - 1 ? right : std::min(right, level.nodePosition(0, cell + 1));
      add(level, cell, from, to);
      from = to;
    }
  }

  /// Value of a node field, given at the nodes from firstCell on, at a point of the interval.
  template <class Values>
  double at(const Level& level, double x, const Values& values) const {
    const int cell = std::clamp(level.cellAlong(0, x) - firstCell, 0, cells - 1);
    const double s = (x - level.nodePosition(0, firstCell + cell)) * level.inverseSpacing(0);
    const auto k = static_cast<std::size_t>(cell);
    return values[k] + s * (values[k + 1] - values[k]);
  }

 private:
  void add(const Level& level, int cell, double from, double to) {
    const double origin = level.nodePosition(0, cell), inverse = level.inverseSpacing(0);
    const double s0 = (from - origin) * inverse, s1 = (to - origin) * inverse;
    const double cellsLong = (right - left) * inverse;
    const double share = cellsLong > 0 ? (s1 - s0) / cellsLong : 1.0;
    const double upper = share * 0.5 * (s0 + s1);
    const auto k = static_cast<std::size_t>(cells);
    part[k] = share;
    weight[k] += share - upper;
    weight[k + 1] += upper;
  }
};

}  // namespace tushar::mpm
