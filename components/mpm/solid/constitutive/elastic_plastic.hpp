#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/plasticity/equation_of_state.hpp"
#include "components/mpm/solid/constitutive/plasticity/flow.hpp"
#include "components/mpm/solid/constitutive/plasticity/return_tangent.hpp"
#include "components/mpm/solid/constitutive/plasticity/shear_and_melting.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "core/input/refuse.hpp"
#include "core/input/variant.hpp"

namespace tushar::mpm::solid {

/// Metals at large strain and high rate: hypoelastic shear in axes that turn with the material, von Mises' yield
/// surface with a flow model, radial return, and an equation of state. Simo & Hughes, Computational Inelasticity
/// (1998), sections 3.3 and 8.2; Uintah's `elastic_plastic` and `elastic_plastic_hp`, which do not differ in Uintah
/// either.
template <bool isHp>
struct ElasticPlastic {
  struct State {
    double plasticStrain;      ///< 1
    double plasticStrainRate;  ///< 1/s
    double strainRate;         ///< 1/s
    double energy;             ///< J/kg
  };
  using Capabilities = CapabilityList<capability::AbsentVariables, capability::ConstantsOfMaterial,
                                      capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed,
                                      capability::TemperatureChange, capability::ViscousHeat, capability::Melting>;
  static constexpr std::array<StateVariable, 4> stateVariables{
      {{"p.plasticStrain", "1", "equivalent plastic strain"},
       {"p.plasticStrainRate", "1/s", "its rate in the last step"},
       {"p.strainRate", "1/s", "equivalent strain rate in the last step"},
       {"p.energy", "J/kg", "work of the stresses since the start"}}};
  static constexpr std::array<StateVariable, 1> absentVariables{
      {{"p.porosity", "1", "share of pores: there are none"}}};
  static constexpr std::string_view name = isHp ? "elastic_plastic_hp" : "elastic_plastic";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double bulkModulus = 0;           ///< K, Pa
  double shearModulus = 0;          ///< G, Pa
  double heatedShare = 0.9;         ///< of the plastic work, Taylor & Quinney's coefficient, 1
  double initialTemperature = 294;  ///< T_0 of the equation of state, K
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
    const FlowState start = flowStateOf(compressionOf(d, oldStress), state);
    Matrix3 stress = deviator(step.stress) + 2 * start.shearModulus * deviator(step.strain);
    state.plasticStrainRate = yield(start, d.timeStep, stress, state);
    stress.diagonal().array() += meanStress(d, oldStress.trace() / 3, state.energy);
    stress = step.turned(stress);
    state.energy += stressWork(d, oldStress, stress) / material.density;
    return stress;
  }
  /// d tau = J (tr h sigma + W sigma - sigma W + R (ds + dp I) Rᵀ): W the spin that h adds to R, ds and dp the changes
  /// of deviator and mean stress in the axes that rotate with the material.
  Matrix9 nominalTangent(const Deformation& d, const Matrix3& oldStress, const State& old) const {
    const Matrix3& f = d.deformationGradient;
    const Corotated step(d, oldStress);
    const Matrix3 moved = f * d.oldDeformationGradient.inverse(), stretch = f * step.after.transpose();
    State state = old;
    const Matrix3 stress = updateStress(d, oldStress, state);
    const ReturnTangent deviators = returnTangent(d, oldStress, step, old);
    const auto [byDilatation, byVolume] = meanStressSlopes(d, oldStress.trace() / 3, old.energy);
    const double j = f.determinant();
    return solid::nominalTangent(f, j * stress, [&](const Matrix3& h) {
      const Matrix3 grown = h * moved, spin = spinOf(h, stretch);
      Matrix3 change = deviators.change(step.seen(0.5 * (grown + grown.transpose())), h.trace());
      change.diagonal().array() += byDilatation * grown.trace() + byVolume * h.trace();
      return Matrix3(j * (h.trace() * stress + spin * stress - stress * spin + step.turned(change)));
    });
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
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// From plastic work, chi sigma_y de_p / (rho c), and from the volume change.
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    const double equivalent = std::sqrt(1.5) * deviator(stress).norm(), j = d.deformationGradient.determinant();
    const VolumeState volume = volumeState(d, 0, 0);
    const double byVolume = std::visit([&](const auto& model) { return model.heating(volume); }, equationOfState);
    if (state.plasticStrainRate == 0) return byVolume;
    const double work = equivalent * state.plasticStrainRate * d.timeStep;
    return byVolume + heatedShare * work * j / (material.density * material.specificHeat);
  }
  void addViscousHeat(State& state, double heat) const { state.energy += heat; }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const {
    return temperature > compressionOf(deformation.determinant(), -stress.trace() / 3, temperature).meltTemperature;
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
    typedTag(tags, "equation_of_state", &Self::equationOfState, "the mean stress; default_hyper if left out", false);
    typedTag(tags, "shear_modulus_model", &Self::shear, "the shear modulus; constant_shear if left out", false);
    typedTag(tags, "melting_temp_model", &Self::melting, "where there is no shear stress; constant_Tm if left out",
             false);
    acceptWhatDoesNotMatter(tags);
    return tags;
  }
  /// Accepts tags of Uintah that have no effect with radial return, and choices of which one is available.
  static void acceptWhatDoesNotMatter(input::Schema<ElasticPlastic>& tags) {
    tags.ignored("tolerance", "the return is exact to round-off")
        .ignored("coeff_thermal_expansion", "the equation of state knows of the temperature")
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
    tags.custom(
        "compute_specific_heat",
        [](ElasticPlastic&, const input::Element& element, input::Diagnostics& diagnostics) {
          const auto compute = element.child("compute_specific_heat"), model = element.child("specific_heat_model");
          if (!compute || !model || compute->text() == "false") return;
          const std::string type = model->attribute("type").value_or("constant_Cp");
          if (const std::string problem = input::choiceProblem(type, {"constant_Cp"}); !problem.empty())
            diagnostics.error(*model, "type: " + problem + ": give the <specific_heat> of the material");
        },
        {"compute_specific_heat", "specific_heat_model"}, "only constant_Cp: the <specific_heat> of the material");
    tags.custom(
        "plastic_convergence_algo",
        [](ElasticPlastic&, const input::Element& element, input::Diagnostics& diagnostics) {
          const auto given = element.child("plastic_convergence_algo");
          if (given && given->text() != "radialReturn")
            diagnostics.error(*given, input::choiceProblem(given->text(), {"radialReturn"}));
        },
        {"plastic_convergence_algo"}, "only radialReturn");
    tags.forms({input::choiceForm({"plastic_convergence_algo"}, {"radialReturn"})});
    refuseTypes(tags, "yield_condition", {"vonMises"}, "the yield surface");
    refuseTypes(tags, "stability_check", {"none", "drucker", "becker", "drucker_becker"},
                "nothing comes of it: only none where there is an <erosion>");
    refuseTypes(tags, "deviatoric_stress_model", {"hypoElastic"}, "the stress deviator grows with 2 G dev D");
  }

