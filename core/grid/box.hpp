#pragma once

#include <algorithm>
#include <cstddef>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// Index of the next coarser cell along an axis, rounded down, also for negative indices.
constexpr int coarserCell(int cell) { return cell >= 0 ? cell / 2 : -((1 - cell) / 2); }

/// A half-open box of cells or nodes, [lower, upper) along each axis.
/// Axes that a scene leaves out hold the single index 0.
struct Box {
  Index3 lower{};
  Index3 upper{};

  friend constexpr bool operator==(const Box&, const Box&) = default;

  constexpr int extent(int axis) const { return upper[axis] - lower[axis]; }
  constexpr bool empty() const { return extent(0) <= 0 || extent(1) <= 0 || extent(2) <= 0; }
  constexpr std::size_t size() const {
    return empty() ? 0
                   : static_cast<std::size_t>(extent(0)) * static_cast<std::size_t>(extent(1)) *
                         static_cast<std::size_t>(extent(2));
  }

  template <int D>
  constexpr bool contains(const Index<D>& index) const {
    for (int d = 0; d < D; ++d)
      if (index[d] < lower[d] || index[d] >= upper[d]) return false;
    return true;
  }

  /// Offset of an index in an array over the box, the first axis fastest.
  constexpr std::size_t offset(const Index3& at) const {
    const std::size_t x = at[0] - lower[0];
    const std::size_t y = at[1] - lower[1];
    const std::size_t z = at[2] - lower[2];
    return x + static_cast<std::size_t>(extent(0)) * (y + static_cast<std::size_t>(extent(1)) * z);
  }

  /// The first index of each row along the first axis, as a box.
  constexpr Box rowStarts() const {
    Box starts = *this;
    starts.upper[0] = std::min(upper[0], lower[0] + 1);
    return starts;
  }
  constexpr std::size_t rows() const {
    return static_cast<std::size_t>(extent(1)) * static_cast<std::size_t>(extent(2));
  }
  constexpr std::size_t rowOf(const Index3& at) const {
    return static_cast<std::size_t>(at[1] - lower[1]) +
           static_cast<std::size_t>(extent(1)) * static_cast<std::size_t>(at[2] - lower[2]);
  }

  constexpr Box intersect(const Box& other) const {
    Box both;
    for (int d = 0; d < 3; ++d) {
      both.lower[d] = std::max(lower[d], other.lower[d]);
      both.upper[d] = std::min(upper[d], other.upper[d]);
    }
    return both;
  }

  /// This box, enlarged by `width` on both sides along the first `dimension` axes.
  constexpr Box grown(int width, int dimension) const {
    Box box = *this;
    for (int d = 0; d < dimension; ++d) {
      box.lower[d] -= width;
      box.upper[d] += width;
    }
    return box;
  }

  /// The cells of the next finer level in this box of cells.
  constexpr Box refined(int dimension) const {
    Box fine = *this;
    for (int d = 0; d < dimension; ++d) {
      fine.lower[d] *= 2;
      fine.upper[d] *= 2;
    }
    return fine;
  }
  /// The smallest box of cells of the next coarser level that contains this box of cells.
  constexpr Box coarsened(int dimension) const {
    Box coarse = *this;
    for (int d = 0; d < dimension; ++d) {
      coarse.lower[d] = coarserCell(lower[d]);
      coarse.upper[d] = coarserCell(upper[d] - 1) + 1;
    }
    return coarse;
  }

  constexpr Box shifted(const Index3& by) const { return {lower + by, upper + by}; }

  /// The nodes of the cells in this box: along each of the first `dimension` axes, one more node than cells.
  constexpr Box nodes(int dimension) const {
    Box box = *this;
    for (int d = 0; d < dimension; ++d) ++box.upper[d];
    return box;
  }
};

/// Calls `visit(Index<D>)` for each index of the box in lexicographic order, the first axis fastest.
/// This order is the order of every sum over cells: it does not depend on the patches.
template <int D, class Visit>
inline void forEach(const Box& box, Visit&& visit) {
  Index<D> at;
  if constexpr (D == 1) {
    for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0]) visit(at);
  } else if constexpr (D == 2) {
    for (at[1] = box.lower[1]; at[1] < box.upper[1]; ++at[1])
      for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0]) visit(at);
  } else {
    for (at[2] = box.lower[2]; at[2] < box.upper[2]; ++at[2])
      for (at[1] = box.lower[1]; at[1] < box.upper[1]; ++at[1])
        for (at[0] = box.lower[0]; at[0] < box.upper[0]; ++at[0]) visit(at);
  }
}

/// Calls `visit(first, count)` for each row of the box along the first axis, in the order of forEach; a row has `count`
/// cells or nodes.
template <int D, class Visit>
inline void forEachRow(const Box& box, Visit&& visit) {
  if (!box.empty()) forEach<D>(box.rowStarts(), [&](const Index<D>& first) { visit(first, box.extent(0)); });
}

}  // namespace tushar::grid
