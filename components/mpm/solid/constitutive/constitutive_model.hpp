#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "components/mpm/solid/tensor.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Pressure against compression, q = rho (A1 c |D| h + A2 D^2 h^2) where D = tr L < 0; von Neumann & Richtmyer, with
/// the linear term of Landshoff.
struct ArtificialViscosity {
  double linear = 0.2;     ///< A1
  double quadratic = 2.0;  ///< A2
};

/// What a scene says of a material besides its constitutive model.
struct MaterialConstants {
  double density = 0;            ///< at the start, kg/m^3
  double specificHeat = 0;       ///< J/(kg K)
  double meltTemperature = 295;  ///< K
  double roomTemperature = 294;  ///< K
};

/// What a constitutive model is told about one material point in one step.
struct Deformation {
  Matrix3 deformationGradient;     ///< F at the end of the step, 1
  Matrix3 oldDeformationGradient;  ///< F at its begin, 1
  Matrix3 velocityGradient;        ///< L = dv_i/dx_j in the step, 1/s
  double timeStep;                 ///< s
  double temperature;              ///< K
};

/// A variable of a model's State, which a scene may save by its label.
struct StateVariable {
  std::string_view label;  ///< as in Uintah: `p.plasticStrain`
  std::string_view unit;
  std::string_view description;
  int components = 1;  ///< 1, or 9 for a Tensor
};

/// How a solid answers to being deformed: its constants, read by schema(), and the members below. A model is one file
/// in this folder and one line in all.hpp.
///
/// - `State`: internal variables of one particle; a struct of doubles and Tensors only, empty where there are none.
///   Where it is not empty, `static constexpr std::array<StateVariable, N> stateVariables` names them in their order.
/// - optional `static constexpr std::array<StateVariable, N> absentVariables`: those of Uintah that are always 0 here.
/// - optional `bool keepsState() const`: false where the constants make that needless; initialState() then stands in.
/// - `updateStress`: Cauchy stress at the end of the step, Pa, from that at its begin; brings the State to the end.
/// - `waveSpeed`: of the fastest elastic wave, m/s, from the density at the start of the run, kg/m^3.
/// - optional `static constexpr bool dependsOnDeformationOnly = true`: updateStress looks at F alone; then the stress
/// of
///   a particle need not be kept. Such a model may have `TensorOf<Real> kirchhoffStress(const TensorOf<Real>& f)
///   const`, J sigma, and `Real waveSpeed(double initialDensity, const TensorOf<Real>& f) const`, templates for a Real
///   that is a number or Lanes: several particles are then worked on at once.
/// - optional `static constexpr bool feelsVolumeOfEndOnly = true`: updateStress looks at F, F_old and the State, and
///   F -> s F changes nothing but the mean of J sigma. So is one that dependsOnDeformationOnly. For F-bar in implicit
///   steps.
/// - optional `static constexpr bool usesTemperature = false`: updateStress never looks at the temperature.
/// - optional `MaterialConstants material`: filled with those of the model's material.
/// - optional `double temperatureChange(const Deformation&, const Matrix3& stress, const State&) const`: by the work of
///   the step, K.
/// - optional `void addHeat(State&, double heat) const`: told of the heat of the artificial viscosity, J/kg;
///   where it is missing, the viscosity heats nothing, as in Uintah.
/// - optional `static constexpr ArtificialViscosity ownViscosity`: takes the place of the scene's.
/// - optional `double initialWaveSpeed(double initialDensity) const`: at the start, where it is not waveSpeed of F = I.
/// - optional `bulkSpeed`, with the arguments of waveSpeed: sqrt(K / density) for the artificial viscosity, m/s.
/// - optional `Matrix9 nominalTangent(const Deformation&, const Matrix3& oldStress, const State& old) const`: dP/dF,
/// Pa,
///   at the end of a step whose F changes as a whole, L dt = F F_old^-1 - I; P = J sigma F^-T, row 3 i + J, column
///   3 k + L; consistent with what updateStress makes of the state at the begin. For implicit time steps.
/// - `strainEnergyDensity`: J per m^3 of the volume at the start of the run; a hyperelastic model returns W(F), any
///   other what the step adds to it (`strainEnergyIsRate` true).
template <class Model>
concept ConstitutiveModel = std::is_trivially_copyable_v<typename Model::State> &&
    std::is_trivially_copyable_v<Model> &&
    requires(const Model& model, const Deformation& deformation, const Matrix3& stress, typename Model::State& state,
             const typename Model::State& constState, double density) {
  { Model::name } -> std::convertible_to<std::string_view>;
  { Model::strainEnergyIsRate } -> std::convertible_to<bool>;
  { Model::schema() } -> std::same_as<const input::Schema<Model>&>;
  { model.initialState() } -> std::same_as<typename Model::State>;
  { model.updateStress(deformation, stress, state) } -> std::same_as<Matrix3>;
  { model.waveSpeed(density, deformation, stress, constState) } -> std::same_as<double>;
  { model.strainEnergyDensity(deformation, stress, stress, constState) } -> std::same_as<double>;
};

}  // namespace tushar::mpm::solid
