#pragma once

#include <Eigen/LU>

#include <cmath>
#include <limits>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// A viscous liquid, sigma = -p I + 2 mu dev D, p = K (J^-gamma - 1): the equation of state of Murnaghan, Proc. Natl.
/// Acad. Sci. 30 (1944) 244, without his division of K by gamma, as in Uintah.
struct Water {
  struct State {};
  using Capabilities =
      CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed, capability::InitialWaveSpeed>;
  static constexpr std::string_view name = "water";
  static constexpr bool strainEnergyIsRate = true;

  double bulkModulus = 0;  ///< bulk modulus K [Pa]
  double viscosity = 0;    ///< viscosity mu [Pa s]
  double exponent = 0;     ///< gamma [1]

  static const input::Schema<Water>& schema() {
    static const input::Schema<Water> schema =
        input::Schema<Water>("water", "A viscous, nearly incompressible liquid.")
            .required("bulk_modulus", &Water::bulkModulus, "Pa", "K", input::positive())
            .required("viscosity", &Water::viscosity, "Pa s", "mu", input::nonNegative())
            .required("gamma", &Water::exponent, "1", "exponent of the density in the pressure", input::positive());
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    Matrix3 stress = viscosity * deviator(d.velocityGradient + d.velocityGradient.transpose());
    stress.diagonal().array() -= bulkModulus * (stiffening(d) - 1);
    return stress;
  }
  /// Initial wave speed [m/s], computed without gamma as in Uintah.
  double initialWaveSpeed(double initialDensity) const { return std::sqrt(bulkModulus / initialDensity); }
  /// The wave speed: c² = dp/drho.
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const double j = d.deformationGradient.determinant();
    return std::sqrt(exponent * stiffening(d) * bulkModulus * j / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  /// The factor J^-gamma; NaN for an inverted particle, also if gamma is an integer.
  double stiffening(const Deformation& d) const {
    const double j = d.deformationGradient.determinant();
    return j > 0 ? std::pow(j, -exponent) : std::numeric_limits<double>::quiet_NaN();
  }
};
static_assert(ConstitutiveModel<Water>);

}  // namespace tushar::mpm::solid
