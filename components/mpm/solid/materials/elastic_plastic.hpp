#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive_model.hpp"
#include "components/mpm/solid/kernels/polar.hpp"
#include "components/mpm/solid/materials/plasticity/equation_of_state.hpp"
#include "components/mpm/solid/materials/plasticity/flow.hpp"
#include "components/mpm/solid/materials/plasticity/shear_and_melting.hpp"
#include "components/mpm/solid/refuse.hpp"
#include "components/mpm/solid/variant_input.hpp"

namespace tushar::mpm::solid {

/// Metals at large strain and high rate: hypoelastic shear in axes that turn with the material, von Mises' yield surface
/// with a flow model, radial return, and an equation of state. Simo & Hughes, Computational Inelasticity (1998), sections
/// 3.3 and 8.2; Uintah's `elastic_plastic` and `elastic_plastic_hp`, which are the same there, too.
template <bool isHp>
struct ElasticPlastic {
  struct State {
    double plasticStrain;      ///< 1
    double plasticStrainRate;  ///< 1/s
    double strainRate;         ///< 1/s
    double energy;             ///< J/kg
  };
  static constexpr std::array<StateVariable, 4> stateVariables{
      {{"p.plasticStrain", "1", "equivalent plastic strain"},
       {"p.plasticStrainRate", "1/s", "its rate in the last step"},
       {"p.strainRate", "1/s", "equivalent strain rate in the last step"},
       {"p.energy", "J/kg", "work of the stresses since the start"}}};
  static constexpr std::string_view name = isHp ? "elastic_plastic_hp" : "elastic_plastic";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double bulkModulus = 0;          ///< K, Pa
  double shearModulus = 0;         ///< G, Pa
  double heatedShare = 0.9;        ///< of the plastic work, Taylor & Quinney's coefficient, 1
  double initialTemperature = 294; ///< T_0 of the equation of state, K
  FlowModel flow;
  EquationOfState equationOfState;
  ShearModel shear;
  MeltingModel melting;

