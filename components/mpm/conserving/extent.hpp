#pragma once

#include <algorithm>
#include <array>

#include "core/core.hpp"

namespace tushar::mpm {

/// A particle that fills the interval [left, right] of a line of cells, and what it touches there.
///
/// Weights are means of the linear shape functions over the interval, w_i = 1/L integral S_i dx; parts are the shares
/// of the interval that lie in each cell. An interval of less than 3 h touches at most 4 cells and 5 nodes.
struct Extent {
  static constexpr int most = 4;
  /// How many cells away from that of its centre a particle may reach.
  static constexpr int overhang = 2;
  /// Cells beyond a patch whose particles may touch its nodes.
  static constexpr int reach = overhang + 1;

  int firstCell = 0;
  int cells = 0;                          ///< that the interval overlaps
  std::array<double, most> part{};        ///< of the interval, by cell from firstCell on; they sum to 1
  std::array<double, most + 1> weight{};  ///< by node from firstCell on; they sum to 1
  double left = 0, right = 0;             ///< ends, m
  double leftWithin = 0, rightWithin = 0;  ///< coordinates of the ends in their cells, 0 to 1

  /// `cell` is that of the centre.
  Extent(const Level& level, int cell, double centre, double length) {
    const int last = level.cells().upper[0] - 1;
    const double inverse = level.inverseSpacing(0);
    left = std::max(centre - 0.5 * length, level.nodePosition(0, 0));
    right = std::min(centre + 0.5 * length, level.nodePosition(0, last + 1));
    firstCell = cell;
    while (firstCell > 0 && left < level.nodePosition(0, firstCell)) --firstCell;
    double from = leftWithin = (left - level.nodePosition(0, firstCell)) * inverse;
    for (int k = firstCell;; ++k) {
      const bool ends = k == last || cells == most - 1 || right <= level.nodePosition(0, k + 1);
      const double to = ends ? (right - level.nodePosition(0, k)) * inverse : 1.0;
      const double inCell = to - from, upper = inCell * 0.5 * (from + to);
      const auto at = static_cast<std::size_t>(cells++);
      part[at] = inCell;
      weight[at] += inCell - upper;
      weight[at + 1] += upper;
      rightWithin = to;
      if (ends) break;
      from = 0;
    }
    normalise();
  }

  /// Values of a node field, given at the nodes from firstCell on, at the two ends.
  template <class Values>
  double atLeft(const Values& values) const {
    return values[0] + leftWithin * (values[1] - values[0]);
  }
  template <class Values>
  double atRight(const Values& values) const {
    const auto k = static_cast<std::size_t>(cells);
    return values[k - 1] + rightWithin * (values[k] - values[k - 1]);
  }

 private:
  /// Divides by the length in cells, as the sum of its parts: short intervals far from 0 lose digits in right - left.
  void normalise() {
    double length = 0;
    for (const double inCell : part) length += inCell;
    const double scale = 1 / length;
    for (double& share : part) share *= scale;
    for (double& share : weight) share *= scale;
  }
};

}  // namespace tushar::mpm
