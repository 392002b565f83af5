#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// An ideal gas, p = (gamma - 1) rho c_v T, heated and cooled by its work: dT = -p dJ / (J rho c_v). Its stress is
/// (p_ref - p) I. The reference pressure and the coefficients of the artificial viscosity are those of Uintah.
struct IdealGas {
  struct State {};
  using Capabilities =
      CapabilityList<capability::ConstantsOfMaterial, capability::OwnViscosity, capability::TemperatureChange>;
  static constexpr std::string_view name = "ideal_gas";
  static constexpr bool strainEnergyIsRate = true;
  static constexpr ArtificialViscosity ownViscosity{0, 6.25};

  MaterialConstants material;
  double ratio = 0;              ///< gamma [1]
  double specificHeat = 0;       ///< specific heat c_v [J/(kg K)]
  double referencePressure = 0;  ///< reference pressure [Pa]

  static const input::Schema<IdealGas>& schema() {
    static const input::Schema<IdealGas> schema =
        input::Schema<IdealGas>("ideal_gas", "An ideal gas; its artificial viscosity has the coefficients 0 and 6.25.")
            .required("gamma", &IdealGas::ratio, "1", "ratio of the specific heats", input::greaterThan(1))
            .required("specific_heat", &IdealGas::specificHeat, "J/(kg K)", "c_v", input::positive())
            .value("Pref", &IdealGas::referencePressure, 101325, "Pa", "reference pressure, at which the stress is 0");
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return (referencePressure - pressure(d)) * Matrix3::Identity();
  }
  /// The wave speed: c² = gamma (gamma - 1) c_v T.
  double waveSpeed(double, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(ratio * (ratio - 1) * specificHeat * d.temperature);
  }
  double temperatureChange(const Deformation& d, const Matrix3&, const State&) const {
    const double growth = d.deformationGradient.determinant() / d.oldDeformationGradient.determinant() - 1;
    return -(ratio - 1) * d.temperature * growth;
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  double pressure(const Deformation& d) const {
    return (ratio - 1) * material.density / d.deformationGradient.determinant() * specificHeat * d.temperature;
  }
};
static_assert(ConstitutiveModel<IdealGas>);

}  // namespace tushar::mpm::solid
