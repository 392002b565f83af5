#pragma once

#include <Eigen/LU>

#include <cmath>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/plasticity/deviator.hpp"
#include "components/mpm/solid/constitutive/plasticity/equation_of_state.hpp"
#include "components/mpm/solid/constitutive/plasticity/flow.hpp"
#include "components/mpm/solid/constitutive/plasticity/gurson_yield.hpp"
#include "components/mpm/solid/constitutive/plasticity/return_tangent.hpp"
#include "components/mpm/solid/constitutive/plasticity/shear_and_melting.hpp"
#include "components/mpm/solid/constitutive/plasticity/specific_heat.hpp"
#include "components/mpm/solid/constitutive/plasticity/stability.hpp"
#include "components/mpm/solid/constitutive/polar.hpp"
#include "components/mpm/solid/constitutive/tangent.hpp"
#include "core/input/refuse.hpp"
#include "core/input/variant.hpp"

namespace tushar::mpm::solid {

struct GursonPlastic;

/// Metals at large strains and high strain rates: hypoelastic shear in axes that rotate with the material, the von
/// Mises yield surface with a flow model, radial return, and an equation of state. Simo & Hughes, Computational
/// Inelasticity (1998), sections 3.3 and 8.2; Uintah's `elastic_plastic` and `elastic_plastic_hp`, which do not differ
/// in Uintah either.
template <bool isHp>
struct ElasticPlastic {
  struct State {
    double plasticStrain;                                        ///< plastic strain [1]
    double plasticStrainRate;                                    ///< plastic strain rate [1/s]
    double strainRate;                                           ///< strain rate [1/s]
    double energy;                                               ///< energy [J/kg]
    std::array<Tensor, MaxwellDeviator::greatestCount> maxwell;  ///< s_j of the Maxwell elements [Pa]
  };
  using Capabilities = CapabilityList<capability::AbsentVariables, capability::ConstantsOfMaterial,
                                      capability::NominalTangent, capability::BulkSpeed, capability::InitialWaveSpeed,
                                      capability::TemperatureChange, capability::HeatCapacity, capability::ViscousHeat,
                                      capability::Melting, capability::Stability, capability::PartialState>;
  static constexpr std::array<StateVariable, 9> stateVariables{
      {{"p.plasticStrain", "1", "equivalent plastic strain"},
       {"p.plasticStrainRate", "1/s", "equivalent plastic strain rate in the latest step"},
       {"p.strainRate", "1/s", "equivalent strain rate in the latest step"},
       {"p.energy", "J/kg", "work of the stresses since the start"},
       {"p.sigmaDev0", "Pa", "stress deviator of the Maxwell element 1", 9},
       {"p.sigmaDev1", "Pa", "stress deviator of the Maxwell element 2", 9},
       {"p.sigmaDev2", "Pa", "stress deviator of the Maxwell element 3", 9},
       {"p.sigmaDev3", "Pa", "stress deviator of the Maxwell element 4", 9},
       {"p.sigmaDev4", "Pa", "stress deviator of the Maxwell element 5", 9}}};
  static constexpr std::array<StateVariable, 1> absentVariables{{{"p.porosity", "1", "porosity, which is 0"}}};
  static constexpr std::string_view name = isHp ? "elastic_plastic_hp" : "elastic_plastic";
  static constexpr bool strainEnergyIsRate = true;

  MaterialConstants material;
  double bulkModulus = 0;   ///< bulk modulus K [Pa]
  double shearModulus = 0;  ///< shear modulus G [Pa]
  /// Taylor-Quinney coefficient, the fraction of the plastic work that becomes heat [1]
  double heatedShare = 0.9;
  double initialTemperature = 294;  ///< T_0 in the equation of state [K]
  DeviatorModel deviatorModel;
  FlowModel flow;
  EquationOfState equationOfState;
  ShearModel shear;
  MeltingModel melting;
  bool computesHeat = false;  ///< whether the model computes the specific heat; otherwise that of the material is used
  SpecificHeatModel specificHeat;
  /// Yield condition; the model is GursonPlastic if it is GursonYield.
  std::variant<VonMisesYield, GursonYield> yieldCondition;
  StabilityCheck stability;  ///< which loss of stability makes particles fail
  /// Whether porosity evolves. This member and the following ones are used only with GursonYield.
  bool poresEvolve = true;
  /// Mean and standard deviation of the initial porosity f [1].
  double initialPorosity = 0.002, porosityDeviation = 0.002;
  /// Whether the initial porosity f is normally distributed.
  bool porositySpreads = false;
  double nucleating = 0.1;  ///< f_N, volume fraction of void-nucleating particles [1]
  /// e_N and s_N, mean and standard deviation of the nucleation strain [1]
  double nucleationStrain = 0.3, nucleationDeviation = 0.1;

