#pragma once

#include <Eigen/LU>

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/solid/kernels/transfer.hpp"
#include "components/mpm/solid/shapes/tensor_shape.hpp"

namespace tushar::mpm::solid {

/// Convected particle domains: a particle is a parallelepiped that F deforms, and S_i the mean over it of what lies
/// linearly between the values of the tent function at its corners,
///   S_i = 1/2^D sum_c N_i(x_c),   grad S_i = 1/2^D sum_c R^(-T) sigma_c N_i(x_c),   x_c = x_p + R sigma_c,
/// with sigma_c = (+-1, …) and the half edges R = F diag(size h) / 2; Sadeghirad, Brannon & Burghardt, Int. J. Numer.
/// Meth. Engng 86 (2011) 1435. A domain that reaches farther than a cell from its middle is shrunk to that, as Homel,
/// Brannon & Guilkey, Int. J. Numer. Meth. Engng 107 (2016) 31, do.
template <int D>
struct CpdiShape {
  static constexpr int dimension = D;
  static constexpr int ghostNodes = 1, reach = 1 + ghostNodes;
  static constexpr bool hasSize = true;
  static constexpr bool deforms = true;
  static constexpr bool axisymmetric = false;

  /// How far a particle reaches along each axis, in cells.
  static Vec<D> support(const Extent<D>& extent) {
    return (1 + extent.halfEdges.cwiseAbs().rowwise().sum().array().min(1.0)).matrix();
  }

  struct Stencil {
    static constexpr int dimension = D;
    static constexpr int nodes = 4;  ///< along each axis: of the particle's cell and those around
    static constexpr int corners = 1 << D;
    static constexpr double share = 1.0 / corners;

    /// A corner of the domain: the lower node of its cell, counted from `first`, the tent functions of that cell's nodes,
    /// and what it has in the gradient (1/m).
    struct Corner {
      Index<D> cell;
      std::array<double, corners> weights;
      Vec<D> slope;
    };

    Index<D> first;
    std::array<Corner, corners> corner;

    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent)
        : Stencil(CellFrame<D>(level, cell), cell, x, extent) {}
    Stencil(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      for (int d = 0; d < D; ++d) first[d] = cell[d] - 1;
      const Vec<D> xi = frame.coordinates(x);
      Eigen::Matrix<double, D, D> half = extent.halfEdges;
      half *= std::min(1.0, 1 / half.cwiseAbs().rowwise().sum().maxCoeff());
      const Eigen::Matrix<double, D, D> slopes = share * frame.inverseSpacing.asDiagonal() * half.inverse().transpose();
      for (int c = 0; c < corners; ++c) {
        Vec<D> sign;
        for (int d = 0; d < D; ++d) sign[d] = (c >> d) & 1 ? 1 : -1;
        place(corner[static_cast<std::size_t>(c)], xi + half * sign);
        corner[static_cast<std::size_t>(c)].slope = slopes * sign;
      }
    }

    /// Calls `visit(node, S, gradient)` for every node of the cells around, in the same order for every particle.
    template <class Visit>
    void forEachNode(Visit&& visit) const {
      Box offsets{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) offsets.upper[d] = nodes;
      forEach<D>(offsets, [&](const Index<D>& node) {
        double value = 0;
        Vec<D> gradient = Vec<D>::Zero();
        for (const Corner& at : corner) {
          const int k = nodeOfCell(node, at.cell);
          if (k < 0) continue;
          value += share * at.weights[static_cast<std::size_t>(k)];
          gradient += at.weights[static_cast<std::size_t>(k)] * at.slope;
        }
        if (value != 0) visit(first + node, value, gradient);
      });
    }

   private:
    /// In the cell that a point at `xi`, in cells from that of the particle, lies in.
    static void place(Corner& corner, const Vec<D>& xi) {
      Vec<D> within;
      for (int d = 0; d < D; ++d) {
        const double lower = std::clamp(std::floor(xi[d]), -1.0, 1.0);
        corner.cell[d] = static_cast<int>(lower) + 1;
        within[d] = xi[d] - lower;
      }
      corner.weights = Linear<D>::weights(within);
    }
    /// The number of a node among those of a cell, or -1.
    static int nodeOfCell(const Index<D>& node, const Index<D>& cell) {
      int k = 0;
      for (int d = 0; d < D; ++d) {
        const int upper = node[d] - cell[d];
        if (upper < 0 || upper > 1) return -1;
        k |= upper << d;
      }
      return k;
    }
  };
};

