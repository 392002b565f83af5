#pragma once

#include <cstring>
#include <memory>
#include <vector>

#include "components/mpm/solid/constitutive_model.hpp"

namespace tushar::mpm::solid {

/// Particles one after another in memory, whose stress is to be brought to the end of a step.
struct StressPoints {
  int count = 0;
  double timeStep = 0;  ///< s
  const Matrix3* oldDeformationGradient = nullptr;
  const Matrix3* deformationGradient = nullptr;
  const Matrix3* velocityGradient = nullptr;  ///< 1/s
  const double* temperature = nullptr;        ///< K; null where no model asks
  const Matrix3* oldStress = nullptr;         ///< Pa
  Matrix3* stress = nullptr;                  ///< Pa
  double* state = nullptr;                    ///< of stateSize() numbers a particle: before and after
  int stateStride = 0;                        ///< numbers from one particle to the next
  double* waveSpeed = nullptr;                ///< m/s
  double* bulkSpeed = nullptr;                ///< m/s; null where nobody asks
  double* strainEnergyDensity = nullptr;      ///< J/m^3 of the volume at the start; null where nobody asks
};

/// A constitutive model behind one virtual call per group of particles.
class Model {
 public:
  virtual ~Model() = default;
  virtual std::string_view name() const = 0;
  /// Numbers that a particle keeps for the model.
  virtual int stateSize() const = 0;
  virtual std::vector<StateVariable> stateVariables() const = 0;
  virtual void initialize(double* state) const = 0;
  virtual bool usesTemperature() const = 0;
  virtual void updateStress(double initialDensity, const StressPoints& points) const = 0;
};

template <ConstitutiveModel M>
class ModelOf : public Model {
 public:
  explicit ModelOf(const M& model) : model_(model) {}

  const M& model() const { return model_; }
  std::string_view name() const override { return M::name; }
  int stateSize() const override { return hasState ? int(sizeof(State) / sizeof(double)) : 0; }
  std::vector<StateVariable> stateVariables() const override {
    if constexpr (hasState)
      return {M::stateVariables.begin(), M::stateVariables.end()};
    else
      return {};
  }
  void initialize(double* state) const override { store(model_.initialState(), state); }

  bool usesTemperature() const override {
    if constexpr (requires { M::usesTemperature; })
      return M::usesTemperature;
    else
      return true;
  }

  void updateStress(double initialDensity, const StressPoints& points) const override {
    for (int k = 0; k < points.count; ++k) {
      const Deformation d{points.deformationGradient[k], points.oldDeformationGradient[k], points.velocityGradient[k],
                          points.timeStep, points.temperature ? points.temperature[k] : 0.0};
      double* const numbers = points.state + k * points.stateStride;
      const Matrix3 before = points.oldStress[k];
      State state = load(numbers);
      const Matrix3 after = model_.updateStress(d, before, state);
      points.stress[k] = after;
      store(state, numbers);
      points.waveSpeed[k] = model_.waveSpeed(initialDensity, d, after, state);
      if (points.bulkSpeed) points.bulkSpeed[k] = bulkSpeed(initialDensity, d, after, state, points.waveSpeed[k]);
      if (points.strainEnergyDensity)
        points.strainEnergyDensity[k] = model_.strainEnergyDensity(d, before, after, state);
    }
  }

 private:
  using State = typename M::State;
  static constexpr bool hasState = !std::is_empty_v<State>;

  /// Speed for the artificial viscosity: of the model where it gives one, else that of its fastest wave.
  double bulkSpeed(double initialDensity, const Deformation& d, const Matrix3& stress, const State& state,
                   double waveSpeed) const {
    if constexpr (requires { model_.bulkSpeed(initialDensity, d, stress, state); })
      return model_.bulkSpeed(initialDensity, d, stress, state);
    else
      return waveSpeed;
  }
  static State load(const double* numbers) {
    State state{};
    if constexpr (hasState) std::memcpy(&state, numbers, sizeof state);
    return state;
  }
  static void store(const State& state, double* numbers) {
    if constexpr (hasState) std::memcpy(numbers, &state, sizeof state);
  }

  M model_;
};

}  // namespace tushar::mpm::solid
