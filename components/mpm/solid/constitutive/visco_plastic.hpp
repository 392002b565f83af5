#pragma once

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/plasticity/equation_of_state.hpp"
#include "components/mpm/solid/constitutive/plasticity/suvic.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "core/input/refuse.hpp"
#include "core/input/variant.hpp"

namespace tushar::mpm::solid {

using ViscoplasticFlow = std::variant<SuvicI>;

/// Hypoelasticity with creep and an equation of state; stress rates are those of Green & Naghdi. Nine tenths of the
/// inelastic work become heat. With check_failure, a particle fails permanently if the largest principal stress, the
/// largest principal value of the strain (I - b⁻¹)/2, or the mean stress exceeds failure_variable_mean.
struct ViscoPlastic {
  struct State {
    double plasticStrain;      ///< plastic strain [1]
    double plasticStrainRate;  ///< plastic strain rate [1/s]
    double yield;              ///< yield stress [Pa]
    double drag;               ///< drag stress [Pa]
    double failed;             ///< 1 if the particle has failed
    double failureVariable;    ///< stress [Pa] or strain [1] at which the particle fails
    Tensor backStress;         ///< back stress [Pa]
  };
  using Capabilities = CapabilityList<capability::ConstantsOfMaterial, capability::BulkSpeed,
                                      capability::InitialWaveSpeed, capability::TemperatureChange>;
  static constexpr std::array<StateVariable, 7> stateVariables{
      {{"p.plasticStrain", "1", "equivalent inelastic strain"},
       {"p.plasticStrainRate", "1/s", "equivalent inelastic strain rate in the latest step"},
       {"p.yield", "Pa", "yield stress"},
       {"p.drag", "Pa", "drag stress"},
       {"p.localized", "1", "1 if the particle has failed"},
       {"p.varf", "1", "stress (Pa) or strain above which the particle fails"},
       {"p.backstress", "Pa", "back stress", 9}}};
  static constexpr std::string_view name = "visco_plastic";
  static constexpr bool strainEnergyIsRate = true;
  static constexpr double heatedShare = 0.9;  ///< Taylor-Quinney coefficient, as in Uintah [1]

  MaterialConstants material;
  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]
  std::variant<HyperelasticVolume, HypoelasticVolume> equationOfState;
  ViscoplasticFlow flow;
  double initialTemperature = 269.15;  ///< reference temperature of the equation of state [K]
  bool canFail = false, byStress = true, byPressure = false;
  double failureVariable = 1e30;
  bool losesStress = true, losesTension = false;

  static const input::Schema<ViscoPlastic>& schema() {
    static const input::Schema<ViscoPlastic> schema = makeSchema();
    return schema;
  }
  State initialState() const {
    const auto stresses =
        std::visit([](const auto& model) { return std::pair(model.initialYield, model.initialDrag); }, flow);
    return {0, 0, stresses.first, stresses.second, 0, failureVariable, {}};
  }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    if (state.failed != 0) {
      state.plasticStrainRate = 0;
      return step.turned(left(step.stress));
    }
    Matrix3 stress = deviator(step.stress) + 2 * shearModulus * deviator(step.strain);
    SuvicI::Stresses internal{state.yield, state.drag, step.seen(matrixOf(state.backStress))};
    const double strain =
        std::visit([&](const auto& model) { return model.relax(shearModulus, d.timeStep, stress, internal); }, flow);
    state.plasticStrain += strain;
    state.plasticStrainRate = d.timeStep > 0 ? strain / d.timeStep : 0;
    state.yield = internal.yield;
    state.drag = internal.drag;
    state.backStress = tensorOf(step.turned(internal.back));
    stress.diagonal().array() += meanStress(d, oldStress.trace() / 3);
    if (canFail && failureMeasure(d, stress) > state.failureVariable) {
      state.failed = 1;
      stress = left(stress);
    }
    return step.turned(stress);
  }
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  /// Strain energy density [J/m^3]; 0 for failed particles, as in Uintah.
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State& state) const {
    return state.failed != 0 ? 0 : stressWork(d, oldStress, stress);
  }
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    if (state.plasticStrainRate == 0) return 0;
    const double work = std::sqrt(1.5) * deviator(stress).norm() * state.plasticStrainRate * d.timeStep;
    return heatedShare * work * d.deformationGradient.determinant() / (material.density * material.specificHeat);
  }

 private:
  double meanStress(const Deformation& d, double old) const {
    const VolumeState state{old,
                            d.velocityGradient.trace() * d.timeStep,
                            d.deformationGradient.determinant(),
                            d.temperature,
                            initialTemperature,
                            0,
                            bulkModulus,
                            material.density,
                            material.specificHeat};
    return std::visit([&](const auto& model) { return model.meanStress(state); }, equationOfState);
  }
  /// The stress that remains in a failed particle.
  Matrix3 left(const Matrix3& stress) const {
    if (losesStress) return Matrix3::Zero();
    if (losesTension) return std::min(stress.trace() / 3, 0.0) * Matrix3::Identity();
    return stress;
  }
  double failureMeasure(const Deformation& d, const Matrix3& stress) const {
    if (byPressure) return stress.trace() / 3;
    const Matrix3& f = d.deformationGradient;
    const Matrix3 tensor = byStress ? stress : Matrix3(0.5 * (Matrix3::Identity() - (f * f.transpose()).inverse()));
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[2];
  }

  static input::Schema<ViscoPlastic> makeSchema() {
    using Self = ViscoPlastic;
    input::Schema<Self> tags{name, "Ice and salt: elasticity with creep that hardens."};
    tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
        .required("shear_modulus", &Self::shearModulus, "Pa", "G", input::positive())
        .value("initial_material_temperature", &Self::initialTemperature, 269.15, "K",
               "temperature at which the thermal pressure vanishes", input::nonNegative())
        .value("check_failure", &Self::canFail, false, "1", "whether particles can fail")
        .value("failure_by_stress", &Self::byStress, true, "1",
               "true: particles fail when the largest principal stress exceeds the limit; false: when the largest "
               "principal strain does")
        .value("failure_by_pressure", &Self::byPressure, false, "1",
               "true: the mean stress is compared with the limit instead")
        .value("failure_variable_mean", &Self::failureVariable, 1e30, "1",
               "stress (Pa) or strain at which particles fail")
        .value("zero_stress_upon_failure", &Self::losesStress, true, "1", "whether failed particles bear no stress")
        .value("allow_no_tension", &Self::losesTension, false, "1",
               "whether failed particles that bear stress bear only a pressure");
    typedTag(tags, "visco_plasticity_model", &Self::flow, "the model of the inelastic strain rate", true);
    typedTag(tags, "equation_of_state", &Self::equationOfState,
             "the model of the mean stress; default_hyper if left out", false);
    refuseSwitch(tags, "coeff_thermal_expansion", "the material does not expand with temperature");
    refuseSwitch(tags, "failure_variable_std", "all particles fail at the same stress or strain");
    refuseSwitch(tags, "remove_particles", "failed particles are kept");
    refuseTypes(tags, "stability_check", {"none"}, "only the type none is allowed: the tag has no effect in Uintah");
    tags.ignored("failure_variable_distrib", "all particles fail at the same stress or strain")
        .ignored("tolerance", "small strain rates are not rounded to 0")
        .ignored("use_polar_decomposition_RMB", "the rotation is exact to round-off")
        .ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it");
    return tags;
  }
};
static_assert(ConstitutiveModel<ViscoPlastic>);

}  // namespace tushar::mpm::solid
