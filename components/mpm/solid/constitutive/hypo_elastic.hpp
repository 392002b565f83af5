#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/isotropic_moduli.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// Linear elasticity in rate form, sigma += (2 G dev D + K tr D I) dt with D = (L + Lᵀ)/2, as in Uintah's
/// `hypo_elastic`: without an objective rate, the stress does not rotate with the material.
struct HypoElastic : IsotropicModuli {
  using State = NoState;
  using Capabilities =
      CapabilityList<capability::IgnoresTemperature, capability::NominalTangent, capability::BulkSpeed>;
  static constexpr std::string_view name = "hypo_elastic";
  static constexpr bool strainEnergyIsRate = true;

  static const input::Schema<HypoElastic>& schema() {
    static const input::Schema<HypoElastic> schema =
        input::Schema<HypoElastic>("hypo_elastic", "Linear elasticity in rate form, without an objective rate.")
            .required("G", input::memberOf<HypoElastic>(&HypoElastic::shearModulus), "Pa", "shear modulus",
                      input::nonNegative())
            .required("K", input::memberOf<HypoElastic>(&HypoElastic::bulkModulus), "Pa", "bulk modulus",
                      input::positive())
            .ignored("useModifiedEOS", "Uintah does not use it either");
    return schema;
  }
  State initialState() const { return {}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State&) const {
    return oldStress + stressOf(rateOfDeformation(d)) * d.timeStep;
  }
  /// Computes the tangent d tau = J (tr h sigma + 2 G dev e + K tr e I) with e = sym(h F F_old^-1).
  Matrix9 nominalTangent(const Deformation& d, const Matrix3& oldStress, const State&) const {
    const Matrix3& f = d.deformationGradient;
    const Matrix3 step = f * d.oldDeformationGradient.inverse();
    const Matrix3 strain = 0.5 * (step + step.transpose()) - Matrix3::Identity();
    const Matrix3 stress = oldStress + stressOf(strain);
    const double j = f.determinant();
    return solid::nominalTangent(f, j * stress, [&](const Matrix3& h) {
      const Matrix3 moved = h * step, change = 0.5 * (moved + moved.transpose());
      return Matrix3(j * (h.trace() * stress + stressOf(change)));
    });
  }
  /// Strain energy of the step: D : (mean stress) J dt.
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    const Matrix3 mean = 0.5 * (oldStress + stress);
    return rateOfDeformation(d).cwiseProduct(mean).sum() * d.deformationGradient.determinant() * d.timeStep;
  }

 private:
  /// The stress 2 G dev e + K tr e I.
  Matrix3 stressOf(const Matrix3& strain) const {
    Matrix3 stress = 2 * shearModulus * strain;
    stress.diagonal().array() += (bulkModulus - 2.0 / 3.0 * shearModulus) * strain.trace();
    return stress;
  }
  static Matrix3 rateOfDeformation(const Deformation& d) {
    return 0.5 * (d.velocityGradient + d.velocityGradient.transpose());
  }
};
static_assert(ConstitutiveModel<HypoElastic>);

}  // namespace tushar::mpm::solid
