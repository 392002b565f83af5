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
    static const input::Schema<Rigid> schema = [] {
      input::Schema<Rigid> tags("rigid", "No stress: for bodies that a contact moves.");
      for (const char* tag :
           {"bulk_modulus", "shear_modulus", "K", "G", "useModifiedEOS", "alpha", "coeff_thermal_expansion"})
        tags.ignored(tag, "it has no effect");
      return tags;
    }();
    return schema;
  }
  State initialState() const { return {}; }
  Matrix3 updateStress(const Deformation&, const Matrix3&, State&) const { return Matrix3::Zero(); }
  /// A wave speed so low that other materials limit the time step.
  double waveSpeed(double, const Deformation&, const Matrix3&, const State&) const { return 1e-10; }
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }
};
static_assert(ConstitutiveModel<Rigid>);

}  // namespace tushar::mpm::solid
