#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/model_types.hpp"

namespace tushar::mpm::solid {

/// A State without variables.
struct NoState {};

/// Base of models whose waves are those of linear elasticity at the current density, rho = rho_0 / det F.
struct IsotropicModuli {
  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]

  /// Wave speed, c = sqrt((K + 4/3 G) / rho).
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const NoState&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  /// Bulk wave speed, c_b = sqrt(K / rho).
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const NoState&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
};

}  // namespace tushar::mpm::solid
