#pragma once

#include <Eigen/LU>

#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "components/mpm/solid/constitutive/constitutive_model.hpp"
#include "components/mpm/solid/constitutive/tensor_lanes.hpp"

namespace tushar::mpm::solid {

/// Most particles that a constitutive model is given at once.
inline constexpr int stressGroup = 64;

/// Particles one after another in memory, whose stress is to be brought to the end of a step.
struct StressPoints {
  int count = 0;
  double timeStep = 0;  ///< s
  const Matrix3* oldDeformationGradient = nullptr;
  const Matrix3* deformationGradient = nullptr;
  const Matrix3* velocityGradient = nullptr;  ///< 1/s
  const double* temperature = nullptr;        ///< K; null where no model asks
  const Matrix3* oldStress = nullptr;         ///< Pa; null where the stress is not kept
  Matrix3* stress = nullptr;                  ///< Pa; null where nobody asks
  double* state = nullptr;                    ///< of stateStride numbers a particle: before and after
  int stateStride = 0;
  double* waveSpeed = nullptr;            ///< m/s
  double* bulkSpeed = nullptr;            ///< m/s; null where nobody asks
  double* temperatureChange = nullptr;    ///< K; null where nobody asks
  double* strainEnergyDensity = nullptr;  ///< J/m^3 of the volume at the start; null where nobody asks

  bool asksForWaveSpeedOnly() const { return !stress && !bulkSpeed && !temperatureChange && !strainEnergyDensity; }
};

/// A constitutive model behind one virtual call per group of particles.
class Model {
 public:
  virtual ~Model() = default;
  virtual std::string_view name() const = 0;
  /// Numbers that a particle keeps for the model.
  virtual int stateSize() const = 0;
  virtual std::vector<StateVariable> stateVariables() const = 0;
  /// Variables that Uintah has, and that are always 0 here.
  virtual std::vector<StateVariable> absentVariables() const = 0;
  virtual void initialize(double* state) const = 0;
  virtual bool usesTemperature() const = 0;
  /// Whether the stress is a function of F alone: nothing but F needs to be kept then.
  virtual bool dependsOnDeformationOnly() const = 0;
  /// Whether the volume may be another than that of F, and only the pressure follows.
  virtual bool feelsVolumeOfEndOnly() const = 0;

  /// Whether the work of a step changes the temperature.
  virtual bool heats() const = 0;
  /// Whether the artificial viscosity heats the material.
  virtual bool takesHeat() const = 0;
  /// Tells the state of a particle of the heat of the artificial viscosity, J/kg; only where takesHeat().
  virtual void addHeat(double* state, double heat) const = 0;
  /// Whether a point with F, a stress (Pa) and a temperature (K) is above what melts it; never where nothing melts.
  virtual bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const = 0;
  /// Coefficients that the model has instead of the scene's.
  virtual std::optional<ArtificialViscosity> ownViscosity() const = 0;

  /// Of the fastest wave at the start, m/s.
  virtual double initialWaveSpeed(double initialDensity, double temperature) const = 0;
  virtual void updateStress(double initialDensity, const StressPoints& points) const = 0;
  /// Whether nominalTangent is there.
  virtual bool hasTangent() const = 0;
  /// dP/dF of each point, Pa, whose state is that at the begin; see ConstitutiveModel. Only where hasTangent().
  virtual void nominalTangent(const StressPoints& points, Matrix9* tangent) const = 0;
  /// J sigma of `count` deformation gradients, Pa; only where the stress depends on F alone.
  virtual void kirchhoffStress(const Matrix3* deformationGradient, int count, Matrix3* stress) const = 0;
};

/// Where a state variable stands among the numbers of a particle; -1 if the model has none of that name.
inline int offsetOf(const Model& model, std::string_view label) {
  int offset = 0;
  for (const StateVariable& variable : model.stateVariables()) {
    if (variable.label == label) return offset;
    offset += variable.components;
  }
  return -1;
}

template <ConstitutiveModel M>
class ModelOf : public Model {
 public:
  explicit ModelOf(const M& model) : model_(model) {}

  const M& model() const { return model_; }
  std::string_view name() const override { return M::name; }
  int stateSize() const override { return keepsState() ? int(sizeof(State) / sizeof(double)) : 0; }
  std::vector<StateVariable> stateVariables() const override {
    if constexpr (hasState) {
      if (keepsState()) return {M::stateVariables.begin(), M::stateVariables.end()};
    }
    return {};
  }
  std::vector<StateVariable> absentVariables() const override {
    if constexpr (requires { M::absentVariables; }) return {M::absentVariables.begin(), M::absentVariables.end()};
    return {};
  }
  void initialize(double* state) const override {
    if (keepsState()) store(model_.initialState(), state);
  }
  bool usesTemperature() const override {
    if constexpr (requires { M::usesTemperature; })
      return M::usesTemperature;
    else
      return true;
  }
  bool dependsOnDeformationOnly() const override { return fromDeformation; }
  bool feelsVolumeOfEndOnly() const override {
    if constexpr (requires { M::feelsVolumeOfEndOnly; })
      return M::feelsVolumeOfEndOnly;
    else
      return fromDeformation;
  }
  bool heats() const override { return heating; }
  bool takesHeat() const override { return heatable; }
  void addHeat(double* numbers, double heat) const override {
    if constexpr (heatable) {
      State state = load(numbers);
      model_.addHeat(state, heat);
      store(state, numbers);
    }
  }
  bool isMolten(const Matrix3& deformation, const Matrix3& stress, double temperature) const override {
    if constexpr (requires { model_.isMolten(deformation, stress, temperature); })
      return model_.isMolten(deformation, stress, temperature);
    else
      return false;
  }
  std::optional<ArtificialViscosity> ownViscosity() const override {
    if constexpr (requires { M::ownViscosity; })
      return M::ownViscosity;
    else
      return std::nullopt;
  }

