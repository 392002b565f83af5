#pragma once

#include <Eigen/LU>

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/shapes/tensor_shape.hpp"

namespace tushar::mpm {

/// Convected particle domains: a particle is a parallelepiped that F deforms, and S_i the mean over it of what lies
/// linearly between the values of the tent function at its corners,
///   S_i = 1/2^D sum_c N_i(x_c),   grad S_i = 1/2^D sum_c R^(-T) sigma_c N_i(x_c),   x_c = x_p + R sigma_c,
/// with sigma_c = (+-1, …) and the half edges R = F diag(size h) / 2; Sadeghirad, Brannon & Burghardt, Int. J. Numer.
/// Meth. Engng 86 (2011) 1435. A domain that reaches farther than a cell from its middle is shrunk to that, as Homel,
/// Brannon & Guilkey, Int. J. Numer. Meth. Engng 107 (2016) 31, do.
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

  /// How far a particle reaches along each axis, in cells.
  static Vec<D> support(const Extent<D>& extent) {
    return (1 + extent.halfEdges.cwiseAbs().rowwise().sum().array().min(1.0)).matrix();
  }

  struct Stencil {
    static constexpr int dimension = D;
    static constexpr int nodes = 4;  ///< along each axis: of the particle's cell and those around
    static constexpr int corners = 1 << D;
    static constexpr double share = 1.0 / corners;
    static constexpr bool axisymmetric = Axisymmetric;

    /// A corner of the domain: the lower node of its cell, counted from `first`, the tent functions of that cell's
    /// nodes, and what it has in the gradient (1/m).
    struct Corner {
      Index<D> cell;
      std::array<double, corners> weights;
      Vec<D> slope;
    };

    Index<D> first;
    std::array<Corner, corners> corner;
    double inverseRadius = 0;  ///< 1/m; 0 if nothing is axisymmetric

    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent)
        : Stencil(CellFrame<D>(level, cell), cell, x, extent) {}
    Stencil(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      if constexpr (Axisymmetric) inverseRadius = 1 / x[0];
      for (int d = 0; d < D; ++d) first[d] = cell[d] - 1;
      const Vec<D> xi = frame.coordinates(x);
      Eigen::Matrix<double, D, D> half = extent.halfEdges;
      half *= std::min(1.0, 1 / half.cwiseAbs().rowwise().sum().maxCoeff());
      const Eigen::Matrix<double, D, D> slopes = share * frame.inverseSpacing.asDiagonal() * half.inverse().transpose();
      for (int c = 0; c < corners; ++c) {
        Vec<D> sign;
        for (int d = 0; d < D; ++d) sign[d] = (c >> d) & 1 ? 1 : -1;
        place(corner[c], xi + half * sign);
        corner[c].slope = slopes * sign;
      }
    }

    /// Calls `visit(node, S, gradient)` for every node of the cells around, in the same order for every particle.
    template <class Visit>
    void forEachNode(Visit&& visit) const {
      std::array<double, around> value{};
      std::array<Vec<D>, around> gradient;
      gradient.fill(Vec<D>::Zero());
      for (const Corner& at : corner)
        for (int k = 0; k < corners; ++k) {
          const std::size_t node = numberOf(at.cell, k);
          value[node] += share * at.weights[k];
          gradient[node] += at.weights[k] * at.slope;
        }
      Box offsets{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) offsets.upper[d] = nodes;
      std::size_t next = 0;
      forEach<D>(offsets, [&](const Index<D>& node) {
        if (value[next] != 0) visit(first + node, value[next], gradient[next]);
        ++next;
      });
    }

    /// S_i of a node.
    double valueAt(const Index<D>& node) const {
      double value = 0;
      for (const Corner& at : corner)
        if (const int k = nodeOfCell(node - first, at.cell); k >= 0) value += share * at.weights[k];
      return value;
    }

   private:
    static constexpr std::size_t around = D == 1 ? nodes : D == 2 ? nodes * nodes : nodes * nodes * nodes;

    /// The number of node k of a cell among those of the cells around.
    static std::size_t numberOf(const Index<D>& cell, int k) {
      std::size_t number = 0;
      for (int d = D - 1; d >= 0; --d) number = number * nodes + static_cast<std::size_t>(cell[d] + ((k >> d) & 1));
      return number;
    }
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

template <int D>
using CpdiShape = ConvectedShape<D>;
template <int D>
using AxisymmetricCpdiShape = ConvectedShape<D, true>;

/// S_i / r of a node, 1/m; 0 if nothing is axisymmetric.
template <class Stencil, int D = Stencil::dimension>
requires(Stencil::corners > 0) double hoopOf(const Stencil& stencil, const Index<D>& node) {
  return Stencil::axisymmetric ? stencil.inverseRadius * stencil.valueAt(node) : 0.0;
}

}  // namespace tushar::mpm
