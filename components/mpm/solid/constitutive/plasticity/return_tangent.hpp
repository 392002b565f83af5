#pragma once

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Derivative of the stress deviator after a radial return with respect to the strain of the step and the volume. With
/// s the trial deviator, n = s/|s|, q the amount by which the return reduces |s|, and a = (2/3)^(1/2)/(2 G) the plastic
/// strain per q:
///
///     d (s (1 - q/|s|)) = ds (1 - q/|s|) + (q/|s| n : ds - dq) n,   ds = 2 G dev de + 2 dG dev e,
///     dq (1 + (2/3)^(1/2) H a) = n : ds - (2/3)^(1/2) (d sigma_y - H a q dG/G),
///
/// where d sigma_y is taken at constant plastic strain; Simo & Hughes, Computational Inelasticity (1998),
/// section 3.3.
struct ReturnTangent {
  Matrix3 strain;                                 ///< e, strain of the step
  Matrix3 trial;                                  ///< trial deviator s [Pa]
  double modulus = 0;                             ///< modulus G [Pa]
  double excess = 0;                              ///< q, decrease of |s| by the return [Pa]
  double hardening = 0;                           ///< H = d sigma_y / d e_p [Pa]
  double byRate = 0;                              ///< d sigma_y / d ln(strain rate) [Pa]
  double modulusByVolume = 0, yieldByVolume = 0;  ///< dG / d ln J and d sigma_y / d ln J [Pa]

  /// Change of the deviator [Pa] if the strain changes by `de` and ln J by `volume`.
  Matrix3 change(const Matrix3& de, double volume) const {
    const Matrix3 ds = 2 * modulus * deviator(de) + 2 * modulusByVolume * volume * deviator(strain);
    if (excess <= 0) return ds;
    const double root = std::sqrt(2.0 / 3.0), perStress = root / (2 * modulus), size = trial.norm();
    const Matrix3 normal = trial / size;
    const double grown = ds.cwiseProduct(normal).sum(), squared = strain.squaredNorm();
    const double rate = squared > 0 ? strain.cwiseProduct(de).sum() / squared : 0.0;  // at rest byRate is 0
    const double softened = hardening * perStress * excess * modulusByVolume * volume / modulus;
    const double dq =
        (grown - root * (yieldByVolume * volume + byRate * rate - softened)) / (1 + root * hardening * perStress);
    return (1 - excess / size) * ds + (excess / size * grown - dq) * normal;
  }
};

/// The derivative df/d ln x at x, by central differences, accurate to about 1e-10.
template <class Function>
double logarithmicSlope(const Function& f) {
  constexpr double h = 1e-5;
  return (f(1 + h) - f(1 - h)) / (2 * h);
}

}  // namespace tushar::mpm::solid
