#pragma once

#include <Eigen/LU>

#include "components/mpm/shapes/diagonals.hpp"
#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/shapes/tensor_shape.hpp"

namespace tushar::mpm {

/// `count` numbers in vector registers.
template <class Number, int count>
struct VectorOf {
  using type [[gnu::vector_size(count * sizeof(Number))]] = Number;
};

/// Convected particle domains: a particle is a parallelepiped deformed by F, and S_i is the mean over it of the linear
/// interpolation between the values of the tent function at its corners,
///   S_i = 1/2^D sum_c N_i(x_c),   grad S_i = 1/2^D sum_c R^(-T) sigma_c N_i(x_c),   x_c = x_p + R sigma_c,
/// with sigma_c = (+-1, …) and the half edges R = F diag(size h) / 2; Sadeghirad, Brannon & Burghardt, Int. J. Numer.
/// Meth. Engng 86 (2011) 1435. A domain that extends farther than one cell from its centre is shrunk by its diagonals
/// until it extends one cell, as in Homel, Brannon & Guilkey, Int. J. Numer. Meth. Engng 107 (2016) 31.
///
/// Where `Axisymmetric`, the first axis is the radius; the means are those of the plane and S_i / r is taken at the
/// particle, as in Uintah.
template <int D, bool Axisymmetric = false>
struct ConvectedShape {
  static constexpr int dimension = D;
  static constexpr int ghostNodes = 1, reach = 1 + ghostNodes;
  static constexpr bool hasSize = true;
  static constexpr bool deforms = true;
  static constexpr bool axisymmetric = Axisymmetric;

  /// The extent of a particle's support along each axis, in cells.
  static Vec<D> support(const Extent<D>& extent) {
    return (1 + extent.halfEdges.cwiseAbs().rowwise().sum().array().min(1.0)).matrix();
  }

  struct Stencil {
    static constexpr int dimension = D;
    /// Number of nodes along each axis: those of the particle's cell and its neighbours.
    static constexpr int nodes = 4;
    static constexpr int corners = 1 << D;
    static constexpr double share = 1.0 / corners;
    static constexpr bool axisymmetric = Axisymmetric;

    /// One number for each corner: corner c lies at sigma_c, whose component d is +1 if bit d of c is set.
    using Corners = typename VectorOf<double, corners>::type;

    Index<D> first;
    /// Index of the lower node of the cell that contains each corner, counted from `first`.
    std::array<Corners, D> cellOf;
    std::array<Corners, corners> weights;  ///< values of the tent functions of the nodes of that cell
    std::array<Corners, D> slope;          ///< contribution of each corner to the gradient [1/m]
    double inverseRadius = 0;              ///< inverse radius [1/m]; 0 if the scene is not axisymmetric

    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent)
        : Stencil(CellFrame<D>(level, cell), cell, x, extent) {}
    Stencil(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      if constexpr (Axisymmetric) inverseRadius = 1 / x[0];
      for (int d = 0; d < D; ++d) first[d] = cell[d] - 1;
      const Vec<D> xi = frame.coordinates(x);
      Eigen::Matrix<double, D, D> half = extent.halfEdges;
      if (extentFromCentre<D>(half) > 1) shrinkToCell<D>(half);
      const Eigen::Matrix<double, D, D> slopes = share * frame.inverseSpacing.asDiagonal() * half.inverse().transpose();
      std::array<Corners, D> lower, upper;  // the tent functions along each axis
      for (int d = 0; d < D; ++d) {
        const Corners at = xi[d] + atCorners(half, d), zero{};
        const Corners below = at < 0.0 ? zero - 1 : at < 1.0 ? zero : zero + 1;
        cellOf[d] = below + 1;
        upper[d] = at - below;
        lower[d] = 1.0 - upper[d];
        slope[d] = atCorners(slopes, d);
      }
      weights = Linear<D>::weights([&](int d) { return lower[d]; }, [&](int d) { return upper[d]; });
    }

    /// Calls `visit(node, S, gradient)` for every node of the surrounding cells, in the same order for every particle.
    template <class Visit>
    void forEachNode(Visit&& visit) const {
      std::array<Quad, around> sums{};  // the gradient, and the value in the last lane
      for (int c = 0; c < corners; ++c) {
        Vec<D> slopes;
        for (int d = 0; d < D; ++d) slopes[d] = slope[d][c];
        const Quad each = quadOf<D>(slopes, share);
        Quad* const cell = sums.data() + numberOf(c);
        for (int k = 0; k < corners; ++k) cell[offsetOf(k)] += weights[k][c] * each;
      }
      Box offsets{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) offsets.upper[d] = nodes;
      const Quad* next = sums.data();
      forEach<D>(offsets, [&](const Index<D>& node) {
        const Quad& sum = *next++;
        if (sum[3] == 0) return;
        Vec<D> gradient;
        for (int d = 0; d < D; ++d) gradient[d] = sum[d];
        visit(first + node, sum[3], gradient);
      });
    }

    /// The value S_i of a node.
    double valueAt(const Index<D>& node) const {
      double value = 0;
      for (int c = 0; c < corners; ++c)
        if (const int k = nodeOfCell(node - first, c); k >= 0) value += share * weights[k][c];
      return value;
    }

   private:
    static constexpr std::size_t around = D == 1 ? nodes : D == 2 ? nodes * nodes : nodes * nodes * nodes;

    /// The index of the lowest node of the cell that contains corner c, among the nodes of all cells near the particle.
    std::size_t numberOf(int c) const {
      std::size_t number = 0;
      for (int d = D - 1; d >= 0; --d) number = number * nodes + static_cast<std::size_t>(cellOf[d][c]);
      return number;
    }
    /// The offset from this node to node k of the cell.
    static constexpr std::size_t offsetOf(int k) {
      std::size_t offset = 0;
      for (int d = D - 1; d >= 0; --d) offset = offset * nodes + ((k >> d) & 1);
      return offset;
    }
    /// Component d of the product `edges` sigma_c, bitwise equal to Eigen's result; Eigen sums the last component in
    /// another order.
    [[gnu::always_inline]] static Corners atCorners(const Eigen::Matrix<double, D, D>& edges, int d) {
      std::array<Corners, D> part;
      for (int j = 0; j < D; ++j) part[j] = edges(d, j) * signs(j);
      if constexpr (D == 1)
        return part[0];
      else if constexpr (D == 2)
        return part[0] + part[1];
      else
        return d < 2 ? (part[0] + part[1]) + part[2] : part[0] + (part[1] + part[2]);
    }
    /// Component j of sigma_c.
    [[gnu::always_inline]] static Corners signs(int j) {
      Corners sign;
      for (int c = 0; c < corners; ++c) sign[c] = (c >> j) & 1 ? 1 : -1;
      return sign;
    }
    /// The index of a node among the nodes of the cell that contains corner c; -1 if it is none of them.
    int nodeOfCell(const Index<D>& node, int c) const {
      int k = 0;
      for (int d = 0; d < D; ++d) {
        const int upper = node[d] - static_cast<int>(cellOf[d][c]);
        if (upper < 0 || upper > 1) return -1;
        k |= upper << d;
      }
      return k;
    }
  };
};

template <int D>
using CpdiShape = ConvectedShape<D>;
template <int D>
using AxisymmetricCpdiShape = ConvectedShape<D, true>;

/// S_i / r of a node [1/m]; 0 if the scene is not axisymmetric.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners > 0) double hoopOf(const Stencil& stencil, const Index<D>& node) {
  return Stencil::axisymmetric ? stencil.inverseRadius * stencil.valueAt(node) : 0.0;
}

}  // namespace tushar::mpm
