#pragma once

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/shapes/radial_axis.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpm {

/// The data of a particle that a shape function needs besides its position.
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
  static constexpr bool hasSize = Axis::hasSize;
  static constexpr bool deforms = false;
  static constexpr bool axisymmetric = Axisymmetric;

  /// How far a particle reaches along each axis, in cells: no node touches it that is as far away.
  static Vec<D> support(const Extent<D>& extent) {
    Vec<D> reaches;
    for (int d = 0; d < D; ++d) reaches[d] = Axis::support(extent.size[d]);
    return reaches;
  }

  /// S_i and its gradient (1/m) at every node i that a particle touches; where axisymmetric, S_i / r (1/m), too.
  struct Stencil {
    static constexpr int dimension = D;
    static constexpr int nodes = Axis::nodes;  ///< along each axis
    static constexpr bool axisymmetric = Axisymmetric;

    Index<D> first;
    std::array<Quad, Axis::nodes> s, ds;  ///< for each node along an axis, value and slope of every axis
    std::array<double, Axis::nodes> hoop;

    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent)
        : Stencil(CellFrame<D>(level, cell), cell, x, extent) {}
    [[gnu::always_inline]] Stencil(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x,
                                   const Extent<D>& extent) {
      const Quad inverse = quadOf<D>(frame.inverseSpacing), xi = quadOf<D>(frame.coordinates(x));
      const Quad node = Axis::fill(xi, quadOf<D>(extent.size), s, ds);
      for (Quad& slope : ds) slope *= inverse;
      const auto whole = __builtin_convertvector(node, QuadOfIntegers);
      for (int d = 0; d < D; ++d) first[d] = cell[d] + whole[d];
      if constexpr (Axisymmetric) fillRadially(frame, cell, x, extent);
    }

    /// Calls `visit(node, S, gradient)` in the same order of nodes for every particle.
    template <class Visit>
    [[gnu::always_inline]] void forEachNode(Visit&& visit) const {
      constexpr int n = Axis::nodes;
      Index<D> k;
      if constexpr (D == 1) {
        for (k[0] = 0; k[0] < n; ++k[0]) visitNode(k, visit);
      } else if constexpr (D == 2) {
        for (k[1] = 0; k[1] < n; ++k[1])
          for (k[0] = 0; k[0] < n; ++k[0]) visitNode(k, visit);
      } else {
        for (k[2] = 0; k[2] < n; ++k[2])
          for (k[1] = 0; k[1] < n; ++k[1])
            for (k[0] = 0; k[0] < n; ++k[0]) visitNode(k, visit);
      }
    }

   private:
    template <class Visit>
    [[gnu::always_inline]] void visitNode(const Index<D>& k, Visit&& visit) const {
      double value = 1;
      Vec<D> gradient = Vec<D>::Ones();
      for (int d = 0; d < D; ++d) {
        const std::size_t node = k[d];
        value *= s[node][d];
        for (int e = 0; e < D; ++e) gradient[e] *= (e == d ? ds : s)[node][d];
      }
      visit(first + k, value, gradient);
    }
    /// Along the first axis, where that is the radius.
    void fillRadially(const CellFrame<D>& frame, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      const double inverse = frame.inverseSpacing[0];
      std::array<double, Axis::nodes> value, slope;
      first[0] = cell[0] +
                 RadialAxis<Axis>::fill(x[0] * inverse, frame.origin[0] * inverse, extent.size[0], value, slope, hoop);
      for (std::size_t k = 0; k < Axis::nodes; ++k) {
        s[k][0] = value[k];
        ds[k][0] = slope[k] * inverse;
        hoop[k] *= inverse;
      }
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

/// S_i / r of a node, 1/m; 0 if nothing is axisymmetric.
template <class Stencil, int D = Stencil::dimension>
double hoopOf(const Stencil& stencil, const Index<D>& node) {
  if constexpr (!Stencil::axisymmetric) return 0;
  double value = stencil.hoop[node[0] - stencil.first[0]];
  for (int d = 1; d < D; ++d) value *= stencil.s[node[d] - stencil.first[d]][d];
  return value;
}

}  // namespace tushar::mpm
