#pragma once

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/constitutive/root_between.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Linear elasticity with the yield surface of Drucker and Prager, J2^(1/2) + alpha I1 = k with I1 = tr sigma, plastic
/// flow by the same function with alpha_p, and a strength k that changes with the plastic strain at the point and
/// around it; Burghardt et al., Comput. Methods Appl. Mech. Engrg. 225 (2012) 55. For a plastic strain rate l' M, |M| =
/// 1, k = k_o + eta + eta_n, d eta/dt = h_local l', d eta_n/dt = h_nonlocal times the mean of l' within l_nonlocal. The
/// mean is taken from the previous step, so that a step is explicit in it.
struct NonlocalDruckerPrager {
  struct State {
    double plasticStrain;      ///< plastic strain: integral of l' [1]
    double hardening;          ///< hardening eta [Pa]
    double nonlocalHardening;  ///< nonlocal hardening eta_n [Pa]
    double plasticIncrement;   ///< plastic strain in the step [1]
    double meanIncrement;      ///< mean plastic strain in the step within l_nonlocal [1]
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed, capability::Nonlocal>;
  static constexpr std::array<StateVariable, 5> stateVariables{
      {{"p.plasticStrain", "1", "accumulated plastic strain"},
       {"p.eta", "Pa", "strength gained from the plastic strain at the point"},
       {"p.eta_nl", "Pa", "strength gained from the plastic strain around the point"},
       {"p.plasticIncrement", "1", "plastic strain of the latest step"},
       {"p.meanPlasticIncrement", "1", "mean of the plastic strain of the latest step within l_nonlocal"}}};
  static constexpr std::string_view name = "nonlocal_drucker_prager";
  static constexpr bool strainEnergyIsRate = true;

  double bulkModulus = 0;                                       ///< bulk modulus K [Pa]
  double shearModulus = 0;                                      ///< shear modulus G [Pa]
  double friction = 0;                                          ///< alpha [1]
  double dilation = 0;                                          ///< alpha_p [1]
  double strength = 0;                                          ///< strength k_o [Pa]
  double localModulus = 0;                                      ///< local modulus h_local [Pa]
  double nonlocalModulus = 0;                                   ///< nonlocal modulus h_nonlocal [Pa]
  double length = 0;                                            ///< length l_nonlocal [m]
  double leastStrength = 0;                                     ///< smallest strength [Pa]
  double stressAlongX = 0, stressAlongY = 0, stressAlongZ = 0;  ///< initial normal stresses [Pa]

  static const input::Schema<NonlocalDruckerPrager>& schema() {
    static const input::Schema<NonlocalDruckerPrager> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {0, 0, 0, 0, 0}; }
  double nonlocalLength() const { return nonlocalModulus != 0 ? length : 0; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Matrix3 initial = Vec3(stressAlongX, stressAlongY, stressAlongZ).asDiagonal();
    const Corotated step(d, oldStress + initial);
    state.nonlocalHardening += nonlocalModulus * state.meanIncrement;
    Matrix3 stress = step.stress + 2 * shearModulus * step.strain;
    stress.diagonal().array() += (bulkModulus - 2.0 / 3.0 * shearModulus) * step.strain.trace();
    state.plasticIncrement = yield(stress, state);
    state.meanIncrement = nonlocalLength() > 0 ? 0 : state.plasticIncrement;
    state.plasticStrain += state.plasticIncrement;
    return step.turned(stress) - initial;
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }

