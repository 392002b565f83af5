#pragma once

#include <cmath>

#include "components/mpm/solid/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// A material without stress, for bodies whose motion a contact prescribes.
struct Rigid {
  struct State {};
  static constexpr std::string_view name = "rigid";
  static constexpr bool usesTemperature = false;
  static constexpr bool dependsOnDeformationOnly = true;
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;   ///< Pa, in scenes only
  double shearModulus = 0;  ///< Pa, in scenes only

  static const input::Schema<Rigid>& schema() {
    static const input::Schema<Rigid> schema =
        input::Schema<Rigid>("rigid", "No stress at all: for bodies that a contact moves.")
            .required("bulk_modulus", &Rigid::bulkModulus, "Pa", "accepted for Uintah's sake: nothing depends on it",
                      input::nonNegative())
            .required("shear_modulus", &Rigid::shearModulus, "Pa", "accepted for Uintah's sake: nothing depends on it",
                      input::nonNegative());
    return schema;
  }
  State initialState() const { return {}; }
  Matrix3 updateStress(const Deformation&, const Matrix3&, State&) const { return Matrix3::Zero(); }
  /// A wave so slow that other materials decide on the time step.
  double waveSpeed(double, const Deformation&, const Matrix3&, const State&) const { return 1e-10; }
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }
};
static_assert(ConstitutiveModel<Rigid>);

}  // namespace tushar::mpm::solid
