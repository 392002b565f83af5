#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/arenisca/step.hpp"
#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "core/input/refuse.hpp"

namespace tushar::mpm::solid {

/// Arenisca, a model of rock and soil with pores that collapse under pressure and may contain a fluid: Homel, Guilkey &
/// Brannon, Acta Mech. 227 (2016) 279. The return to the yield surface is from the same authors, Comput. Mech. 56
/// (2015) 565; the relaxation to it is that of Duvaut & Lions as in Brannon, Shock Wave Science and Technology
/// Reference Library 2 (2007) 225, eqs. 6.92-93. The model is hypoelastic in axes that rotate with the material.
/// `version` 4 is Uintah's `Arenisca4`; 3 is `Arenisca3`, without Lode angle; 2 is `Arenisca`, the oldest, a cone with
/// a tangent ellipse and constant moduli.
template <int version>
struct Arenisca : arenisca::Constants {
  struct State {
    Tensor quasistatic;    ///< stress without rate dependence [Pa]
    Tensor plasticStrain;  ///< plastic strain in axes that rotate with the material [1]
    double plasticVolume, elasticVolume;
    /// End of the cap, start of the cap, trace of the fluid's stress, and pore pressure [Pa].
    double cap, capStart, zeta, porePressure;
  };
  using Capabilities = CapabilityList<capability::IgnoresTemperature, capability::BulkSpeed, capability::InitialStress>;
  static constexpr std::array<StateVariable, 8> stateVariables{
      {{"p.StressQS", "Pa", "stress without its rate-dependent part", 9},
       {"p.ep", "1", "plastic strain, in axes that rotate with the material", 9},
       {"p.evp", "1", "volumetric plastic strain"},
       {"p.eve", "1", "volumetric elastic strain"},
       {"p.CapX", "Pa", "I1 - zeta at the end of the cap"},
       {"p.Kappa", "Pa", "I1 - zeta where the cap begins"},
       {"p.Zeta", "Pa", "trace of the stress in the pore fluid"},
       {"p.PorePressure", "Pa", "pressure of the pore fluid"}}};
  static constexpr std::string_view name = version == 4 ? "Arenisca4" : version == 3 ? "Arenisca3" : "Arenisca";
  static constexpr bool strainEnergyIsRate = true;

  static const input::Schema<Arenisca>& schema() {
    static const input::Schema<Arenisca> schema = [] {
      input::Schema<Arenisca> tags(name, "Rock and soil with pores that collapse and may contain a fluid.");
      arenisca::addConeTags(tags);
      if constexpr (version == 2)
        arenisca::addTangentCapTags(tags);
      else
        arenisca::addSoilTags(tags);
      if constexpr (version == 4) arenisca::addLodeTags(tags);
      refuseSwitch(tags, "Use_Disaggregation_Algorithm", "all particles have the porosity of <p3_crush_curve>");
      refuseTag(tags, "PEAKI1IDIST", "the strength is the same everywhere: that of <PEAKI1>");
      return tags;
    }();
    return schema;
  }
  State initialState() const {
    const double cap = arenisca::capEnd(*this, 0);
    return {tensorOf(initialStress()), {}, 0, 0, cap, capStart(cap), -3 * fluidPressure, fluidPressure};
  }
  Matrix3 initialStress() const { return -fluidPressure * Matrix3::Identity(); }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    const arenisca::Point before{step.seen(matrixOf(state.quasistatic)), matrixOf(state.plasticStrain), state.cap,
                                 state.zeta};
    const arenisca::Point after = arenisca::advance(*this, before, step.strain, sharpness);
    const double volume = std::log(d.deformationGradient.determinant()), plastic = after.plasticStrain.trace();
    state = {tensorOf(step.turned(after.stress)),
             tensorOf(after.plasticStrain),
             plastic,
             volume - plastic,
             after.cap,
             capStart(after.cap),
             after.zeta,
             arenisca::porePressure(*this, volume)};
    return t1 > 0 && d.timeStep > 0 ? step.turned(relaxed(d, step, before, after)) : matrixOf(state.quasistatic);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    const double stiffness = matrixBulk() + 4.0 / 3.0 * arenisca::greatestShear(*this);
    return std::sqrt(stiffness * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(matrixBulk() * d.deformationGradient.determinant() / initialDensity);
  }
  /// Strain energy of the step: D : (mean stress) J dt.
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    const Matrix3 mean = 0.5 * (oldStress + stress);
    return d.velocityGradient.cwiseProduct(mean).sum() * d.deformationGradient.determinant() * d.timeStep;
  }

 private:
  static constexpr double sharpness = version == 4 ? 1e-5 : 1e-4;

  double capStart(double cap) const { return arenisca::YieldSurface(*this, cap, 0).branch(); }
  /// The rate-dependent stress: sigma = sigma_qs + (d sigma_elastic - d sigma_qs) (1 - e^-x) / x + (sigma_old -
  /// sigma_qs,old) e^-x, x = |D|^t2 dt/t1
  Matrix3 relaxed(const Deformation& d, const Corotated& step, const arenisca::Point& before,
                  const arenisca::Point& after) const {
    const auto [bulkBefore, shearBefore] = before.moduli(*this);
    const auto [bulkAfter, shearAfter] = after.moduli(*this);
    const arenisca::Moduli mean{0.5 * (bulkBefore + bulkAfter), 0.5 * (shearBefore + shearAfter)};
    const double rate = std::max(step.strain.norm() / d.timeStep, 1e-15);
    const double x = d.timeStep / t1 * std::pow(rate, t2), kept = std::exp(-x), gained = -std::expm1(-x) / x;
    return after.stress + gained * (mean.stress(step.strain) - (after.stress - before.stress)) +
           kept * (step.stress - before.stress);
  }
};
using Arenisca2 = Arenisca<2>;
using Arenisca3 = Arenisca<3>;
using Arenisca4 = Arenisca<4>;
static_assert(ConstitutiveModel<Arenisca2> && ConstitutiveModel<Arenisca3> && ConstitutiveModel<Arenisca4>);

}  // namespace tushar::mpm::solid
