#pragma once

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/solid/constitutive_model.hpp"
#include "components/mpm/solid/shapes/radial_axis.hpp"

namespace tushar::mpm::solid {

/// What a shape function asks of a particle besides its position.
template <int D>
struct Extent {
  Vec<D> size = Vec<D>::Ones();  ///< at the start, in cells
  Matrix3 deformation;           ///< F; undefined where `Shape::deforms` is false
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

  /// S_i and its gradient (1/m) at every node i that a particle touches; where axisymmetric, S_i / r (1/m), too.
  class Stencil {
   public:
    Stencil(const Level& level, const Index<D>& cell, const Vec<D>& x, const Extent<D>& extent) {
      const Vec<D> xi = CellFrame<D>(level, cell).coordinates(x);
      for (int d = 0; d < D; ++d) {
        const auto k = static_cast<std::size_t>(d);
        if constexpr (Axisymmetric) {
          if (d == 0) {
            const double inverse = level.inverseSpacing(0);
            first_[0] = cell[0] + RadialAxis<Axis>::fill(x[0] * inverse, level.nodePosition(0, cell[0]) * inverse,
                                                         extent.size[0], s_[0], ds_[0], hoop_);
            for (double& h : hoop_) h *= inverse;
            for (double& slope : ds_[0]) slope *= inverse;
            continue;
          }
        }
        first_[d] = cell[d] + Axis::fill(xi[d], extent.size[d], s_[k], ds_[k]);
        for (double& slope : ds_[k]) slope *= level.inverseSpacing(d);
      }
    }

    /// Calls `visit(node, S, gradient)`, where axisymmetric `visit(node, S, gradient, S / r)`, in the same order of
    /// nodes for every particle.
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
        if constexpr (Axisymmetric) {
          double hoop = hoop_[static_cast<std::size_t>(k[0])];
          for (int d = 1; d < D; ++d) hoop *= s_[static_cast<std::size_t>(d)][static_cast<std::size_t>(k[d])];
          visit(first_ + k, s, gradient, hoop);
        } else {
          visit(first_ + k, s, gradient);
        }
      });
    }

   private:
    Index<D> first_;
    std::array<std::array<double, Axis::nodes>, D> s_, ds_;
    std::array<double, Axis::nodes> hoop_;
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
