#pragma once

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/initial_pressure.hpp"
#include "components/mpm/solid/constitutive/strain_invariants.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Neo-Hookean elasticity with J2 flow and linear isotropic hardening at finite strain: Simo & Hughes, Computational
/// Inelasticity (1998), section 9.3, box 9.1. Uintah's `UCNH` and `comp_neo_hook_plastic`, which is plastic by default.
template <bool plasticByDefault>
struct NeoHookPlastic {
  struct State {
    double plasticStrain;  ///< alpha, equivalent plastic strain [1]
    Tensor bElBar;         ///< J^(-2/3) F_e F_eᵀ: elastic and isochoric [1]
  };
  using Capabilities =
      CapabilityList<capability::OptionalState, capability::IgnoresTemperature, capability::FBar,
                     capability::NominalTangent, capability::BulkSpeed, capability::InitialVolumeRatio>;
  static constexpr std::array<StateVariable, 2> stateVariables{
      {{"p.plasticStrain", "1", "equivalent plastic strain"},
       {"p.bElBar", "1", "isochoric elastic left Cauchy-Green tensor", 9}}};
  static constexpr std::string_view name = plasticByDefault ? "comp_neo_hook_plastic" : "UCNH";
  static constexpr bool strainEnergyIsRate = false;

  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]
  bool isPlastic = plasticByDefault;
  std::optional<double> yieldStress;       ///< Y, yield stress [Pa]; none: elastic
  std::optional<double> hardeningModulus;  ///< hardening modulus H [Pa]
  double initialPlasticStrain = 0;         ///< initial plastic strain [1]
  bool yieldSpreads = false;               ///< whether the yield stress differs between particles: see UcnhVar
  double yieldRange = 0;                   ///< largest deviation from Y [Pa]
  int yieldSeed = 0;
  bool startsUnderPressure = false;
  double initialPressure = 0;  ///< initial pressure [Pa]

  static const input::Schema<NeoHookPlastic>& schema() {
    using Self = NeoHookPlastic;
    static const input::Schema<Self> schema = [] {
      input::Schema<Self> tags{name, "Compressible neo-Hookean elasticity, optionally with J2 plasticity."};
      tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
          .required("shear_modulus", &Self::shearModulus, "Pa", "G", input::positive())
          .value("usePlasticity", &Self::isPlastic, plasticByDefault, "1", "whether the material yields")
          .optional("yield_stress", &Self::yieldStress, "Pa",
                    "yield stress in uniaxial tension; needed if the material yields", input::positive())
          .optional("hardening_modulus", &Self::hardeningModulus, "Pa",
                    "growth of the yield stress with the plastic strain; needed if the material yields",
                    input::nonNegative())
          .value("alpha", &Self::initialPlasticStrain, 0, "1", "plastic strain at the start", input::nonNegative())
          .choice("yield_distrib", &Self::yieldSpreads, {{"constant", false}, {"uniform", true}}, false,
                  "distribution of the yield stress among the particles")
          .value("yield_range", &Self::yieldRange, 0, "Pa", "for uniform: largest deviation from <yield_stress>",
                 input::nonNegative())
          .value("yield_seed", &Self::yieldSeed, 0, "1",
                 "seed of the random yield stresses, which differ from Uintah's")
          .ignored("useModifiedEOS", "bodies in a gas keep their own equation of state")
          .ignored("strain_limit", "from older versions of Uintah")
          .ignored("reduction_factor", "from older versions of Uintah")
          .check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
            if (read.isPlastic && !(read.yieldStress && read.hardeningModulus))
              diagnostics.error(element, "a material that yields needs <yield_stress> and <hardening_modulus>");
            if (read.yieldSpreads && read.yieldStress && read.yieldRange >= *read.yieldStress)
              diagnostics.error(element, "<yield_range> is not less than <yield_stress>");
          });
      addInitialPressure(tags);
      refuseSwitch(tags, "reinitializeCMData", "bodies keep their state from the start");
      return tags;
    }();
    return schema;
  }
  bool keepsState() const { return isPlastic; }
  State initialState() const { return {initialPlasticStrain, identityTensor}; }
  double initialVolumeRatio() const { return startsUnderPressure ? volumeRatioUnder(initialPressure, bulkModulus) : 1; }

  Matrix3 updateStress(const Deformation& d, const Matrix3&, State& state) const {
    const double j = d.deformationGradient.determinant();
    const Trial trial(*this, d, state);
    Matrix3 stress = trial.stress - trial.excess * trial.normal;
    if (trial.excess > 0) state.plasticStrain += trial.slip();
    if (isPlastic) {
      Matrix3 elastic = stress / shearModulus;
      elastic.diagonal().array() += trial.elastic.trace() / 3;
      state.bElBar = tensorOf(elastic);
    }
    stress.diagonal().array() += bulkModulus / 2 * (j * j - 1);
    return stress / j;
  }

  /// Computes the tangent. With s the trial stress, n = s/|s|, q = f / (1 + H/(3 mu)), f = |s| - (2/3)^(1/2) (H alpha +
  /// Y), mu = G tr b / 3:
  /// d tau = K J² tr h I + ds - q dn - n dq, and d mu in dq.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3& oldStress, const State& old) const {
    const double j = d.deformationGradient.determinant();
    const Trial trial(*this, d, old);
    State state = old;
    const Matrix3 tau = j * updateStress(d, oldStress, state);
    return solid::nominalTangent(d.deformationGradient, tau, [&](const Matrix3& h) {
      const Matrix3 hb = h * trial.elastic, db = hb + hb.transpose() - 2.0 / 3.0 * h.trace() * trial.elastic;
      const Matrix3 ds = shearModulus * deviator(db);
      Matrix3 change = ds;
      change.diagonal().array() += bulkModulus * j * j * h.trace();
      if (trial.excess > 0) {
        const double grown = ds.cwiseProduct(trial.normal).sum(), stiffer = shearModulus * db.trace() / 3 / trial.shear;
        const double share = 1 / (1 + trial.hardening), dq = share * (grown + trial.excess * trial.hardening * stiffer);
        change -= trial.excess / trial.size * (ds - grown * trial.normal) + dq * trial.normal;
      }
      return change;
    });
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// The energy W = K/2 ((J² - 1)/2 - ln J) + G/2 (tr b - 3).
  double strainEnergyDensity(const Deformation& d, const Matrix3&, const Matrix3&, const State& state) const {
    const StrainInvariants strain(d.deformationGradient);
    const double shear = isPlastic ? matrixOf(state.bElBar).trace() - 3 : strain.isochoricFirst();
    return bulkModulus * strain.dilatation() + shearModulus / 2 * shear;
  }

 private:
  /// The elastic trial state, and the amount by which it exceeds the yield surface.
  struct Trial {
    Matrix3 elastic;       ///< elastic b [1]
    Matrix3 stress;        ///< s = G dev b [Pa]
    Matrix3 normal;        ///< s / |s|
    double size;           ///< |s| [Pa]
    double shear;          ///< shear modulus mu [Pa]
    double hardening = 0;  ///< H / (3 mu)
    double excess = 0;     ///< q, the decrease of |s| by the return [Pa]

    Trial(const NeoHookPlastic& body, const Deformation& d, const State& state) {
      const Matrix3 step =
          body.isPlastic ? Matrix3(d.deformationGradient * d.oldDeformationGradient.inverse()) : d.deformationGradient;
      const double volume = step.determinant();
      elastic = step * step.transpose();
      if (body.isPlastic) elastic = step * matrixOf(state.bElBar) * step.transpose();
      elastic /= std::cbrt(volume * volume);
      stress = body.shearModulus * deviator(elastic);
      size = stress.norm();
      shear = body.shearModulus * elastic.trace() / 3;
      normal = size > 0 ? Matrix3(stress / size) : Matrix3(Matrix3::Zero());
      if (!body.isPlastic) return;
      hardening = *body.hardeningModulus / (3 * shear);
      const double radius = *body.hardeningModulus * state.plasticStrain + *body.yieldStress;
      excess = std::max(size - std::sqrt(2.0 / 3.0) * radius, 0.0) / (1 + hardening);
    }
    /// The increment of the plastic strain, (2/3)^(1/2) q / (2 mu).
    double slip() const { return std::sqrt(2.0 / 3.0) * excess / (2 * shear); }
  };
};

using Ucnh = NeoHookPlastic<false>;
using CompNeoHookPlastic = NeoHookPlastic<true>;
static_assert(ConstitutiveModel<Ucnh> && ConstitutiveModel<CompNeoHookPlastic>);

}  // namespace tushar::mpm::solid
