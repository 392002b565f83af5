#pragma once

#include "components/mpm/shapes/linear.hpp"
#include "components/mpm/shapes/radial_axis.hpp"
#include "core/base/lanes.hpp"
#include "core/base/quad.hpp"

namespace tushar::mpm {

/// The data of a particle that shape functions need besides its position.
template <int D>
struct Extent {
  Vec<D> size = Vec<D>::Ones();  ///< initial size in cells
  /// If `Shape::deforms`: half the edges in cells; column j is the deformed edge that was initially along axis j.
  Eigen::Matrix<double, D, D> halfEdges;
};

/// The factors of a row of nodes along the first axis: of S, then of its slopes along the second and third axes.
template <int D>
using RowFactors = std::array<double, D>;

/// Shape functions in D dimensions that are products of one-dimensional ones. If `Axisymmetric`, the first axis is the
/// radius and the second, if any, the axis of symmetry; all integrals are per radian.
template <int D, class Axis, bool Axisymmetric = false>
struct TensorShape {
  static constexpr int dimension = D;
  /// Number of layers of nodes, beyond the nodes of a patch, to which the patch's particles contribute; also the number
  /// of layers of nodes outside the grid.
  static constexpr int ghostNodes = Axis::ghostNodes;
  /// Number of layers of cells around a patch whose particles contribute to the nodes of the patch.
  static constexpr int reach = 1 + Axis::ghostNodes;
  static constexpr bool hasSize = Axis::hasSize;
  static constexpr bool deforms = false;
  static constexpr bool axisymmetric = Axisymmetric;

  /// The extent of a particle's support along each axis, in cells; the particle does not contribute to nodes at this
  /// distance or farther.
  static Vec<D> support(const Extent<D>& extent) {
    Vec<D> reaches;
    for (int d = 0; d < D; ++d) reaches[d] = Axis::support(extent.size[d]);
    return reaches;
  }

  /// S_i and its gradient [1/m] at every node i to which a particle contributes; in axisymmetric scenes also S_i / r
  /// [1/m].
  struct Stencil {
    static constexpr int dimension = D;
    static constexpr int nodes = Axis::nodes;  ///< number of nodes along each axis
    static constexpr bool axisymmetric = Axisymmetric;

    Index<D> first;
    std::array<Quad, Axis::nodes> s, ds;  ///< value and slope along every axis, indexed by the node along it
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

    // The factors of the nodes of a row, and of the rows j, k along the second and third axes.
    double valueAlongRow(std::size_t i) const { return s[i][0]; }
    double slopeAlongRow(std::size_t i) const { return ds[i][0]; }
    double hoopAlongRow(std::size_t i) const { return hoop[i]; }
    RowFactors<D> rowFactors(std::size_t j, std::size_t k) const {
      if constexpr (D == 1)
        return {1.0};
      else if constexpr (D == 2)
        return {s[j][1], ds[j][1]};
      else
        return {s[j][1] * s[k][2], ds[j][1] * s[k][2], s[j][1] * ds[k][2]};
    }

    /// Calls `visit(node, S, gradient)` for every node i, in the same order for every particle.
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
    /// Fills the factors along the first axis if it is the radius.
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

  /// The stencils of several particles of a cell, bitwise equal to those of Stencil. They are computed in advance with
  /// one lane per particle, so that loops over nodes only load them.
  class Stencils {
   public:
    static constexpr int dimension = D;
    static constexpr int nodes = Axis::nodes;
    static constexpr bool haveSameNodes = ghostNodes == 0;

    /// One of these stencils, used in loops over rows of nodes.
    struct Member {
      static constexpr int dimension = D;
      static constexpr int nodes = Axis::nodes;
      static constexpr bool axisymmetric = Axisymmetric;

      const Stencils& all;
      int lane;
      Index<D> first;

      double valueAlongRow(std::size_t i) const { return all.s_[0][i][lane]; }
      double slopeAlongRow(std::size_t i) const { return all.ds_[0][i][lane]; }
      double hoopAlongRow(std::size_t i) const { return all.hoop_[i][lane]; }
      RowFactors<D> rowFactors(std::size_t j, std::size_t k) const {
        if constexpr (D == 1) return {1.0};
        const auto& factors = all.factors_[k * Axis::nodes + j];
        RowFactors<D> own;
        for (std::size_t d = 0; d < D; ++d) own[d] = factors[d][lane];
        return own;
      }
    };

