#pragma once

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/solid/constitutive_model.hpp"
#include "components/mpm/solid/shapes/radial_axis.hpp"

namespace tushar::mpm::solid {

/// What a shape function asks of a particle besides its position.
template <int D>
struct Extent {
  Vec<D> size = Vec<D>::Ones();  ///< at the start, in cells
  /// Where `Shape::deforms`: column j is half the edge that lay along axis j at the start, as F has it now, in cells.
  Eigen::Matrix<double, D, D> halfEdges;
};

/// Shape functions of D dimensions that are products of those along each axis. Where `Axisymmetric`, the first axis is
/// the radius and the second, if any, the axis of symmetry; all integrals are per radian.
template <int D, class Axis, bool Axisymmetric = false>
struct TensorShape {
  static constexpr int dimension = D;
  /// Nodes beyond those of a patch that its particles touch, and layers of nodes beyond the sides of the grid.
  static constexpr int ghostNodes = Axis::ghostNodes;
  /// Cells beyond a patch whose particles touch its nodes.
  static constexpr int reach = 1 + Axis::ghostNodes;
  /// Nodes beyond a patch that particles in its own cells and in those within reach touch.
  static constexpr int storedNodes = Axis::ghostNodes + reach;
  static constexpr bool hasSize = Axis::hasSize;
  static constexpr bool deforms = false;
  static constexpr bool axisymmetric = Axisymmetric;

  /// S_i and its gradient (1/m) at every node i that a particle touches; where axisymmetric, S_i / r (1/m), too.
  struct Stencil {
    static constexpr int dimension = D;
    static constexpr int nodes = Axis::nodes;  ///< along each axis
    static constexpr bool axisymmetric = Axisymmetric;

    Index<D> first;
    std::array<std::array<double, Axis::nodes>, D> s, ds;  ///< values and slopes along each axis
    std::array<double, Axis::nodes> hoop;

    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent)
        : Stencil(CellFrame<D>(level, cell), cell, x, extent) {}
    Stencil(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      const Vec<D> xi = frame.coordinates(x);
      for (int d = Axisymmetric ? 1 : 0; d < D; ++d) {
        const auto k = static_cast<std::size_t>(d);
        first[d] = cell[d] + Axis::fill(xi[d], extent.size[d], s[k], ds[k]);
        for (double& slope : ds[k]) slope *= frame.inverseSpacing[d];
      }
      if constexpr (Axisymmetric) {
        const double inverse = frame.inverseSpacing[0];
        first[0] = cell[0] + RadialAxis<Axis>::fill(x[0] * inverse, frame.origin[0] * inverse, extent.size[0], s[0], ds[0],
                                                       hoop);
        for (double& h : hoop) h *= inverse;
        for (double& slope : ds[0]) slope *= inverse;
      }
    }

    /// Calls `visit(node, S, gradient)` in the same order of nodes for every particle.
    template <class Visit>
    void forEachNode(Visit&& visit) const {
      Box offsets{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) offsets.upper[d] = Axis::nodes;
      forEach<D>(offsets, [&](const Index<D>& k) {
        double value = 1;
        Vec<D> gradient = Vec<D>::Ones();
        for (int d = 0; d < D; ++d) {
          const auto axis = static_cast<std::size_t>(d), node = static_cast<std::size_t>(k[d]);
          value *= s[axis][node];
          for (int e = 0; e < D; ++e) gradient[e] *= (e == d ? ds : s)[axis][node];
        }
        visit(first + k, value, gradient);
      });
    }
  };
};

template <int D>
using LinearShape = TensorShape<D, LinearAxis>;
template <int D>
using GimpShape = TensorShape<D, GimpAxis>;
template <int D>
using QuadraticShape = TensorShape<D, QuadraticAxis>;
template <int D>
using CubicShape = TensorShape<D, CubicAxis>;
template <int D>
using AxisymmetricLinearShape = TensorShape<D, LinearAxis, true>;
template <int D>
using AxisymmetricGimpShape = TensorShape<D, GimpAxis, true>;

}  // namespace tushar::mpm::solid