/// How many records lie from that of the first node of a stencil to the lower one of a corner's cell.
template <class Corner, std::size_t D>
std::ptrdiff_t offsetOf(const Corner& corner, const std::array<std::ptrdiff_t, D>& stride) {
  std::ptrdiff_t offset = 0;
  for (std::size_t d = 0; d < D; ++d) offset += corner.cell[static_cast<int>(d)] * stride[d];
  return offset;
}

/// Calls `visit(offset, k)` for each node k of a cell.
template <int D, class Visit>
[[gnu::always_inline]] inline void forEachNodeOfCell(const std::array<std::ptrdiff_t, D>& stride, Visit&& visit) {
  for (std::size_t k = 0; k < (1U << D); ++k) {
    std::ptrdiff_t offset = 0;
    for (std::size_t d = 0; d < D; ++d) offset += ((k >> d) & 1U) ? stride[d] : 0;
    visit(offset, k);
  }
}

/// As for other shapes (see transfer.hpp): each corner brings its share to the nodes of its cell.
template <class Stencil, int D = Stencil::dimension>
  requires(Stencil::corners > 0)
[[gnu::always_inline]] inline void scatter(const Stencil& stencil, const NodeWindow<Octet, D>& nodes, const Octet& value,
                                           const std::array<Quad, Stencil::dimension>& slope, const Quad& = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = Stencil::share * value.high;
  for (const auto& corner : stencil.corner) {
    Quad high = mean;
    for (std::size_t d = 0; d < D; ++d) high = multiplyAdd(corner.slope[static_cast<int>(d)], slope[d], high);
    Octet* const cell = nodes.origin + offsetOf(corner, nodes.stride);
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      cell[offset].low = multiplyAdd(corner.weights[k], low, cell[offset].low);
      cell[offset].high = multiplyAdd(corner.weights[k], high, cell[offset].high);
    });
  }
}

/// The same for the nodes of a stencil that lie within a box; `origin` is the record of its first node, stored or not.
template <class Stencil, int D = Stencil::dimension>
  requires(Stencil::corners > 0)
inline void scatterWithin(const Stencil& stencil, const Box& box, const NodeWindow<Octet, D>& nodes, const Octet& value,
                          const std::array<Quad, Stencil::dimension>& slope, const Quad& = Quad{}) {
  const Quad low = Stencil::share * value.low, mean = Stencil::share * value.high;
  for (const auto& corner : stencil.corner) {
    Quad high = mean;
    for (std::size_t d = 0; d < D; ++d) high = multiplyAdd(corner.slope[static_cast<int>(d)], slope[d], high);
    for (std::size_t k = 0; k < (1U << D); ++k) {
      Index<D> node;
      std::ptrdiff_t offset = 0;
      for (std::size_t d = 0; d < D; ++d) {
        const int upper = (k >> d) & 1U ? 1 : 0, at = corner.cell[static_cast<int>(d)] + upper;
        node[static_cast<int>(d)] = stencil.first[static_cast<int>(d)] + at;
        offset += at * nodes.stride[d];
      }
      if (!box.contains(node)) continue;
      Octet& record = nodes.origin[offset];
      record.low = multiplyAdd(corner.weights[k], low, record.low);
      record.high = multiplyAdd(corner.weights[k], high, record.high);
    }
  }
}

template <class Stencil, int D = Stencil::dimension>
  requires(Stencil::corners > 0)
[[gnu::always_inline]] inline Gathered<D> gather(const Stencil& stencil, const NodeWindow<const Octet, D>& nodes) {
  Gathered<D> sums;
  for (const auto& corner : stencil.corner) {
    const Octet* const cell = nodes.origin + offsetOf(corner, nodes.stride);
    Octet at{};
    forEachNodeOfCell<D>(nodes.stride, [&](std::ptrdiff_t offset, std::size_t k) {
      at.low = multiplyAdd(corner.weights[k], cell[offset].low, at.low);
      at.high = multiplyAdd(corner.weights[k], cell[offset].high, at.high);
    });
    sums.value.low = multiplyAdd(Stencil::share, at.low, sums.value.low);
    sums.value.high = multiplyAdd(Stencil::share, at.high, sums.value.high);
    for (std::size_t d = 0; d < D; ++d)
      sums.gradient[d] = multiplyAdd(corner.slope[static_cast<int>(d)], at.low, sums.gradient[d]);
  }
  return sums;
}

}  // namespace tushar::mpm::solid
