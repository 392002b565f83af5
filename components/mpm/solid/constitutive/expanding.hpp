#pragma once

#include "components/mpm/solid/constitutive/model.hpp"

namespace tushar::mpm::solid {

/// Thermal expansion of a body.
struct ThermalExpansion {
  double coefficient = 0;           ///< alpha, coefficient of linear expansion [1/K]
  double referenceTemperature = 0;  ///< reference temperature T_0 [K]

  /// The relative volume of a free body, J_T = (1 + alpha (T - T_0))^3.
  double volume(double temperature) const {
    const double stretch = 1 + coefficient * (temperature - referenceTemperature);
    return stretch * stretch * stretch;
  }
};

/// A neo-Hookean model whose mean stress, K/2 (J - 1/J), is reduced by that of free thermal expansion, K/2 (J_T -
/// 1/J_T), so that a free body is at rest at J = J_T; Uintah's `linear_thermal_expansion_coef`. The temperature is
/// taken at the start of the step. For explicit steps only: there is no tangent.
template <ConstitutiveModel M>
class Expanding : public ModelOf<M> {
 public:
  /// `bulkModulus` is K [Pa].
  Expanding(const M& model, double bulkModulus, const ThermalExpansion& expansion)
      : ModelOf<M>(model), bulk_modulus_(bulkModulus), expansion_(expansion) {}

  bool usesTemperature() const override { return true; }
  bool dependsOnDeformationOnly() const override { return false; }
  bool hasTangent() const override { return false; }
  void updateStress(double initialDensity, const StressPoints& points) const override {
    ModelOf<M>::updateStress(initialDensity, points);
    for (int k = 0; points.stress && k < points.count; ++k) {
      const double volume = expansion_.volume(points.temperature[k]);
      points.stress[k].diagonal().array() -= bulk_modulus_ / 2 * (volume - 1 / volume);
    }
  }

 private:
  double bulk_modulus_;
  ThermalExpansion expansion_;
};

}  // namespace tushar::mpm::solid