  static const input::Schema<ElasticPlastic>& schema() {
    static const input::Schema<ElasticPlastic> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {0, 0, 0, 0}; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    state.strainRate = std::sqrt(2.0 / 3.0) * step.strain.norm() / d.timeStep;
    const Compression compression = compressionOf(d, oldStress);
    const double modulus = shearModulusAt(compression);
    Matrix3 stress = deviator(step.stress) + 2 * modulus * deviator(step.strain);
    state.plasticStrainRate = yield(d, compression, modulus, stress, state);
    stress.diagonal().array() += meanStress(d, oldStress.trace() / 3, state.energy);
    stress = step.turned(stress);
    state.energy += stressWork(d, oldStress, stress) / material.density;
    return stress;
  }
  double initialWaveSpeed(double initialDensity) const {
    return std::sqrt((bulkModulus + 4.0 / 3.0 * shearModulus) / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State&) const {
    const double modulus = shearModulusAt(compressionOf(d, stress));
    return std::sqrt((bulkModulus + 4.0 / 3.0 * modulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress, const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// By the plastic work, chi sigma_y de_p / (rho c), and by the change of volume.
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    const double equivalent = std::sqrt(1.5) * deviator(stress).norm(), j = d.deformationGradient.determinant();
    const VolumeState volume = volumeState(d, 0, 0);
    const double byVolume = std::visit([&](const auto& model) { return model.heating(volume); }, equationOfState);
    if (state.plasticStrainRate == 0) return byVolume;
    const double work = equivalent * state.plasticStrainRate * d.timeStep;
    return byVolume + heatedShare * work * j / (material.density * material.specificHeat);
  }
  void addHeat(State& state, double heat) const { state.energy += heat; }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const {
    return isMolten(compressionOf(deformation, stress, temperature));
  }

 private:
  static input::Schema<ElasticPlastic> makeSchema() {
    using Self = ElasticPlastic;
    input::Schema<Self> tags{std::string(name), "Metals at large strain and high rate."};
    tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
        .required("shear_modulus", &Self::shearModulus, "Pa", "G", input::positive())
        .value("taylor_quinney_coeff", &Self::heatedShare, 0.9, "1", "share of the plastic work that heats",
               input::between(0, 1))
        .value("initial_material_temperature", &Self::initialTemperature, 294, "K", "where heat adds no pressure",
               input::nonNegative());
    typedTag(tags, "flow_model", &Self::flow, "the yield stress", true);
    typedTag(tags, "equation_of_state", &Self::equationOfState, "the mean stress; default_hypo if left out", false);
    typedTag(tags, "shear_modulus_model", &Self::shear, "the shear modulus; constant_shear if left out", false);
    typedTag(tags, "melting_temp_model", &Self::melting, "where there is no shear stress; constant_Tm if left out", false);
    acceptWhatDoesNotMatter(tags);
    return tags;
  }
  /// Tags of Uintah's without effect on an explicit run with radial return, and choices of which one is there.
  static void acceptWhatDoesNotMatter(input::Schema<ElasticPlastic>& tags) {
    tags.ignored("tolerance", "the return is exact to round-off")
        .ignored("coeff_thermal_expansion", "only Uintah's implicit method reads it")
        .ignored("critical_stress", "Uintah does not read it either")
        .ignored("isothermal", "Uintah does not read it either")
        .ignored("check_failure", "Uintah does not read it either")
        .ignored("useModifiedEOS", "only Uintah's coupled fluid reads it")
        .ignored("evolve_damage", "a <damage_model> does it where there is one")
        .ignored("do_melting", "above <melt_temp> there is no shear stress, as in Uintah");
    for (const char* tag : {"evolve_porosity", "initial_mean_porosity", "initial_std_porosity", "critical_porosity",
                            "frac_nucleation", "meanstrain_nucleation", "stddevstrain_nucleation",
                            "initial_porosity_distrib", "check_TEPLA_failure_criterion", "check_max_stress_failure"})
      tags.ignored(tag, "there is no porosity: the yield surface of von Mises does not feel it");
    refuseSwitch(tags, "compute_specific_heat", "give the <specific_heat> of the material");
    tags.ignored("specific_heat_model", "the <specific_heat> of the material is taken");
    tags.custom("plastic_convergence_algo",
                [](ElasticPlastic&, const input::Element& element, input::Diagnostics& diagnostics) {
                  const auto given = element.child("plastic_convergence_algo");
                  if (given && given->text() != "radialReturn")
                    diagnostics.error(*given, input::choiceProblem(given->text(), {"radialReturn"}));
                },
                {"plastic_convergence_algo"}, "only radialReturn");
    refuseTypes(tags, "yield_condition", {"vonMises"}, "the yield surface");
    refuseTypes(tags, "stability_check", {"none", "drucker", "becker", "drucker_becker"},
                "nothing comes of it: only none where there is an <erosion>");
    refuseTypes(tags, "deviatoric_stress_model", {"hypoElastic"}, "the stress deviator grows with 2 G dev D");
  }

  static Compression compressionOf(const Matrix3& deformation, const Matrix3& stress, double temperature) {
    return {-stress.trace() / 3, 1 / deformation.determinant(), temperature};
  }
  static Compression compressionOf(const Deformation& d, const Matrix3& stress) {
    return compressionOf(d.deformationGradient, stress, d.temperature);
  }
  double shearModulusAt(const Compression& compression) const {
    return std::visit([&](const auto& model) { return model.modulus(compression, shearModulus); }, shear);
  }
  bool isMolten(const Compression& compression) const {
    const double melts = std::visit(
        [&](const auto& model) { return model.temperature(compression, material.meltTemperature); }, melting);
    return compression.temperature > melts;
  }

  /// Takes what is beyond the yield surface from the trial stress deviator; returns the rate of the plastic strain, 1/s.
  double yield(const Deformation& d, const Compression& compression, double modulus, Matrix3& stress,
               State& state) const {
    if (isMolten(compression) || modulus <= 0) {
      stress.setZero();
      return 0;
    }
    FlowState now{state.plasticStrain, state.strainRate, d.temperature, modulus};
    const double size = stress.norm();
    const double excess = std::visit([&](const auto& model) { return radialReturn(model, size, now); }, flow);
    if (excess <= 0) return 0;
    stress *= 1 - excess / size;
    const double rate = (now.plasticStrain - state.plasticStrain) / d.timeStep;
    state.plasticStrain = now.plasticStrain;
    return rate;
  }
  VolumeState volumeState(const Deformation& d, double oldMeanStress, double energy) const {
    return {oldMeanStress, d.velocityGradient.trace() * d.timeStep, d.deformationGradient.determinant(), d.temperature,
            initialTemperature, energy, bulkModulus, material.density, material.specificHeat};
  }
  double meanStress(const Deformation& d, double old, double energy) const {
    const VolumeState state = volumeState(d, old, energy);
    return std::visit([&](const auto& model) { return model.meanStress(state); }, equationOfState);
  }
};

using ElasticPlasticModel = ElasticPlastic<false>;
using ElasticPlasticHp = ElasticPlastic<true>;
static_assert(ConstitutiveModel<ElasticPlasticModel> && ConstitutiveModel<ElasticPlasticHp>);

}  // namespace tushar::mpm::solid
