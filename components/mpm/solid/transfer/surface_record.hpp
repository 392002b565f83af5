#pragma once

#include <cstring>

#include "components/mpm/solid/transfer/node_record.hpp"

namespace tushar::mpm::solid {

/// The surface of a body at a node: sums over its particles, in one piece of memory.
///
/// | numbers | |
/// |---|---|
/// | 0-2 | sum_p m_p grad S_i: out of the body, kg/m; axisymmetric kg/m^4 |
/// | 3 | sum_p S_i V_p, including images beyond symmetry planes, m^3 |
/// | 4-6 | sum_p S_i m_p x_p, kg m |
/// | 7-15 | sum_p S_i sigma_p by rows, Pa |
struct alignas(64) SurfaceRecord {
  std::array<Quad, 4> quads{};

  double* numbers() { return reinterpret_cast<double*>(this); }
  const double* numbers() const { return reinterpret_cast<const double*>(this); }

  template <int D>
  Vec<D> massGradient() const {
    return at<D>(0);
  }
  template <int D>
  Vec<D> massPosition() const {
    return at<D>(4);
  }
  double volume() const { return numbers()[3]; }
  double stress(int i, int j) const { return numbers()[7 + 3 * i + j]; }

 private:
  template <int D>
  Vec<D> at(int first) const {
    Vec<D> v;
    for (int d = 0; d < D; ++d) v[d] = numbers()[first + d];
    return v;
  }
};

/// The contribution of a particle to the surface of its body.
template <int D>
class SurfaceShare {
 public:
  /// The contribution of a particle at x [m] with its mass [kg], volume [m^3] and stress [Pa]; in the mass gradient,
  /// `weight` takes the place of the mass.
  SurfaceShare(const Vec<D>& x, double mass, double volume, double weight, const Matrix3& stress)
      : mass_(mass), gradient_{weight, weight, weight, volume}, position_(quadOf<D>(x, stress(0, 0))) {
    std::memcpy(&stress_, stress.data() + 1, sizeof(stress_));
  }
  /// Adds the contribution to a node, with the value s of the node's shape function and its gradient [1/m].
  [[gnu::always_inline]] void addTo(SurfaceRecord& record, double s, const Vec<D>& gradient) const {
    const double part = s * mass_;
    record.quads[0] += gradient_ * quadOf<D>(gradient, s);
    record.quads[1] += Quad{part, part, part, s} * position_;
    record.quads[2] += s * stress_[0];
    record.quads[3] += s * stress_[1];
  }

 private:
  double mass_;
  Quad gradient_, position_;
  std::array<Quad, 2> stress_;  ///< the stress without its first number
};

}  // namespace tushar::mpm::solid

namespace tushar::data {
template <>
struct Stored<mpm::solid::SurfaceRecord> {
  static constexpr Number number = Number::real;
  static constexpr int components = 16;
  static constexpr bool isVector = false;
};
}  // namespace tushar::data
