#pragma once

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/solid/constitutive_model.hpp"
#include "components/mpm/solid/shapes/axis_shapes.hpp"

namespace tushar::mpm::solid {

/// What a shape function asks of a particle besides its position.
template <int D>
struct Extent {
  Vec<D> size = Vec<D>::Ones();  ///< at the start, in cells
  Matrix3 deformation;           ///< F; undefined where `Shape::deforms` is false
};

/// Shape functions of D dimensions that are products of those along each axis.
template <int D, class Axis>
struct TensorShape {
  static constexpr int dimension = D;
  /// Nodes beyond those of a patch that its particles touch, and layers of nodes beyond the sides of the grid.
  static constexpr int ghostNodes = Axis::ghostNodes;
  /// Cells beyond a patch whose particles touch its nodes.
  static constexpr int reach = 1 + Axis::ghostNodes;
  static constexpr bool hasSize = Axis::hasSize;
  static constexpr bool deforms = false;

  /// S_i and its gradient (1/m) at every node i that a particle touches.
  class Stencil {
   public:
    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      const Vec<D> xi = CellFrame<D>(level, cell).coordinates(x);
      for (int d = 0; d < D; ++d) {
        const auto k = static_cast<std::size_t>(d);
        first_[d] = cell[d] + Axis::fill(xi[d], extent.size[d], s_[k], ds_[k]);
        for (double& slope : ds_[k]) slope *= level.inverseSpacing(d);
      }
    }

    /// Calls `visit(node, S, gradient)` in the same order of nodes for every particle.
    template <class Visit>
    void forEachNode(Visit&& visit) const {
      Box offsets{{}, Index3::filled(1)};
      for (int d = 0; d < D; ++d) offsets.upper[d] = Axis::nodes;
      forEach<D>(offsets, [&](const Index<D>& k) {
        double s = 1;
        Vec<D> gradient = Vec<D>::Ones();
        for (int d = 0; d < D; ++d) {
          const auto axis = static_cast<std::size_t>(d), node = static_cast<std::size_t>(k[d]);
          s *= s_[axis][node];
          for (int e = 0; e < D; ++e) gradient[e] *= (e == d ? ds_ : s_)[axis][node];
        }
        visit(first_ + k, s, gradient);
      });
    }

   private:
    Index<D> first_;
    std::array<std::array<double, Axis::nodes>, D> s_, ds_;
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

}  // namespace tushar::mpm::solid
