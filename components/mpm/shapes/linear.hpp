#pragma once

#include <array>
#include <type_traits>

#include "core/core.hpp"

namespace tushar::mpm {

/// Multilinear shape functions: a particle contributes to the 2^D nodes of its cell.
///
///   S_i(x) = product over the axes of max(0, 1 - |x - x_i| / h)
///
/// They are the S_i of (6) of Tran, Kim & Berzins.
template <int D>
struct Linear {
  static constexpr int nodes = 1 << D;
  /// Number of layers of cells around a patch whose particles contribute to the nodes of the patch.
  static constexpr int reach = 1;
  /// One number for each node of a cell, in the order of `node`.
  using Weights = std::array<double, nodes>;

  /// The index of node k of a cell: bit d of k is set if it is the upper node along axis d.
  static constexpr Index<D> node(Index<D> cell, int k) {
    for (int d = 0; d < D; ++d) cell[d] += (k >> d) & 1;
    return cell;
  }

  /// S_i of each node of a cell at a point x in the cell. Along axis d `lower(d)` and `upper(d)` are the factors 1 - |x
  /// - x_i| / h of the lower and of the upper nodes; their sum is 1. They are numbers, or vectors of one for each
  /// point.
  template <class Lower, class Upper>
  [[gnu::always_inline]] static auto weights(const Lower& lower, const Upper& upper) {
    std::array<std::remove_cvref_t<decltype(upper(0))>, nodes> s;
    s[0] = lower(0);
    s[1] = upper(0);
    for (int d = 1; d < D; ++d) {
      const int half = 1 << d;
      for (int k = 0; k < half; ++k) {
        s[k + half] = s[k] * upper(d);
        s[k] *= lower(d);
      }
    }
    return s;
  }
  /// S_i of each node of a cell at the coordinates `xi` in [0,1] within the cell.
  static Weights weights(const Vec<D>& xi) {
    return weights([&](int d) { return 1.0 - xi[d]; }, [&](int d) { return xi[d]; });
  }

  /// dS_k/dx_d at the centre of the cell, 1/m.
  static double centreGradient(const Level& level, int k, int d) {
    constexpr double others = 1.0 / (1 << (D - 1));  // the other axes' factors in the middle, 1/2 each
    return ((k >> d) & 1 ? others : -others) * level.inverseSpacing(d);
  }
};

/// The geometry of a cell, from which the coordinates of particles in it are computed.
template <int D>
struct CellFrame {
  Vec<D> origin;          ///< lower corner of the cell [m]
  Vec<D> inverseSpacing;  ///< inverse spacing [1/m]

  CellFrame(const Level& level, const Index<D>& cell) {
    for (int d = 0; d < D; ++d) {
      origin[d] = level.nodePosition(d, cell[d]);
      inverseSpacing[d] = level.inverseSpacing(d);
    }
  }
  Vec<D> coordinates(const Vec<D>& x) const { return (x - origin).cwiseProduct(inverseSpacing); }
};

}  // namespace tushar::mpm