  Compression compressionOf(double volume, double pressure, double temperature) const {
    Compression compression{pressure, 1 / volume, temperature, material.density / volume};
    compression.meltTemperature = std::visit(
        [&](const auto& model) { return model.temperature(compression, material.meltTemperature); }, melting);
    return compression;
  }
  Compression compressionOf(const Deformation& d, const Matrix3& stress) const {
    return compressionOf(d.deformationGradient.determinant(), -stress.trace() / 3, d.temperature);
  }
  double shearModulusAt(const Compression& compression) const {
    return std::visit([&](const auto& model) { return model.modulus(compression, shearModulus); }, shear);
  }
  FlowState flowStateOf(const Compression& c, const State& state) const {
    return {state.plasticStrain, state.strainRate, c.temperature, shearModulusAt(c), c.density, c.meltTemperature};
  }
  static bool isFluid(const FlowState& state) {
    return state.temperature > state.meltTemperature || state.shearModulus <= 0;
  }

  /// Returns the trial stress deviator to the yield surface; the result is the rate of the plastic strain, 1/s.
  double yield(const FlowState& start, double timeStep, Matrix3& stress, State& state) const {
    if (isFluid(start)) {
      stress.setZero();
      return 0;
    }
    return std::visit(
        [&]<class Flow>(const Flow& model) {
          const RadialReturn<Flow> back(model, start, timeStep);
          const double size = stress.norm(), excess = back.excess(size);
          if (excess <= 0) return 0.0;
          stress *= 1 - excess / size;
          state.plasticStrain = back.after(excess).plasticStrain;
          return (state.plasticStrain - start.plasticStrain) / timeStep;
        },
        flow);
  }
  ReturnTangent returnTangent(const Deformation& d, const Matrix3& oldStress, const Corotated& step,
                              State state) const {
    state.strainRate = std::sqrt(2.0 / 3.0) * step.strain.norm() / d.timeStep;
    const auto startAt = [&](double swollen) {
      const double volume = swollen * d.deformationGradient.determinant();
      return flowStateOf(compressionOf(volume, -oldStress.trace() / 3, d.temperature), state);
    };
    const FlowState start = startAt(1);
    ReturnTangent tangent{step.strain, deviator(step.stress) + 2 * start.shearModulus * deviator(step.strain)};
    if (isFluid(start)) return tangent;
    tangent.modulus = start.shearModulus;
    tangent.modulusByVolume = logarithmicSlope([&](double swollen) { return startAt(swollen).shearModulus; });
    std::visit(
        [&]<class Flow>(const Flow& model) {
          const RadialReturn<Flow> back(model, start, d.timeStep);
          tangent.excess = back.excess(tangent.trial.norm());
          const FlowState end = back.after(tangent.excess);
          tangent.hardening = back.hardening(end);
          tangent.byRate = logarithmicSlope([&](double faster) {
            FlowState moved = end;
            moved.strainRate *= faster;
            return model.flowStress(moved);
          });
          tangent.yieldByVolume = logarithmicSlope([&](double swollen) {
            FlowState moved = startAt(swollen);
            moved.plasticStrain = end.plasticStrain;
            moved.plasticStrainRate = end.plasticStrainRate;
            return model.flowStress(moved);
          });
        },
        flow);
    return tangent;
  }
  VolumeState volumeState(const Deformation& d, double oldMeanStress, double energy) const {
    return {oldMeanStress,
            d.velocityGradient.trace() * d.timeStep,
            d.deformationGradient.determinant(),
            d.temperature,
            initialTemperature,
            energy,
            bulkModulus,
            material.density,
            material.specificHeat};
  }
  double meanStress(const Deformation& d, double old, double energy) const {
    const VolumeState state = volumeState(d, old, energy);
    return std::visit([&](const auto& model) { return model.meanStress(state); }, equationOfState);
  }
  /// Derivatives of the mean stress by the dilatation of the step and by ln J, Pa.
  std::pair<double, double> meanStressSlopes(const Deformation& d, double old, double energy) const {
    const auto at = [&](double dilated, double swollen) {
      VolumeState state = volumeState(d, old, energy);
      state.dilatation += dilated;
      state.volume *= swollen;
      return std::visit([&](const auto& model) { return model.meanStress(state); }, equationOfState);
    };
    return {logarithmicSlope([&](double share) { return at(share - 1, 1); }),
            logarithmicSlope([&](double share) { return at(0, share); })};
  }
};

using ElasticPlasticModel = ElasticPlastic<false>;
using ElasticPlasticHp = ElasticPlastic<true>;
static_assert(ConstitutiveModel<ElasticPlasticModel> && ConstitutiveModel<ElasticPlasticHp>);

}  // namespace tushar::mpm::solid
