#pragma once

#include <algorithm>

#include "components/mpm/solid/constitutive/arenisca/constants.hpp"
#include "components/mpm/solid/tensor.hpp"

namespace tushar::mpm::solid::arenisca {

/// Tangent moduli of an isotropic solid [Pa].
struct Moduli {
  double bulk, shear;

  /// The stress 3 K iso e + 2 G dev e.
  Matrix3 stress(const Matrix3& strain) const {
    Matrix3 result = 2 * shear * strain;
    result.diagonal().array() += (bulk - 2.0 / 3.0 * shear) * strain.trace();
    return result;
  }
  Matrix3 strain(const Matrix3& stress) const {
    Matrix3 result = stress / (2 * shear);
    result.diagonal().array() += (1 / (9 * bulk) - 1 / (6 * shear)) * stress.trace();
    return result;
  }
};

/// The reduction of the bulk modulus by plastic compaction [Pa]: b3 exp(b4 / e_p), for a negative volumetric plastic
/// strain e_p.
inline double lossOfBulk(const Constants& c, double plasticStrain) {
  return plasticStrain < 0 ? c.b3 * std::exp(c.b4 / plasticStrain) : 0.0;
}

/// Porosity of the unloaded, saturated material.
inline double currentPorosity(const Constants& c, double plasticStrain) {
  const double pores = c.porosity() * std::exp(plasticStrain * c.matrixBulk() / c.mixedBulk());
  return pores / ((1 - c.porosity()) * std::exp(plasticStrain * c.fluidBulk / c.mixedBulk()) + pores);
}

/// Bulk modulus of the saturated material [Pa], from that of the dry material, K_d: Gassmann, Vierteljahrsschr.
/// Naturforsch. Ges. Zürich 96 (1951) 1, but with phi / K_m subtracted once more, as in Uintah's Arenisca.
inline double saturatedBulk(const Constants& c, double plasticStrain) {
  const double grains = c.matrixBulk(), dry = c.b0 - lossOfBulk(c, plasticStrain);
  const double phi = currentPorosity(c, plasticStrain), alpha = 1 - dry / grains;
  return dry + alpha * alpha / ((alpha - phi) / grains + (1 / c.fluidBulk - 1 / grains) * phi);
}

/// Tangent moduli for a trace of the stress [Pa] and a volumetric plastic strain:
/// K = b0 + b1 exp(b2 / I1) - b3 exp(b4 / e_p) in compression, G = g0 or 3/2 K (1 - 2 nu) / (1 + nu) with
/// nu = g1 + g2 exp(b2 / I1) where both are given; saturatedBulk() where a fluid fills the pores. Homel, Guilkey &
/// Brannon, Acta Mech. 227 (2016) 279. Arenisca without a number: b0 and g0.
inline Moduli moduli(const Constants& c, double i1, double plasticStrain) {
  Moduli result{c.b0, c.g0};
  if (c.hasTangentCap()) return result;
  if (plasticStrain <= 0) {
    if (i1 < 0) {
      const double pressed = std::exp(c.b2 / i1);
      result.bulk += c.b1 * pressed;
      const double nu = c.g1 + c.g2 * pressed;
      if (c.hasPoissonRatio()) result.shear = 1.5 * result.bulk * (1 - 2 * nu) / (1 + nu);
    }
    result.bulk -= lossOfBulk(c, plasticStrain);
  }
  if (c.isSaturated(plasticStrain)) result.bulk = saturatedBulk(c, plasticStrain);
  return result;
}

/// The largest shear modulus of moduli() [Pa]; with g1 and g2, it is reached at an intermediate pressure. With u = 1 +
/// nu, which is linear in exp(b2 / I1), the shear modulus is 3/2 (a + b u) (3 / u - 2), where a + b u is the bulk
/// modulus. Its slope vanishes at u² = -3/2 a / b.
inline double greatestShear(const Constants& c) {
  if (!c.hasPoissonRatio()) return c.g0;
  const auto shear = [&](double pressed) {
    const double nu = c.g1 + c.g2 * pressed;
    return 1.5 * (c.b0 + c.b1 * pressed) * (1 - 2 * nu) / (1 + nu);
  };
  double greatest = std::max({c.g0, shear(0), shear(1)});
  if (c.b1 > 0) {
    const double b = c.b1 / c.g2, a = c.b0 - b * (1 + c.g1), square = -1.5 * a / b;
    const double pressed = square > 0 ? (std::sqrt(square) - 1 - c.g1) / c.g2 : 0;
    if (pressed > 0 && pressed < 1) greatest = std::max(greatest, shear(pressed));
  }
  return greatest;
}

/// I1 at the end of the cap, without the contribution of the fluid [Pa]: the crush curve X = p0 + ln(1 + e_p / p3) / p1
/// for -p3 < e_p <= 0 and X = p0 (1 + e_p)^(1 / (p0 p1 p3)) beyond, multiplied by K / K_dry if a fluid fills the pores.
/// Once all pores have collapsed, the cap has no end.
inline double capEnd(const Constants& c, double plasticStrain) {
  if (plasticStrain <= -c.p3) return 1e12 * c.p0;
  const double dry = plasticStrain <= 0 ? c.p0 + std::log((plasticStrain + c.p3) / c.p3) / c.p1
                                        : c.p0 * std::pow(1 + plasticStrain, 1 / (c.p0 * c.p1 * c.p3));
  if (c.hasTangentCap() || !c.isSaturated(plasticStrain)) return dry;
  const double dryBulk = c.b0 + c.b1 * std::exp(2 * c.b2 / dry) - lossOfBulk(c, plasticStrain);
  return dry * moduli(c, dry / 2, plasticStrain).bulk / dryBulk;
}

/// Derivative of zeta, the trace of the stress that the fluid bears, with respect to the volumetric plastic strain
/// [Pa].
inline double fluidStiffness(const Constants& c, double zeta, double plasticStrain) {
  if (!c.isSaturated(plasticStrain)) return 0;
  const double grains = c.matrixBulk(), fluid = c.fluidBulk, phi = c.porosity(), volume = std::exp(plasticStrain);
  return 3 * volume * fluid * grains /
         (volume * (fluid + grains) - (1 - phi) * grains * std::exp(zeta / (3 * grains)) -
          phi * fluid * std::exp((3 * c.fluidPressure + zeta) / (3 * fluid)));
}

/// Pressure of the fluid at a volumetric strain [Pa].
inline double porePressure(const Constants& c, double strain) {
  if (!c.isSaturated(strain)) return 0;
  const double mixed = c.mixedBulk(), grains = std::exp(strain * c.fluidBulk / mixed),
               pores = std::exp(strain * c.matrixBulk() / mixed), phi = c.porosity();
  return c.fluidPressure +
         c.fluidBulk * (std::log((1 - phi) * grains + phi * pores) - strain * (1 + c.matrixBulk() / mixed));
}

}  // namespace tushar::mpm::solid::arenisca
