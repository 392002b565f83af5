#pragma once

#include <cmath>
#include <type_traits>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/cube_root.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"

namespace tushar::mpm::solid {

/// Invariants of b = F Fᵀ minus those of I. With these, the relative error of an energy W of small strains e is only
/// 1e-16/e, whatever the rotation: the terms linear in e, which cancel, are eliminated analytically. With G = b - I, g
/// = (tr²G - tr G²)/2, r = J^(2/3) and d = r - 1: J² - 1 = tr G + g + det G = 3 d + 3 d² + d³.
template <class Real>
struct StrainInvariantsOf {
  Real second;  ///< g
  Real third;   ///< det G
  Real volume;  ///< J² - 1
  Real root;    ///< r

  explicit StrainInvariantsOf(const TensorOf<Real>& f) {
    using std::sqrt;
    TensorOf<Real> strain = leftCauchyGreen(f);
    for (int i = 0; i < 3; ++i) strain(i, i) -= 1;
    const Real trace = solid::trace(strain);
    second = 0.5 * (trace * trace - squaredNorm(strain));
    third = solid::determinant(strain);
    volume = trace + second + third;
    root = 1 / inverseCubeRootSquared(Real(sqrt(1 + volume)));
  }

  /// tr(b) / r - 3
  Real isochoricFirst() const { return (distance() * distance() * (root + 2) - second - third) / root; }
  /// I2(b) / r² - 3
  Real isochoricSecond() const {
    return (distance() * distance() * (2 * root + 1) - second - 2 * third) / (root * root);
  }
  /// The volumetric term ((J² - 1)/2 - ln J) / 2.
  Real dilatation() const {
    if constexpr (std::is_same_v<Real, Lanes>)
      return (volume - Lanes::of([&](int lane) { return std::log1p(volume[lane]); })) / 4;
    else
      return (volume - std::log1p(volume)) / 4;
  }

 private:
  Real distance() const { return volume / (root * root + root + 1); }  ///< d
};
using StrainInvariants = StrainInvariantsOf<double>;

}  // namespace tushar::mpm::solid
