#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Compressible neo-Hookean elasticity of Simo & Hughes, Computational Inelasticity (1998), section 9.2, with
/// W = K/2 ((J² - 1)/2 - ln J) + G/2 (J^(-2/3) tr(F Fᵀ) - 3).
struct CompNeoHook {
  struct State {};
  static constexpr std::string_view name = "comp_neo_hook";
  static constexpr bool usesTemperature = false;
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;   ///< K, Pa
  double shearModulus = 0;  ///< G, Pa

  static const input::Schema<CompNeoHook>& schema() {
    static const input::Schema<CompNeoHook> schema =
        input::Schema<CompNeoHook>("comp_neo_hook", "Compressible neo-Hookean elasticity.")
            .required("bulk_modulus", &CompNeoHook::bulkModulus, "Pa", "K", input::positive())
            .required("shear_modulus", &CompNeoHook::shearModulus, "Pa", "G", input::nonNegative());
    return schema;
  }
  State initialState() const { return {}; }

  /// sigma = K/2 (J - 1/J) I + G/J dev(J^(-2/3) F Fᵀ)
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    const Matrix3& f = d.deformationGradient;
    const double j = f.determinant(), scale = 1 / std::cbrt(j * j);
    Matrix3 b = scale * (f * f.transpose());
    b.diagonal().array() -= b.trace() / 3;
    b *= shearModulus / j;
    b.diagonal().array() += bulkModulus / 2 * (j - 1 / j);
    return b;
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const double density = initialDensity / d.deformationGradient.determinant();
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) / density);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    const Matrix3& f = d.deformationGradient;
    const double j = f.determinant(), trace = f.squaredNorm() / std::cbrt(j * j);
    return bulkModulus / 2 * (0.5 * (j * j - 1) - std::log(j)) + shearModulus / 2 * (trace - 3);
  }
};
static_assert(ConstitutiveModel<CompNeoHook>);

}  // namespace tushar::mpm::solid
