#pragma once

#include <array>

#include "core/base/limiters.hpp"
#include "core/data/joint_interpolation.hpp"

// What the interpolations of gases between levels share.

namespace tushar::euler {

/// The value of a variable in a cell.
template <class T>
T& valueIn(const data::CellValues& values, const Index3& cell) {
  return reinterpret_cast<T*>(values.values)[values.stored.offset(cell)];
}

/// The finer cells in a coarse cell. The d-th bit of k tells whether the k-th of them is the upper one along axis d.
template <int D>
struct ChildCells {
  static constexpr int count = 1 << D;

  static Index3 at(const Index3& parent, int k) {
    Index3 cell = parent;
    for (int d = 0; d < D; ++d) cell[d] = 2 * cell[d] + (k >> d & 1);
    return cell;
  }
  /// The difference of a child from its parent, from a quarter of the slope along each axis.
  template <class Number>
  static Number change(const std::array<Number, D>& quarters, int k) {
    Number sum = (k & 1) != 0 ? quarters[0] : Number(-quarters[0]);
    for (int d = 1; d < D; ++d) sum += (k >> d & 1) != 0 ? quarters[d] : Number(-quarters[d]);
    return sum;
  }
  /// The mean over all children, in pairs along x, then y, then z.
  static double mean(std::array<double, count> values) {
    for (int left = count / 2; left > 0; left /= 2)
      for (int k = 0; k < left; ++k) values[k] = values[2 * k] + values[2 * k + 1];
    return values[0] / count;
  }
};

/// Whether a cell has both neighbours along an axis in memory; otherwise it has no slope there.
inline bool hasNeighbours(const data::CellValues& values, const Index3& cell, int axis) {
  return cell[axis] > values.stored.lower[axis] && cell[axis] + 1 < values.stored.upper[axis];
}

/// The differences of a quantity to the lower neighbour and from it to the upper one, and its limited slope.
struct Differences {
  double below = 0, above = 0;

  double slope() const { return Mc::slope(below, above); }
  double mean() const { return 0.5 * (below + above); }
  /// The limited slope relative to the mean difference, from 0 to 1; 1 if the differences are round-off of `size`.
  double factor(double size) const {
    constexpr double roundOff = 1e-14;
    if (std::max(std::abs(below), std::abs(above)) <= roundOff * size) return 1;
    return below * above > 0 ? slope() / mean() : 0;
  }
  Differences& operator+=(const Differences& other) {
    below += other.below;
    above += other.above;
    return *this;
  }
  friend Differences operator-(const Differences& a, const Differences& b) {
    return {a.below - b.below, a.above - b.above};
  }
  friend Differences operator*(double factor, const Differences& one) {
    return {factor * one.below, factor * one.above};
  }
};

}  // namespace tushar::euler
