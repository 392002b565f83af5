#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/cube_root.hpp"
#include "components/mpm/solid/constitutive/initial_pressure.hpp"
#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Compressible neo-Hookean elasticity of Simo & Hughes, Computational Inelasticity (1998), section 9.2, with
/// W = K/2 ((J² - 1)/2 - ln J) + G/2 (J^(-2/3) tr(F Fᵀ) - 3).
struct CompNeoHook {
  struct State {};
  using Capabilities =
      CapabilityList<capability::DependsOnDeformationOnly, capability::IgnoresTemperature, capability::Vectorized,
                     capability::NominalTangent, capability::BulkSpeed, capability::InitialVolumeRatio>;
  static constexpr std::string_view name = "comp_neo_hook";
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]
  bool startsUnderPressure = false;
  double initialPressure = 0;  ///< initial pressure [Pa]

  static const input::Schema<CompNeoHook>& schema() {
    static const input::Schema<CompNeoHook> schema = [] {
      input::Schema<CompNeoHook> tags("comp_neo_hook", "Compressible neo-Hookean elasticity.");
      tags.required("bulk_modulus", &CompNeoHook::bulkModulus, "Pa", "K", input::positive())
          .required("shear_modulus", &CompNeoHook::shearModulus, "Pa", "G", input::nonNegative());
      for (const char* tag :
           {"yield_stress", "hardening_modulus", "alpha", "yield_distrib", "yield_range", "yield_seed"})
        tags.ignored(tag, "it does not yield unless <usePlasticity> is true");
      for (const char* tag : {"strain_limit", "reduction_factor"}) tags.ignored(tag, "from older versions of Uintah");
      tags.ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it");
      addInitialPressure(tags);
      refuseSwitch(tags, "usePlasticity", "for plasticity, use the model UCNH");
      refuseSwitch(tags, "reinitializeCMData", "bodies keep their state from the start");
      return tags;
    }();
    return schema;
  }
  State initialState() const { return {}; }
  double initialVolumeRatio() const { return startsUnderPressure ? volumeRatioUnder(initialPressure, bulkModulus) : 1; }

  /// Computes J sigma = K/2 (J² - 1) I + G dev(J^(-2/3) F Fᵀ).
  template <class Real>
  TensorOf<Real> kirchhoffStress(const TensorOf<Real>& f) const {
    const Real j = solid::determinant(f);
    const Real pressure = bulkModulus / 2 * (j * j - 1), scale = shearModulus * inverseCubeRootSquared(j);
    TensorOf<Real> b = leftCauchyGreen(f);
    const Real third = (b(0, 0) + b(1, 1) + b(2, 2)) / 3.0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) b(i, k) = i == k ? scale * (b(i, i) - third) + pressure : scale * b(i, k);
    return b;
  }
  Matrix3 updateStress(const Deformation& d, const Matrix3&, State&) const {
    return kirchhoffStress(d.deformationGradient) / d.deformationGradient.determinant();
  }
  /// Computes the tangent d tau = K J² tr h I + G dev(h b + b hᵀ - 2/3 tr h b) with b = J^(-2/3) F Fᵀ, where h = e_k
  /// e_l.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3&, const State&) const {
    const Matrix3& f = d.deformationGradient;
    const double j = f.determinant();
    const Matrix3 b = f * f.transpose() / std::cbrt(j * j);
    return solid::nominalTangent(f, kirchhoffStress(f), [&](int k, int l) {
      const double trace = k == l ? 1 : 0;
      Matrix3 change = -2.0 / 3.0 * trace * b;
      for (int i = 0; i < 3; ++i) change(k, i) += b(l, i);
      for (int i = 0; i < 3; ++i) change(i, k) += b(l, i);
      const double mean = (change(0, 0) + change(1, 1) + change(2, 2)) / 3;
      change *= shearModulus;
      change.diagonal().array() += bulkModulus * j * j * trace - shearModulus * mean;
      return change;
    });
  }
  template <class Real>
  Real waveSpeed(double initialDensity, const TensorOf<Real>& f) const {
    using std::sqrt;
    return sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) / initialDensity * solid::determinant(f));
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return waveSpeed(initialDensity, d.deformationGradient);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State&) const {
    return strainEnergyDensity(d.deformationGradient);
  }
  template <class Real>
  Real strainEnergyDensity(const TensorOf<Real>& f) const {
    const StrainInvariantsOf<Real> strain(f);
    return bulkModulus * strain.dilatation() + shearModulus / 2 * strain.isochoricFirst();
  }
};
static_assert(ConstitutiveModel<CompNeoHook>);

}  // namespace tushar::mpm::solid
