#pragma once

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "components/mpm/solid/constitutive/capabilities.hpp"
#include "components/mpm/solid/constitutive/model_types.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// Stops compilation, with a message, if M lacks a constant or a variable that every model must have.
template <class M>
consteval bool checkDescription() {
  static_assert(
      requires {
        { M::name } -> std::convertible_to<std::string_view>;
      },
      "a constitutive model needs `static constexpr std::string_view name`: its type in a scene");
  static_assert(
      requires {
        { M::strainEnergyIsRate } -> std::same_as<const bool&>;
      },
      "a constitutive model needs `static constexpr bool strainEnergyIsRate`");
  static_assert(
      requires {
        { M::schema() } -> std::same_as<const input::Schema<M>&>;
      },
      "a constitutive model needs `static const input::Schema<M>& schema()` for its own type M");
  static_assert(std::is_trivially_copyable_v<M> && std::is_trivially_copyable_v<typename M::State>,
                "a constitutive model and its State must be trivially copyable");
  return true;
}

/// Stops compilation, with a message, if not all variables of a State have names.
template <class M>
consteval bool checkState() {
  static_assert(
      requires { Member<M, typename M::State>{&M::initialState}; },
      "a constitutive model needs `State initialState() const`");
  if constexpr (!std::is_empty_v<typename M::State>) {
    constexpr bool areNamed = requires { requires capability::isListOfVariables<decltype(&M::stateVariables)>; };
    static_assert(areNamed,
                  "a State that is not empty needs `static constexpr std::array<StateVariable, N> stateVariables`");
    if constexpr (areNamed) {
      constexpr auto size = [] {
        std::size_t numbers = 0;
        for (const StateVariable& variable : M::stateVariables) numbers += std::size_t(variable.components);
        return numbers * sizeof(double);
      };
      static_assert(size() == sizeof(typename M::State),
                    "stateVariables must name every double and every Tensor of the State, in their order");
      constexpr auto areOfParticles = [] {
        for (const StateVariable& variable : M::stateVariables)
          if (!variable.label.starts_with("p.")) return false;
        return true;
      };
      static_assert(areOfParticles(), "the names of stateVariables start with p.");
    }
  }
  return true;
}

/// Stops compilation, with a message, if M lacks a function that every model must have.
template <class M>
consteval bool checkFunctions() {
  using State = typename M::State;
  static_assert(
      requires { Member<M, Matrix3, const Deformation&, const Matrix3&, State&>{&M::updateStress}; },
      "a constitutive model needs `Matrix3 updateStress(const Deformation&, const Matrix3& oldStress, "
      "State&) const`");
  static_assert(
      requires { Member<M, double, double, const Deformation&, const Matrix3&, const State&>{&M::waveSpeed}; },
      "a constitutive model needs `double waveSpeed(double initialDensity, const Deformation&, const Matrix3& stress, "
      "const State&) const`");
  static_assert(
      requires {
        Member<M, double, const Deformation&, const Matrix3&, const Matrix3&, const State&>{&M::strainEnergyDensity};
      },
      "a constitutive model needs `double strainEnergyDensity(const Deformation&, const Matrix3& oldStress, const "
      "Matrix3& stress, const State&) const`");
  return true;
}

/// Always true; otherwise compilation stops with a message that names the missing members of M.
template <class M>
consteval bool isConstitutiveModel() {
  constexpr bool hasState = requires { typename M::State; };
  constexpr bool hasCapabilities = requires { typename M::Capabilities; };
  static_assert(hasState, "a constitutive model needs `struct State`: the internal variables of one particle");
  static_assert(hasCapabilities, "a constitutive model needs `using Capabilities = CapabilityList<...>`");
  if constexpr (hasState && hasCapabilities)
    return checkDescription<M>() && checkState<M>() && checkFunctions<M>() && capability::OfModels::check<M>();
  return true;
}

/// A model of the stress of a solid as a function of its deformation. A model is one file in this folder and one line
/// in all.hpp; README.md has an example.
///
/// - `State`: internal variables of one particle; a struct of doubles and Tensors only, empty if there are none. If it
///   is not empty, `static constexpr std::array<StateVariable, N> stateVariables` names them in their order.
/// - `Capabilities`: what the model can do beyond the members below; capabilities.hpp has them all.
/// - `name`: the type in a scene.  `schema()`: the constants that a scene gives, with their units.
/// - `initialState()`: the State of a particle at the start of the run.
/// - `updateStress`: Cauchy stress [Pa] at the end of the step from that at the start; also updates the State to
///   the end of the step.
/// - `waveSpeed`: speed of the fastest elastic wave [m/s] for an initial density [kg/m^3].
/// - `strainEnergyDensity`: energy per initial volume [J/m^3]; a hyperelastic model returns W(F), any
///   other the increment of the step (`strainEnergyIsRate` true).
///
/// Use it in assertions, not to select an overload: a type that is not a model stops compilation with a message.
template <class M>
concept ConstitutiveModel = isConstitutiveModel<M>();

}  // namespace tushar::mpm::solid
