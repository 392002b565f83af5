#pragma once

#include <array>

#include "core/core.hpp"

namespace tushar::mpm {

/// Multilinear shape functions: a particle in a cell touches the 2^D nodes of the cell.
///
/// S_i(x) = product over the axes of max(0, 1 - |x - x_i| / h); (6) of Tran, Kim & Berzins.
template <int D>
struct Linear {
  static constexpr int dimension = D;
  static constexpr int nodes = 1 << D;
  /// Cells beyond a patch whose particles touch its nodes.
  static constexpr int reach = 1;

  /// Node k of a cell: bit d of k says whether it is the upper one along axis d.
  static constexpr Index<D> node(Index<D> cell, int k) {
    for (int d = 0; d < D; ++d) cell[d] += (k >> d) & 1;
    return cell;
  }

  /// S_k for each node of the cell, from coordinates `xi` in [0,1] within it.
  static std::array<double, nodes> weights(const Vec<D>& xi) {
    std::array<double, nodes> w;
    w[0] = 1.0 - xi[0];
    w[1] = xi[0];
    for (int d = 1; d < D; ++d) {
      const int half = 1 << d;
      for (int k = 0; k < half; ++k) {
        const auto low = static_cast<std::size_t>(k), high = static_cast<std::size_t>(k + half);
        w[high] = w[low] * xi[d];
        w[low] *= 1.0 - xi[d];
      }
    }
    return w;
  }

  /// dS_k/dx_d in the middle of the cell, 1/m.
  static double centreGradient(const Level& level, int k, int d) {
    constexpr double others = 1.0 / (1 << (D - 1));  // the other axes' factors in the middle, 1/2 each
    return ((k >> d) & 1 ? others : -others) * level.inverseSpacing(d);
  }
};

/// Where a cell lies, so that its particles find their coordinates within it.
template <int D>
struct CellFrame {
  Vec<D> origin;          ///< its lower corner, m
  Vec<D> inverseSpacing;  ///< 1/m

  CellFrame(const Level& level, const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      origin[d] = level.nodePosition(d, cell[d]);
      inverseSpacing[d] = level.inverseSpacing(d);
    }
  }
  Vec<D> coordinates(const Vec<D>& x) const { return (x - origin).cwiseProduct(inverseSpacing); }
};

}  // namespace tushar::mpm
