#pragma once

#include <Eigen/LU>

#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"

namespace tushar::mpm::solid {

/// Largest number of particles in one call of a constitutive model.
inline constexpr int stressGroup = 64;

/// Particles that are consecutive in memory, and pointers to the requested results at the end of a step.
struct StressPoints {
  int count = 0;
  double timeStep = 0;  ///< time step [s]
  const Matrix3* oldDeformationGradient = nullptr;
  const Matrix3* deformationGradient = nullptr;
  const Matrix3* velocityGradient = nullptr;  ///< velocity gradient [1/s]
  const double* temperature = nullptr;        ///< temperature [K]; null if no model uses it
  const Matrix3* oldStress = nullptr;         ///< old stress [Pa]; null if particles do not store it
  Matrix3* stress = nullptr;                  ///< stress [Pa]; null if not requested
  double* state = nullptr;                    ///< input and output; stateStride numbers for each particle
  int stateStride = 0;
  // Only for models with capability::PlaceAndTime.
  const Vec3* position = nullptr;       ///< position [m]
  const double* mass = nullptr;         ///< mass [kg]
  double time = 0;                      ///< time at the start of the step [s]
  double* waveSpeed = nullptr;          ///< wave speed [m/s]
  double* bulkSpeed = nullptr;          ///< bulk speed [m/s]; null if not requested
  double* temperatureChange = nullptr;  ///< temperature change [K]; null if not requested
  /// Strain energy density [J/m^3], per volume at F = I; null if not requested.
  double* strainEnergyDensity = nullptr;

  bool wantsWaveSpeedAndEnergyOnly() const { return !stress && !bulkSpeed && !temperatureChange; }
};

/// A constitutive model, called by one virtual call per group of particles.
class Model {
 public:
  virtual ~Model() = default;
  virtual std::string_view name() const = 0;
  /// Number of doubles in the State of a particle.
  virtual int stateSize() const = 0;
  virtual std::vector<StateVariable> stateVariables() const = 0;
  /// Variables of Uintah's model that are always 0 in this model: see capability::AbsentVariables.
  virtual std::vector<StateVariable> absentVariables() const = 0;
  virtual void initialize(double* state, const Birth& birth) const = 0;
  /// Whether the initial State depends on the particle: see capability::StateByParticle.
  virtual bool variesByParticle() const = 0;
  virtual bool usesTemperature() const = 0;
  /// Whether the stress depends only on F: see capability::DependsOnDeformationOnly.
  virtual bool dependsOnDeformationOnly() const = 0;
  /// Whether the model supports F-bar: see capability::FBar.
  virtual bool supportsFBar() const = 0;

  /// Whether the model uses the position and mass of the particle, and the time: see capability::PlaceAndTime.
  virtual bool usesPlaceAndTime() const = 0;

  /// Whether the work of a step changes the temperature.
  virtual bool changesTemperature() const = 0;
  /// Heat capacity [J/(kg K)] for F and a temperature [K]; `ofMaterial` is returned by models without HeatCapacity.
  virtual double heatCapacity(const Matrix3& deformation, double temperature, double ofMaterial) const = 0;
  /// Whether the State takes up the heat of the artificial viscosity: see capability::ViscousHeat.
  virtual bool hasViscousHeat() const = 0;
  /// Adds the heat of the artificial viscosity [J/kg] to the state of a particle; only if hasViscousHeat().
  virtual void addViscousHeat(double* state, double heat) const = 0;
  /// Radius of the average of plastic strain [m]; 0 for no average: see capability::Nonlocal.
  virtual double nonlocalLength() const = 0;
  /// Whether a particle with given F, stress [Pa] and temperature [K] is molten; false for models without Melting.
  virtual bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const = 0;
  /// Whether plastic flow has become unstable in the step: see capability::Stability; false for models without it.
  virtual bool isUnstable(const Deformation& d, const Matrix3& stress, const double* state) const = 0;
  /// Whether isUnstable() can be true.
  virtual bool checksStability() const = 0;
  /// Coefficients of the artificial viscosity that replace those of the scene, if any.
  virtual std::optional<ArtificialViscosity> ownViscosity() const = 0;

  /// Speed of the fastest wave at the start of the run [m/s].
  virtual double initialWaveSpeed(double initialDensity, double temperature) const = 0;
  /// The initial det F: see capability::InitialVolumeRatio.
  virtual double initialVolumeRatio() const = 0;
  /// Stress at the start of the run [Pa]: see capability::InitialStress.
  virtual Matrix3 initialStress() const = 0;
  virtual void updateStress(double initialDensity, const StressPoints& points) const = 0;
  /// Whether the model has a tangent: see capability::NominalTangent.
  virtual bool hasTangent() const = 0;
  /// Computes dP/dF of each point [Pa] from the state at the start of the step; only if hasTangent().
  virtual void nominalTangent(const StressPoints& points, Matrix9* tangent) const = 0;
  /// Computes J sigma for `count` deformation gradients [Pa]; only if dependsOnDeformationOnly().
  virtual void kirchhoffStress(const Matrix3* deformationGradient, int count, Matrix3* stress) const = 0;
};

/// Index of a state variable among the doubles of a particle; -1 if the model has no variable of this name.
inline int offsetOf(const Model& model, std::string_view label) {
  int offset = 0;
  for (const StateVariable& variable : model.stateVariables()) {
    if (variable.label == label) return offset;
    offset += variable.components;
  }
  return -1;
}

/// Makes a Model of the constitutive model M, whose capabilities are resolved at compile time.
template <ConstitutiveModel M>
class ModelOf : public Model {
 public:
  explicit ModelOf(const M& model) : model_(model) {}

