#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"

namespace tushar::mpm::solid {

/// The neo-Hookean material of the manufactured solutions: sigma = (lambda ln J I + G (F Fᵀ - I)) / J.
/// Source: Kamojjala, Brannon, Sadeghirad & Guilkey, Eng. Comput. 31 (2015) 193.
struct CnhMms {
  struct State {};
  using Capabilities =
      CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature, capability::NominalTangent>;
  static constexpr std::string_view name = "cnh_mms";
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]

  static const input::Schema<CnhMms>& schema() {
    static const input::Schema<CnhMms> schema =
        input::Schema<CnhMms>("cnh_mms", "The neo-Hookean material of manufactured solutions (<RunMMSProblem>).")
            .required("bulk_modulus", &CnhMms::bulkModulus, "Pa", "K", input::positive())
            .required("shear_modulus", &CnhMms::shearModulus, "Pa", "G", input::positive());
    return schema;
  }
  /// Lamé's first constant [Pa].
  double lambda() const { return bulkModulus - 2.0 / 3.0 * shearModulus; }

  State initialState() const { return {}; }
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    const Matrix3& f = d.deformationGradient;
    const double j = f.determinant();
    Matrix3 stress = shearModulus * (f * f.transpose());
    stress.diagonal().array() += lambda() * std::log(j) - shearModulus;
    return stress / j;
  }
  /// Computes the tangent d tau = lambda tr h I + G (h B + B hᵀ) with B = F Fᵀ.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3& oldStress, const State&) const {
    const Matrix3& f = d.deformationGradient;
    State none;
    const Matrix3 b = f * f.transpose(), tau = f.determinant() * updateStress(d, oldStress, none);
    return solid::nominalTangent(f, tau, [&](const Matrix3& h) {
      const Matrix3 hb = h * b;
      Matrix3 change = shearModulus * (hb + hb.transpose());
      change.diagonal().array() += lambda() * h.trace();
      return change;
    });
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }
};
static_assert(ConstitutiveModel<CnhMms>);

}  // namespace tushar::mpm::solid