    /// Constructs stencils for particles at x [m] in a cell, with their initial sizes [cells]; lanes without a particle
    /// repeat another one.
    [[gnu::always_inline]] Stencils(const CellFrame<D>& frame, const Index<D>& cell, const std::array<Lanes, D>& x,
                                    const std::array<Lanes, D>& size)
        : cell_(cell) {
      for (std::size_t d = 0; d < D; ++d) {
        const double origin = frame.origin[static_cast<int>(d)], inverse = frame.inverseSpacing[static_cast<int>(d)];
        if (!(Axisymmetric && d == 0))
          first_[d] = Axis::fill(((x[d] - origin) * inverse).values(), size[d].values(), s_[d], ds_[d]);
        else if constexpr (Axisymmetric)
          fillRadially(origin, inverse, x[0], size[0]);
        for (Real& slope : ds_[d]) slope *= inverse;
      }
      multiplyRows();
    }

    // The same factors, for all of these stencils.
    Lanes valueAlongRow(std::size_t i) const { return s_[0][i]; }
    Lanes slopeAlongRow(std::size_t i) const { return ds_[0][i]; }
    std::array<Lanes, D> rowFactors(std::size_t j, std::size_t k) const {
      if constexpr (D == 1) return {Lanes(1.0)};
      std::array<Lanes, D> factors;
      for (std::size_t d = 0; d < D; ++d) factors[d] = factors_[k * n + j][d];
      return factors;
    }

    Member operator[](int lane) const { return {*this, lane, first(lane)}; }
    /// The first node of one of these stencils.
    Index<D> first(int lane) const {
      Index<D> node = cell_;
      for (std::size_t d = 0; d < D; ++d) node[static_cast<int>(d)] += static_cast<int>(first_[d][lane]);
      return node;
    }
    /// Calls `visit(at, S, gradient)` for the nodes of all of these stencils, with their number in the order of
    /// Stencil::forEachNode; the results are bitwise equal to those of Stencil.
    template <class Visit>
    [[gnu::always_inline]] void forEachNode(Visit&& visit) const {
      std::size_t at = 0;
      for (std::size_t k = 0; k < (D < 3 ? 1 : n); ++k)
        for (std::size_t j = 0; j < (D < 2 ? 1 : n); ++j)
          for (std::size_t i = 0; i < n; ++i, ++at) {
            const std::array<std::size_t, 3> node{i, j, k};
            Real value = s_[0][i];
            for (std::size_t d = 1; d < D; ++d) value *= s_[d][node[d]];
            std::array<Lanes, D> gradient;
            for (std::size_t e = 0; e < D; ++e) {
              Real slope = e == 0 ? ds_[0][i] : s_[0][i];
              for (std::size_t d = 1; d < D; ++d) slope *= e == d ? ds_[d][node[d]] : s_[d][node[d]];
              gradient[e] = slope;
            }
            visit(at, Lanes(value), gradient);
          }
    }
    /// S_i / r of node `at` in the order of forEachNode [1/m], bitwise equal to hoopOf.
    Lanes hoop(std::size_t at) const requires(Axisymmetric) {
      Real value = hoop_[at % n];
      if constexpr (D == 2) value *= s_[1][at / n];
      return value;
    }

   private:
    using Real = Lanes::Register;
    static constexpr std::size_t n = Axis::nodes, rows = D == 1 ? 1 : D == 2 ? n : n * n;

    void multiplyRows() {
      if constexpr (D == 2)
        for (std::size_t j = 0; j < n; ++j) factors_[j] = {s_[1][j], ds_[1][j]};
      if constexpr (D == 3)
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t j = 0; j < n; ++j)
            factors_[k * n + j] = {s_[1][j] * s_[2][k], ds_[1][j] * s_[2][k], s_[1][j] * ds_[2][k]};
    }
    void fillRadially(double origin, double inverse, const Lanes& x, const Lanes& size) {
      for (int lane = 0; lane < Lanes::count; ++lane) {
        std::array<double, n> value, slope, hoop;
        first_[0][lane] = RadialAxis<Axis>::fill(x[lane] * inverse, origin * inverse, size[lane], value, slope, hoop);
        for (std::size_t k = 0; k < n; ++k) {
          s_[0][k][lane] = value[k];
          ds_[0][k][lane] = slope[k];
          hoop_[k][lane] = hoop[k] * inverse;
        }
      }
    }

    Index<D> cell_;
    std::array<Real, D> first_;                  ///< factors for each axis and each node along it
    std::array<std::array<Real, n>, D> s_, ds_;  ///< by axis and node along it
    std::array<Real, Axisymmetric ? n : 0> hoop_;
    std::array<std::array<Real, D>, D == 1 ? 0 : rows> factors_;
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

/// S_i / r of a node [1/m]; 0 if the scene is not axisymmetric.
template <class Stencil, int D = Stencil::dimension>
double hoopOf(const Stencil& stencil, const Index<D>& node) {
  if constexpr (!Stencil::axisymmetric) return 0;
  double value = stencil.hoop[node[0] - stencil.first[0]];
  for (int d = 1; d < D; ++d) value *= stencil.s[node[d] - stencil.first[d]][d];
  return value;
}

}  // namespace tushar::mpm