  static const input::Schema<ElasticPlastic>& schema() {
    static const input::Schema<ElasticPlastic> schema = makeSchema();
    return schema;
  }
  State initialState() const { return {0, 0, 0, 0, {}}; }
  int keptNumbers() const { return maxwell() ? 4 + 9 * maxwell()->count : 4; }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    state.strainRate = std::sqrt(2.0 / 3.0) * step.strain.norm() / d.timeStep;
    const FlowState start = flowStateOf(compressionOf(d, oldStress), state, d.timeStep);
    const Matrix3 trial = oldDeviator(step, d, state) + 2 * start.shearModulus * deviator(step.strain);
    Matrix3 stress = trial;
    state.plasticStrainRate = yield(start, d.timeStep, stress, state);
    if (maxwell()) advanceMaxwell(step, d, deviator(step.strain) - (trial - stress) / (2 * start.shearModulus), state);
    stress.diagonal().array() += meanStress(d, oldStress.trace() / 3, state.energy);
    stress = step.turned(stress);
    state.energy += stressWork(d, oldStress, stress) / material.density;
    return stress;
  }
  /// Computes the tangent d tau = J (tr h sigma + W sigma - sigma W + R (ds + dp I) Rᵀ): W the spin that h adds to R,
  /// ds and dp the changes of deviator and mean stress in the axes that rotate with the material.
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
    const double modulus = maxwell() ? maxwell()->modulusIn(0) : shearModulus;
    return std::sqrt((bulkModulus + 4.0 / 3.0 * modulus) / initialDensity);
  }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State&) const {
    const double modulus = maxwell() ? maxwell()->modulusIn(0) : shearModulusAt(compressionOf(d, stress));
    return std::sqrt((bulkModulus + 4.0 / 3.0 * modulus) * d.deformationGradient.determinant() / initialDensity);
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3&, const State&) const {
    return std::sqrt(bulkModulus * d.deformationGradient.determinant() / initialDensity);
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// Increase of the temperature due to plastic work and the work of dashpots, chi (sigma_y de_p + sum s_j:s_j dt / (2
  /// mu_j tau_j)) / (rho c), and to the change of volume.
  double temperatureChange(const Deformation& d, const Matrix3& stress, const State& state) const {
    const double equivalent = std::sqrt(1.5) * deviator(stress).norm(), j = d.deformationGradient.determinant();
    const VolumeState volume = volumeState(d, 0, 0);
    const double byVolume = std::visit([&](const auto& model) { return model.heating(volume); }, equationOfState);
    double work = equivalent * state.plasticStrainRate * d.timeStep;
    if (maxwell()) work += maxwell()->dissipation(state.maxwell) * d.timeStep;
    if (work == 0) return byVolume;
    return byVolume + heatedShare * work * j / (material.density * heatCapacity(d.deformationGradient, d.temperature));
  }
  double heatCapacity(const Matrix3& deformation, double temperature) const {
    if (!computesHeat) return material.specificHeat;
    const double ratio = 1 / deformation.determinant();
    return std::visit(
        [&](const auto& model) {
          return model.specificHeat({temperature, ratio, material.density * ratio, bulkModulus}, material.specificHeat);
        },
        specificHeat);
  }
  void addViscousHeat(State& state, double heat) const { state.energy += heat; }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const {
    return temperature > compressionOf(deformation.determinant(), -stress.trace() / 3, temperature).meltTemperature;
  }
  bool checksStability() const { return !std::holds_alternative<NoStabilityCheck>(stability); }
  bool isUnstable(const Deformation& d, const Matrix3& stress, const State& state) const {
    FlowState end = flowStateOf(compressionOf(d, stress), state, d.timeStep);
    end.plasticStrainRate = state.plasticStrainRate;
    if (!(state.plasticStrainRate > 0) || isFluid(end)) return false;
    const double hardening = std::visit([&](const auto& model) { return hardeningAtRate(model, end); }, flow);
    const PlasticTangent tangent{bulkModulus, end.shearModulus, hardening};
    const Matrix3 rate = 0.5 * (d.velocityGradient + d.velocityGradient.transpose());
    return std::visit([&](const auto& check) { return check.fails(tangent, stress, rate); }, stability);
  }

 private:
  friend struct GursonPlastic;

  static input::Schema<ElasticPlastic> makeSchema() {
    using Self = ElasticPlastic;
    input::Schema<Self> tags{name, "Metals at large strains and high strain rates."};
    tags.required("bulk_modulus", &Self::bulkModulus, "Pa", "K", input::positive())
        .required("shear_modulus", &Self::shearModulus, "Pa", "G", input::positive())
        .value("taylor_quinney_coeff", &Self::heatedShare, 0.9, "1", "fraction of the plastic work that becomes heat",
               input::between(0, 1))
        .value("initial_material_temperature", &Self::initialTemperature, 294, "K",
               "temperature at which the thermal pressure vanishes", input::nonNegative());
    typedTag(tags, "flow_model", &Self::flow, "the model of the yield stress", true);
    typedTag(tags, "equation_of_state", &Self::equationOfState,
             "the model of the mean stress; default_hyper if left out", false);
    typedTag(tags, "deviatoric_stress_model", &Self::deviatorModel,
             "the model of the stress deviator; hypoElastic if left out", false);
    typedTag(tags, "shear_modulus_model", &Self::shear, "the model of the shear modulus; constant_shear if left out",
             false);
    typedTag(tags, "melting_temp_model", &Self::melting,
             "the model of the temperature above which there is no shear stress; constant_Tm if left out", false);
    tags.value("compute_specific_heat", &Self::computesHeat, false, "1",
               "the heat of plastic work and viscosity raises the temperature according to <specific_heat_model>; "
               "conduction uses the <specific_heat> of the material, as in Uintah");
    typedTag(tags, "specific_heat_model", &Self::specificHeat,
             "the model of the specific heat; constant_Cp if left out", false);
    acceptWhatDoesNotMatter(tags);
    tags.check([](const Self& read, const input::Element& element, input::Diagnostics& diagnostics) {
      if (read.maxwell() && std::holds_alternative<GursonYield>(read.yieldCondition))
        diagnostics.error(element, "yield_condition gurson needs <deviatoric_stress_model> hypoElastic");
    });
    return tags;
  }
  /// Accepts tags of Uintah that have no effect with radial return, and choices for which only one option is available.
  static void acceptWhatDoesNotMatter(input::Schema<ElasticPlastic>& tags) {
    tags.ignored("tolerance", "the return is exact to round-off")
        .ignored("coeff_thermal_expansion", "the equation of state includes the temperature")
        .ignored("critical_stress", "Uintah does not use it either")
        .ignored("isothermal", "Uintah does not use it either")
        .ignored("check_failure", "Uintah does not use it either")
        .ignored("useModifiedEOS", "only the fluid coupling of Uintah uses it")
        .ignored("evolve_damage", "use a <damage_model>")
        .ignored("do_melting", "as in Uintah, there is no shear stress above <melt_temp>");
    declarePores(tags);
    for (const char* tag : {"critical_porosity", "check_TEPLA_failure_criterion", "check_max_stress_failure"})
      tags.ignored(tag, "no particle fails by porosity");
    tags.custom(
        "plastic_convergence_algo",
        [](ElasticPlastic&, const input::Element& element, input::Diagnostics& diagnostics) {
          const auto given = element.child("plastic_convergence_algo");
          if (given && given->text() == "biswajit")
            diagnostics.note(*given, "stresses end exactly on the yield surface, as with radialReturn");
          else if (given && given->text() != "radialReturn")
            diagnostics.error(*given, input::choiceProblem(given->text(), {"radialReturn", "biswajit"}));
        },
        {"plastic_convergence_algo"}, "radialReturn or biswajit: stresses end exactly on the yield surface with both");
    tags.forms({input::choiceForm({"plastic_convergence_algo"}, {"radialReturn", "biswajit"})});
    typedTag(tags, "yield_condition", &ElasticPlastic::yieldCondition,
             "the model of the yield surface; vonMises if left out", false);
    typedTag(tags, "stability_check", &ElasticPlastic::stability,
             "with <erosion>, particles fail where plastic flow loses its stability; none if left out", false);
  }

  /// Declares tags that are used only by the yield condition gurson.
  static void declarePores(input::Schema<ElasticPlastic>& tags) {
    using Self = ElasticPlastic;
    tags.value("evolve_porosity", &Self::poresEvolve, true, "1", "for gurson: pores grow, close and nucleate")
        .value("initial_mean_porosity", &Self::initialPorosity, 0.002, "1", "for gurson: porosity at the start",
               input::between(0, 0.9))
        .value("initial_std_porosity", &Self::porosityDeviation, 0.002, "1", "for gurson: standard deviation",
               input::nonNegative())
        .choice("initial_porosity_distrib", &Self::porositySpreads, {{"constant", false}, {"gauss", true}}, false,
                "for gurson: distribution of the initial porosity among the particles; the random numbers differ from "
                "Uintah's")
        .value("frac_nucleation", &Self::nucleating, 0.1, "1", "for gurson: total porosity that nucleates",
               input::nonNegative())
        .value("meanstrain_nucleation", &Self::nucleationStrain, 0.3, "1",
               "for gurson: mean plastic strain at which pores nucleate")
        .value("stddevstrain_nucleation", &Self::nucleationDeviation, 0.1, "1", "for gurson: standard deviation",
               input::nonNegative());
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
  FlowState flowStateOf(const Compression& c, const State& state, double timeStep) const {
    const double modulus = maxwell() ? maxwell()->modulusIn(timeStep) : shearModulusAt(c);
    return {state.plasticStrain, state.strainRate, c.temperature, modulus, c.density, c.meltTemperature};
  }
  const MaxwellDeviator* maxwell() const { return std::get_if<MaxwellDeviator>(&deviatorModel); }
  /// The relaxed deviator after a step without strain, in the rotated axes [Pa].
  Matrix3 oldDeviator(const Corotated& step, const Deformation& d, const State& state) const {
    if (!maxwell()) return deviator(step.stress);
    Matrix3 sum = Matrix3::Zero();
    for (int j = 0; j < maxwell()->count; ++j)
      sum += maxwell()->step(j, d.timeStep).kept * step.seen(matrixOf(state.maxwell[j]));
    return sum;
  }
  void advanceMaxwell(const Corotated& step, const Deformation& d, const Matrix3& elasticStrain, State& state) const {
    for (int j = 0; j < maxwell()->count; ++j) {
      const MaxwellStep element = maxwell()->step(j, d.timeStep);
      const Matrix3 stress = element.kept * step.seen(matrixOf(state.maxwell[j])) +
                             2 * element.gained * maxwell()->modulus[j] * elasticStrain;
      state.maxwell[j] = tensorOf(step.turned(stress));
    }
  }
  static bool isFluid(const FlowState& state) {
    return state.temperature > state.meltTemperature || state.shearModulus <= 0;
  }

  /// Returns the trial stress deviator in `stress` to the yield surface; the result is the rate of the plastic strain
  /// [1/s].
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
      return flowStateOf(compressionOf(volume, -oldStress.trace() / 3, d.temperature), state, d.timeStep);
    };
    const FlowState start = startAt(1);
    ReturnTangent tangent{step.strain, oldDeviator(step, d, state) + 2 * start.shearModulus * deviator(step.strain)};
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
  /// Derivatives of the mean stress with respect to the dilatation of the step and to ln J [Pa].
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