  const M& model() const { return model_; }
  std::string_view name() const override { return M::name; }
  int stateSize() const override { return keptNumbers(); }
  std::vector<StateVariable> stateVariables() const override {
    std::vector<StateVariable> kept;
    if constexpr (hasState) {
      int numbers = keptNumbers();
      for (const StateVariable& variable : M::stateVariables)
        if ((numbers -= variable.components) >= 0) kept.push_back(variable);
    }
    return kept;
  }
  std::vector<StateVariable> absentVariables() const override {
    if constexpr (providesCapability<M, capability::AbsentVariables>)
      return {M::absentVariables.begin(), M::absentVariables.end()};
    return {};
  }
  void initialize(double* state, [[maybe_unused]] const Birth& birth) const override {
    if (!keepsState()) return;
    if constexpr (providesCapability<M, capability::StateByParticle>)
      store(model_.initialState(birth), state);
    else
      store(model_.initialState(), state);
  }
  bool variesByParticle() const override { return providesCapability<M, capability::StateByParticle>; }
  bool usesTemperature() const override { return !providesCapability<M, capability::IgnoresTemperature>; }
  bool dependsOnDeformationOnly() const override { return fromDeformation; }
  bool supportsFBar() const override { return fromDeformation || providesCapability<M, capability::FBar>; }
  bool usesPlaceAndTime() const override { return providesCapability<M, capability::PlaceAndTime>; }
  bool changesTemperature() const override { return providesCapability<M, capability::TemperatureChange>; }
  double heatCapacity(const Matrix3& deformation, double temperature, double ofMaterial) const override {
    if constexpr (providesCapability<M, capability::HeatCapacity>)
      return model_.heatCapacity(deformation, temperature);
    else
      return ofMaterial;
  }
  bool hasViscousHeat() const override { return providesCapability<M, capability::ViscousHeat>; }
  void addViscousHeat(double* numbers, double heat) const override {
    if constexpr (providesCapability<M, capability::ViscousHeat>) {
      State state = load(numbers);
      model_.addViscousHeat(state, heat);
      store(state, numbers);
    }
  }
  double nonlocalLength() const override {
    if constexpr (providesCapability<M, capability::Nonlocal>) return model_.nonlocalLength();
    return 0;
  }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const override {
    if constexpr (providesCapability<M, capability::Melting>)
      return model_.isMolten(deformation, stress, temperature);
    else
      return false;
  }
  bool isUnstable([[maybe_unused]] const Deformation& d, [[maybe_unused]] const Matrix3& stress,
                  [[maybe_unused]] const double* state) const override {
    if constexpr (providesCapability<M, capability::Stability>)
      return model_.isUnstable(d, stress, load(state));
    else
      return false;
  }
  bool checksStability() const override {
    if constexpr (providesCapability<M, capability::Stability>)
      return model_.checksStability();
    else
      return false;
  }
  std::optional<ArtificialViscosity> ownViscosity() const override {
    if constexpr (providesCapability<M, capability::OwnViscosity>)
      return M::ownViscosity;
    else
      return std::nullopt;
  }

  void updateStress(double initialDensity, const StressPoints& points) const override {
    if constexpr (providesCapability<M, capability::Vectorized>)
      if (points.wantsWaveSpeedAndEnergyOnly()) return findWaveSpeeds(initialDensity, points);
    for (int k = 0; k < points.count; ++k) {
      const Deformation d = deformation(points, k);
      double* const numbers = points.state + k * points.stateStride;
      const Matrix3 before = oldStress(points, k);
      State state = load(numbers);
      const Matrix3 after = model_.updateStress(d, before, state);
      if (points.stress) points.stress[k] = after;
      store(state, numbers);
      finish(initialDensity, points, k, d, before, after, state, model_.waveSpeed(initialDensity, d, after, state));
    }
  }

  double initialWaveSpeed(double initialDensity, double temperature) const override {
    if constexpr (providesCapability<M, capability::InitialWaveSpeed>) {
      return model_.initialWaveSpeed(initialDensity);
    } else {
      const Deformation d{Matrix3::Identity(), Matrix3::Identity(), Matrix3::Zero(), 0, temperature};
      State state = model_.initialState();
      const Matrix3 stress = model_.updateStress(d, Matrix3::Zero(), state);
      return model_.waveSpeed(initialDensity, d, stress, state);
    }
  }

