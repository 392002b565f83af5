#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Linear elasticity in rate form, sigma += (2 G dev D + K tr D I) dt with D = (L + Lᵀ)/2, as Uintah's `hypo_elastic`:
/// there is no objective rate, so the stress does not turn with the material.
struct HypoElastic {
  struct State {};
  static constexpr std::string_view name = "hypo_elastic";
  static constexpr bool usesTemperature = false;
  static constexpr bool strainEnergyIsRate = true;

  double bulkModulus = 0;   ///< K, Pa
  double shearModulus = 0;  ///< G, Pa

  static const input::Schema<HypoElastic>& schema() {
    static const input::Schema<HypoElastic> schema =
        input::Schema<HypoElastic>("hypo_elastic", "Linear elasticity in rate form, without an objective rate.")
            .required("G", &HypoElastic::shearModulus, "Pa", "shear modulus", input::nonNegative())
            .required("K", &HypoElastic::bulkModulus, "Pa", "bulk modulus", input::positive());
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State&) const {
    const Matrix3 rate = rateOfDeformation(d);
    Matrix3 increment = 2 * shearModulus * rate;
    increment.diagonal().array() += (bulkModulus - 2.0 / 3.0 * shearModulus) * rate.trace();
    return oldStress + increment * d.timeStep;
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// D : (mean stress) J dt
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress, const State&) const {
    const Matrix3 mean = 0.5 * (oldStress + stress);
    return rateOfDeformation(d).cwiseProduct(mean).sum() * d.deformationGradient.determinant() * d.timeStep;
  }

 private:
  static Matrix3 rateOfDeformation(const Deformation& d) {
    return 0.5 * (d.velocityGradient + d.velocityGradient.transpose());
  }
};
static_assert(ConstitutiveModel<HypoElastic>);

}  // namespace tushar::mpm::solid
