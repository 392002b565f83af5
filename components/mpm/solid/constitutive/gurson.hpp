#pragma once

#include <Eigen/LU>

#include "components/mpm/particles/drawn.hpp"
#include "components/mpm/solid/constitutive/elastic_plastic.hpp"

namespace tushar::mpm::solid {

/// `elastic_plastic` with the yield condition `gurson`, for porous metals. The porosity grows with the plastic
/// dilatation, df = (1 - f) dt + A de_p in tension, A = f_N exp(-((e_p - e_N)/s_N)²/2) / (s_N (2 pi)^(1/2)); Chu &
/// Needleman, J. Eng. Mater. Technol. 102 (1980) 249. The equation of state uses the volume without plastic dilatation.
struct GursonPlastic {
  using Base = ElasticPlasticHp;
  struct State {
    double plasticStrain;      ///< plastic strain of the metal between the pores [1]
    double plasticStrainRate;  ///< plastic strain rate [1/s]
    double strainRate;         ///< strain rate [1/s]
    double energy;             ///< energy [J/kg]
    double porosity;           ///< porosity f [1]
    double dilatation;         ///< plastic dilatation [1]
    double plasticWork;        ///< plastic work in the step [J/m^3]
  };
  using Capabilities = CapabilityList<capability::BulkSpeed, capability::InitialWaveSpeed,
                                      capability::TemperatureChange, capability::HeatCapacity, capability::ViscousHeat,
                                      capability::Melting, capability::StateByParticle>;
  static constexpr std::string_view name = Base::name;
  static constexpr bool strainEnergyIsRate = true;
  static constexpr std::array<StateVariable, 7> stateVariables{
      {Base::stateVariables[0],
       Base::stateVariables[1],
       Base::stateVariables[2],
       Base::stateVariables[3],
       {"p.porosity", "1", "porosity"},
       {"p.plasticDilatation", "1", "relative plastic change of volume"},
       {"p.plasticWork", "J/m^3", "plastic work in the latest step"}}};

  Base base;  ///< model of the metal without pores

  static const input::Schema<GursonPlastic>& schema() {
    static const input::Schema<GursonPlastic> schema(name, "Porous metals: see elastic_plastic_hp.");
    return schema;
  }
  State initialState() const { return {0, 0, 0, 0, base.initialPorosity, 0, 0}; }
  State initialState(const Birth& birth) const {
    State state = initialState();
    if (base.porositySpreads)
      state.porosity = std::min(
          std::abs(base.initialPorosity + base.porosityDeviation * drawnNormal(Drawing::porosity, 0, birth.id)),
          greatestPorosity);
    return state;
  }

  Matrix3 updateStress(const Deformation& d, const Matrix3& oldStress, State& state) const {
    const Corotated step(d, oldStress);
    state.strainRate = std::sqrt(2.0 / 3.0) * step.strain.norm() / d.timeStep;
    const FlowState start = base.flowStateOf(base.compressionOf(d, oldStress), baseOf(state), d.timeStep);
    Matrix3 stress = deviator(step.stress) + 2 * start.shearModulus * deviator(step.strain);
    const double mean = yield(d, oldStress.trace() / 3, start, stress, state);
    stress.diagonal().array() += mean;
    stress = step.turned(stress);
    state.energy += stressWork(d, oldStress, stress) / base.material.density;
    return stress;
  }
  double initialWaveSpeed(double initialDensity) const { return base.initialWaveSpeed(initialDensity); }
  double waveSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return base.waveSpeed(initialDensity, d, stress, baseOf(state));
  }
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state) const {
    return base.bulkSpeed(initialDensity, d, stress, baseOf(state));
  }
  double strainEnergyDensity(const Deformation& d, const Matrix3& oldStress, const Matrix3& stress,
                             const State&) const {
    return stressWork(d, oldStress, stress);
  }
  /// Temperature change due to plastic work and to the change of volume [K].
  double temperatureChange(const Deformation& d, const Matrix3&, const State& state) const {
    const VolumeState volume = base.volumeState(d, 0, 0);
    const double byVolume = std::visit([&](const auto& model) { return model.heating(volume); }, base.equationOfState);
    const double j = d.deformationGradient.determinant();
    return byVolume + base.heatedShare * state.plasticWork * j /
                          (base.material.density * heatCapacity(d.deformationGradient, d.temperature));
  }
  double heatCapacity(const Matrix3& deformation, double temperature) const {
    return base.heatCapacity(deformation, temperature);
  }
  void addViscousHeat(State& state, double heat) const { state.energy += heat; }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const {
    return base.isMolten(deformation, stress, temperature);
  }

 private:
  static Base::State baseOf(const State& state) {
    return {state.plasticStrain, state.plasticStrainRate, state.strainRate, state.energy, {}};
  }
  /// Nucleated porosity per plastic strain [1].
  double nucleation(double strain) const {
    if (base.nucleationDeviation == 0) return 0;
    const double away = (strain - base.nucleationStrain) / base.nucleationDeviation;
    return base.nucleating / (base.nucleationDeviation * std::sqrt(2 * std::numbers::pi)) *
           std::exp(-0.5 * away * away);
  }
  /// Returns the trial deviator to the yield surface; the result is the mean stress [Pa].
  double yield(const Deformation& d, double oldMean, const FlowState& start, Matrix3& shear, State& state) const {
    const auto meanStress = [&](double dilatation) {
      VolumeState volume = base.volumeState(d, oldMean, state.energy);
      volume.dilatation -= dilatation;
      volume.volume *= std::exp(-state.dilatation - dilatation);
      return std::visit([&](const auto& model) { return model.meanStress(volume); }, base.equationOfState);
    };
    state.plasticStrainRate = state.plasticWork = 0;
    if (Base::isFluid(start)) {
      shear.setZero();
      return meanStress(0.0);
    }
    return std::visit(
        [&](const auto& model) {
          const auto yieldStress = [&](double strain) {
            FlowState now = start;
            now.plasticStrain += strain;
            now.plasticStrainRate = strain / d.timeStep;
            return model.flowStress(now);
          };
          std::optional<double> opening;
          if (base.poresEvolve) opening = meanStress(0.0) > 0 ? nucleation(state.plasticStrain) : 0;
          const GursonReturn back(std::get<GursonYield>(base.yieldCondition), yieldStress, meanStress,
                                  start.shearModulus, state.porosity, opening);
          const double trial = std::sqrt(1.5) * shear.norm();
          const auto result = back(trial);
          if (trial > 0) shear *= result.equivalent / trial;
          state.porosity = back.porosity(result.dilatation, result.plasticStrain);
          state.plasticStrain += result.plasticStrain;
          state.plasticStrainRate = result.plasticStrain / d.timeStep;
          state.dilatation += result.dilatation;
          state.plasticWork = result.work;
          return result.mean;
        },
        base.flow);
  }
};
static_assert(ConstitutiveModel<GursonPlastic>);

}  // namespace tushar::mpm::solid
