#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"

namespace tushar::mpm::solid {

/// The neo-Hookean material of the manufactured solutions: sigma = (lambda ln J I + G (F Fᵀ - I)) / J.
/// Source: Kamojjala, Brannon, Sadeghirad & Guilkey, Eng. Comput. 31 (2015) 193.
struct CnhMms {
  struct State {};
  using Capabilities = CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature,
                                      capability::Vectorized, capability::NominalTangent>;
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
  template <class Real>
  TensorOf<Real> cauchyStress(const TensorOf<Real>& f, const Real& j) const {
    const Real pressure = lambda() * logarithm(j) - shearModulus;
    TensorOf<Real> stress;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        Real sum = shearModulus * f(i, 0) * f(k, 0);
        for (int l = 1; l < 3; ++l) sum += shearModulus * f(i, l) * f(k, l);
        if (i == k) sum += pressure;
        stress(i, k) = sum / j;
      }
    return stress;
  }
  template <class Real>
  TensorOf<Real> kirchhoffStress(const TensorOf<Real>& f) const {
    const Real j = solid::determinant(f);
    TensorOf<Real> stress = cauchyStress(f, j);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) stress(i, k) *= j;
    return stress;
  }
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return cauchyStress(d.deformationGradient, d.deformationGradient.determinant());
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
  template <class Real>
  Real waveSpeed(double initialDensity, const TensorOf<Real>& f) const {
    using std::sqrt;
    return sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * solid::determinant(f) / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return waveSpeed(initialDensity, d.deformationGradient);
  }
  /// Returns 0 as in Uintah, so that StrainEnergy can be compared.
  template <class Real>
  Real strainEnergyDensity(const TensorOf<Real>&) const {
    return 0.0;
  }
  double strainEnergyDensity(const Deformation&, const Matrix3&, const Matrix3&, const State&) const { return 0; }

 private:
  static double logarithm(double x) { return std::log(x); }
  static Lanes logarithm(const Lanes& x) {
    return Lanes::of([&](int lane) { return std::log(x[lane]); });
  }
};
static_assert(ConstitutiveModel<CnhMms>);

}  // namespace tushar::mpm::solid