  void updateStress(double initialDensity, const StressPoints& points) const override {
    if constexpr (severalAtOnce)
      if (points.asksForWaveSpeedOnly()) return findWaveSpeeds(initialDensity, points);
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
    if constexpr (requires { model_.initialWaveSpeed(initialDensity); }) {
      return model_.initialWaveSpeed(initialDensity);
    } else {
      const Deformation d{Matrix3::Identity(), Matrix3::Identity(), Matrix3::Zero(), 0, temperature};
      State state = model_.initialState();
      const Matrix3 stress = model_.updateStress(d, Matrix3::Zero(), state);
      return model_.waveSpeed(initialDensity, d, stress, state);
    }
  }

  bool hasTangent() const override { return tangential; }
  void nominalTangent(const StressPoints& points, Matrix9* tangent) const override {
    if constexpr (tangential)
      for (int k = 0; k < points.count; ++k)
        tangent[k] = model_.nominalTangent(deformation(points, k), oldStress(points, k),
                                           load(points.state + k * points.stateStride));
  }

  void kirchhoffStress(const Matrix3* f, int count, Matrix3* stress) const override {
    if constexpr (severalAtOnce) {
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
  static constexpr bool tangential = requires(const M& m, const Deformation& d, const Matrix3& s, const State& state) {
    m.nominalTangent(d, s, state);
  };
  static constexpr bool heating = requires(const M& m, const Deformation& d, const Matrix3& s, const State& state) {
    m.temperatureChange(d, s, state);
  };
  static constexpr bool heatable = requires(const M& m, State& state) { m.addHeat(state, 0.0); };
  static constexpr bool fromDeformation = [] {
    if constexpr (requires { M::dependsOnDeformationOnly; })
      return M::dependsOnDeformationOnly;
    else
      return false;
  }();

  static constexpr bool severalAtOnce = requires(const M& m, const TensorOf<Lanes>& f) {
    m.kirchhoffStress(f);
    m.waveSpeed(1.0, f);
  };

  void findWaveSpeeds(double initialDensity, const StressPoints& points) const {
    for (int k = 0; k < points.count; k += Lanes::count) {
      const int count = points.count - k;
      const Lanes speed = model_.waveSpeed(initialDensity, lanesOf(points.deformationGradient + k, count));
      for (int lane = 0; lane < std::min(count, Lanes::count); ++lane) points.waveSpeed[k + lane] = speed[lane];
    }
  }
  void finish(double initialDensity, const StressPoints& points, int k, const Deformation& d, const Matrix3& before,
              const Matrix3& after, const State& state, double waveSpeed) const {
    points.waveSpeed[k] = waveSpeed;
    if (points.bulkSpeed) points.bulkSpeed[k] = bulkSpeed(initialDensity, d, after, state, waveSpeed);
    if (points.temperatureChange) {
      points.temperatureChange[k] = 0;
      if constexpr (heating) points.temperatureChange[k] = model_.temperatureChange(d, after, state);
    }
    if (points.strainEnergyDensity) points.strainEnergyDensity[k] = model_.strainEnergyDensity(d, before, after, state);
  }
  /// Speed for the artificial viscosity: of the model where it gives one, else that of its fastest wave.
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state,
                   double waveSpeed) const {
    if constexpr (requires { model_.bulkSpeed(initialDensity, d, stress, state); })
      return model_.bulkSpeed(initialDensity, d, stress, state);
    else
      return waveSpeed;
  }
  static Deformation deformation(const StressPoints& points, int k) {
    return {points.deformationGradient[k], points.oldDeformationGradient[k], points.velocityGradient[k],
            points.timeStep, points.temperature ? points.temperature[k] : 0.0};
  }
  static Matrix3 oldStress(const StressPoints& points, int k) {
    return points.oldStress ? points.oldStress[k] : Matrix3(Matrix3::Zero());
  }
  bool keepsState() const {
    if constexpr (requires { model_.keepsState(); })
      return model_.keepsState();
    else
      return hasState;
  }
  State load(const double* numbers) const {
    State state = model_.initialState();
    if constexpr (hasState) {
      if (keepsState()) std::memcpy(&state, numbers, sizeof state);
    }
    return state;
  }
  void store(const State& state, double* numbers) const {
    if constexpr (hasState) {
      if (keepsState()) std::memcpy(numbers, &state, sizeof state);
    }
  }

  M model_;
};

}  // namespace tushar::mpm::solid
