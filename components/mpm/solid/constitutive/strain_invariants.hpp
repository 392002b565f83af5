#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/cube_root.hpp"

namespace tushar::mpm::solid {

/// Invariants of b = F Fᵀ minus those of I. With these, the relative error of an energy W of small strains e is only
/// 1e-16/e, whatever the rotation: the terms linear in e, which cancel, are eliminated analytically. With G = b - I, g
/// = (tr²G - tr G²)/2, r = J^(2/3) and d = r - 1: J² - 1 = tr G + g + det G = 3 d + 3 d² + d³.
struct StrainInvariants {
  double second;  ///< g
  double third;   ///< det G
  double volume;  ///< J² - 1
  double root;    ///< r

  explicit StrainInvariants(const Matrix3& f) {
    Matrix3 strain = f * f.transpose();
    strain.diagonal().array() -= 1;
    const double trace = strain.trace();
    second = 0.5 * (trace * trace - strain.squaredNorm());
    third = strain.determinant();
    volume = trace + second + third;
    root = 1 / inverseCubeRootSquared(std::sqrt(1 + volume));
  }

  /// The first isochoric invariant, tr(b) / r - 3.
  double isochoricFirst() const { return (distance() * distance() * (root + 2) - second - third) / root; }
  /// The second isochoric invariant, I2(b) / r² - 3.
  double isochoricSecond() const {
    return (distance() * distance() * (2 * root + 1) - second - 2 * third) / (root * root);
  }
  /// The volumetric term ((J² - 1)/2 - ln J) / 2.
  double dilatation() const { return (volume - std::log1p(volume)) / 4; }

 private:
  double distance() const { return volume / (root * root + root + 1); }  ///< The term d.
};

}  // namespace tushar::mpm::solid