 private:
  /// Returns a trial stress to the yield surface along C : M, or to the apex of the surface; the result is the plastic
  /// strain.
  double yield(Matrix3& stress, State& state) const {
    const Matrix3 shear = deviator(stress);
    const double size = shear.norm() / std::sqrt(2.0), mean = stress.trace() / 3;
    const double start = strength + state.hardening + state.nonlocalHardening;
    double increment = plasticIncrement(size + 3 * friction * mean - start, localModulus);
    if (start + localModulus * increment < leastStrength)
      increment = plasticIncrement(size + 3 * friction * mean - leastStrength, 0);
    if (increment <= 0) return 0;
    const double toAxis = size * flowScale() / shearModulus;  // where no shear stress is left
    if (increment > toAxis) {
      increment = toApex(start, size, toAxis, stress);
    } else {
      const Matrix3 isotropic = 3 * bulkModulus * dilation * Matrix3::Identity();
      stress -= increment / flowScale() * (shearModulus / size * shear + isotropic);
    }
    state.hardening += localModulus * increment;
    return increment;
  }
  /// Returns a trial stress, with the root `size` of J2, to the apex of the surface that results from its plastic
  /// strain.
  /// The result is the length of this strain, the square root of (size/(2^(1/2) G))² + (p - p_apex)²/(3 K²).
  double toApex(double start, double size, double toAxis, Matrix3& stress) const {
    const double mean = stress.trace() / 3, onAxis = mean - 3 * bulkModulus * dilation * toAxis / flowScale();
    const auto strainTo = [&](double apex) {
      return std::hypot(size / (std::sqrt(2.0) * shearModulus), (mean - apex) / (std::sqrt(3.0) * bulkModulus));
    };
    double apex = onAxis;
    if (friction > 0)
      apex = rootBetween(
          [&](double p) { return 3 * friction * p - std::max(start + localModulus * strainTo(p), leastStrength); },
          onAxis, leastStrength / (3 * friction));
    stress = apex * Matrix3::Identity();
    return strainTo(apex);
  }
  double plasticIncrement(double excess, double hardening) const {
    return std::max(excess / (stiffness() + hardening), 0.0);
  }
  /// The decrease of the trial stress towards a fixed surface per plastic strain [Pa].
  double stiffness() const { return (shearModulus + 9 * bulkModulus * friction * dilation) / flowScale(); }
  /// Length of the gradient of the flow potential [1].
  double flowScale() const { return std::sqrt(0.5 + 3 * dilation * dilation); }

  static input::Schema<NonlocalDruckerPrager> makeSchema() {
    using Self = NonlocalDruckerPrager;
    input::Schema<Self> tags{name, "The Drucker-Prager yield surface, with softening averaged over a length."};
    tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
        .required("shear_modulus", &Self::shearModulus, "Pa", "G", input::positive())
        .required("alpha", &Self::friction, "1", "coefficient of pressure in the strength", input::nonNegative())
        .required("alpha_p", &Self::dilation, "1", "coefficient of dilation in plastic flow", input::nonNegative())
        .required("k_o", &Self::strength, "Pa", "strength at the start, in shear without pressure", input::positive())
        .value("h_local", &Self::localModulus, 0, "Pa", "increase of the strength with the plastic strain at the point")
        .value("h_nonlocal", &Self::nonlocalModulus, 0, "Pa",
               "increase of the strength with the mean plastic strain within l_nonlocal")
        .value("l_nonlocal", &Self::length, 0, "m", "radius of the mean; 0: only the point itself",
               input::nonNegative())
        .value("minimum_yield_stress", &Self::leastStrength, 0, "Pa", "smallest strength after softening",
               input::nonNegative())
        .value("initial_xstress", &Self::stressAlongX, 0, "Pa", "normal stress along x in bodies at the start")
        .value("initial_ystress", &Self::stressAlongY, 0, "Pa", "normal stress along y in bodies at the start")
        .value("initial_zstress", &Self::stressAlongZ, 0, "Pa", "normal stress along z in bodies at the start")
        .ignored("hardening_type", "Uintah does not use it either");
    refuseTag(tags, "k_o_dist", "all particles have the strength k_o");
    tags.check(checkConstants);
    return tags;
  }
  /// Reports softening that is faster than the decrease of the trial stress, because no stress would then lie on the
  /// yield surface.
  static void checkConstants(const NonlocalDruckerPrager& read, const input::Element& element,
                             input::Diagnostics& diagnostics) {
    const double softest = read.localModulus + std::min(read.nonlocalModulus, 0.0), limit = -read.stiffness();
    if (softest <= limit)
      diagnostics.error(element, fmt::format("<h_local>, or its sum with <h_nonlocal>, is {:g} Pa: the strength would "
                                             "fall faster than the stress; expected more than {:g} Pa",
                                             softest, limit));
  }
};
static_assert(ConstitutiveModel<NonlocalDruckerPrager>);

}  // namespace tushar::mpm::solid
