#pragma once

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// A material without stress, for bodies whose motion a contact prescribes.
struct Rigid {
  struct State {};
  using Capabilities =
      CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature, capability::OwnViscosity>;
  static constexpr std::string_view name = "rigid";
  static constexpr bool strainEnergyIsRate = false;
  static constexpr ArtificialViscosity ownViscosity{0, 0};

  static const input::Schema<Rigid>& schema() {
    static const input::Schema<Rigid> schema =
        input::Schema<Rigid>("rigid", "No stress at all: for bodies that a contact moves.")
            .ignored("bulk_modulus", "nothing depends on it")
            .ignored("shear_modulus", "nothing depends on it")
            .ignored("K", "nothing depends on it")
            .ignored("G", "nothing depends on it")
            .ignored("useModifiedEOS", "nothing depends on it")
            .ignored("alpha", "nothing depends on it")
            .ignored("coeff_thermal_expansion", "nothing depends on it");
    return schema;
  }
  State initialState() const { return {}; }
  Matrix3 updateStress(const Deformation&, const Matrix3&, State&) const { return Matrix3::Zero(); }
  /// So slow that other materials limit the time step.
  double waveSpeed(double, const Deformation&, const Matrix3&, const State&) const { return 1e-10; }
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }
};
static_assert(ConstitutiveModel<Rigid>);

}  // namespace tushar::mpm::solid