  Matrix3 initialStress() const override {
    if constexpr (providesCapability<M, capability::InitialStress>)
      return model_.initialStress();
    else
      return Matrix3::Zero();
  }
  double initialVolumeRatio() const override {
    if constexpr (providesCapability<M, capability::InitialVolumeRatio>)
      return model_.initialVolumeRatio();
    else
      return 1;
  }

  bool hasTangent() const override { return providesCapability<M, capability::NominalTangent>; }
  void nominalTangent(const StressPoints& points, Matrix9* tangent) const override {
    if constexpr (providesCapability<M, capability::NominalTangent>)
      for (int k = 0; k < points.count; ++k)
        tangent[k] = model_.nominalTangent(deformation(points, k), oldStress(points, k),
                                           load(points.state + k * points.stateStride));
  }

  void kirchhoffStress(const Matrix3* f, int count, Matrix3* stress) const override {
    if constexpr (providesCapability<M, capability::Vectorized>) {
      for (int k = 0; k < count; k += Lanes::count)
        storeLanes(model_.kirchhoffStress(lanesOf(f + k, count - k)), stress + k, count - k);
    } else if constexpr (fromDeformation) {
      const Matrix3 zero = Matrix3::Zero();
      State none{};
      for (int k = 0; k < count; ++k)
        stress[k] = f[k].determinant() * model_.updateStress({f[k], f[k], zero, 0.0, 0.0}, zero, none);
    }
  }

 private:
  using State = typename M::State;
  static constexpr bool hasState = !std::is_empty_v<State>;
  static constexpr bool fromDeformation = providesCapability<M, capability::DependsOnDeformationOnly>;

  static void storeFew(const Lanes& values, int count, double* to) {
    for (int lane = 0; lane < std::min(count, Lanes::count); ++lane) to[lane] = values[lane];
  }
  /// Computes wave speeds and, if requested, strain energies.
  void findWaveSpeeds(double initialDensity, const StressPoints& points) const {
    for (int k = 0; k < points.count; k += Lanes::count) {
      const int count = points.count - k;
      const TensorOf<Lanes> f = lanesOf(points.deformationGradient + k, count);
      storeFew(model_.waveSpeed(initialDensity, f), count, points.waveSpeed + k);
      if (points.strainEnergyDensity) storeFew(model_.strainEnergyDensity(f), count, points.strainEnergyDensity + k);
    }
  }
  void finish(double initialDensity, const StressPoints& points, int k, const Deformation& d, const Matrix3& before,
              const Matrix3& after, const State& state, double waveSpeed) const {
    points.waveSpeed[k] = waveSpeed;
    if (points.bulkSpeed) points.bulkSpeed[k] = bulkSpeed(initialDensity, d, after, state, waveSpeed);
    if (points.temperatureChange) {
      points.temperatureChange[k] = 0;
      if constexpr (providesCapability<M, capability::TemperatureChange>)
        points.temperatureChange[k] = model_.temperatureChange(d, after, state);
    }
    if (points.strainEnergyDensity) points.strainEnergyDensity[k] = model_.strainEnergyDensity(d, before, after, state);
  }
  /// Wave speed for the artificial viscosity [m/s]: see capability::BulkSpeed.
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state,
                   double waveSpeed) const {
    if constexpr (providesCapability<M, capability::BulkSpeed>)
      return model_.bulkSpeed(initialDensity, d, stress, state);
    else
      return waveSpeed;
  }
  static Deformation deformation(const StressPoints& points, int k) {
    Deformation d{points.deformationGradient[k], points.oldDeformationGradient[k], points.velocityGradient[k],
                  points.timeStep, points.temperature ? points.temperature[k] : 0.0};
    if constexpr (providesCapability<M, capability::PlaceAndTime>) {
      d.position = points.position[k];
      d.mass = points.mass[k];
      d.time = points.time;
    }
    return d;
  }
  static Matrix3 oldStress(const StressPoints& points, int k) {
    return points.oldStress ? points.oldStress[k] : Matrix3(Matrix3::Zero());
  }
  bool keepsState() const {
    if constexpr (providesCapability<M, capability::OptionalState>)
      return model_.keepsState();
    else
      return hasState;
  }
  int keptNumbers() const {
    if constexpr (providesCapability<M, capability::PartialState>) return model_.keptNumbers();
    return keepsState() ? int(sizeof(State) / sizeof(double)) : 0;
  }
  State load(const double* numbers) const {
    if constexpr (providesCapability<M, capability::PartialState>) {
      State state;
      std::memcpy(&state, numbers, sizeof(double) * keptNumbers());
      return state;
    } else {
      State state = model_.initialState();
      if constexpr (hasState) {
        if (keepsState()) std::memcpy(&state, numbers, sizeof state);
      }
      return state;
    }
  }
  void store(const State& state, double* numbers) const {
    if constexpr (providesCapability<M, capability::PartialState>) {
      std::memcpy(numbers, &state, sizeof(double) * keptNumbers());
    } else if constexpr (hasState) {
      if (keepsState()) std::memcpy(numbers, &state, sizeof state);
    }
  }

  M model_;
};

}  // namespace tushar::mpm::solid
