#pragma once

#include <concepts>
#include <string_view>
#include <type_traits>

#include "components/mpm/solid/constitutive/capability_list.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

/// The state of a material point on which its yield stress depends.
struct FlowState {
  double plasticStrain;          ///< equivalent plastic strain [1]
  double strainRate;             ///< equivalent strain rate [1/s]
  double temperature;            ///< temperature [K]
  double shearModulus;           ///< shear modulus [Pa]
  double density = 0;            ///< density [kg/m^3]
  double meltTemperature = 0;    ///< melting temperature [K]
  double plasticStrainRate = 0;  ///< plastic strain rate, averaged over the step [1/s]
};

namespace capability {

/// The slope d sigma_y / d e_p at a constant rate [Pa]; without it, finite differences are used.
struct Hardening {
  struct Name {
    int hardening;
  };
  template <class Flow>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<Flow, Hardening>;
    constexpr bool isAbsent = requires { &Both<Flow, Name>::hardening; };
    static_assert(isNamed || isAbsent,
                  "the member `hardening` is used only if the flow model lists capability::Hardening");
    constexpr bool fits = requires { Member<Flow, double, const FlowState&>{&Flow::hardening}; };
    static_assert(!isNamed || fits,
                  "capability::Hardening needs the public member `double hardening(const FlowState&) const`");
    return true;
  }
};

/// Whether the yield stress depends on FlowState::plasticStrainRate, which then changes with the plastic strain of the
/// step. Offer it in addition to Hardening if the constants of the model decide whether it does.
struct PlasticRate {
  struct Name {
    int dependsOnPlasticRate;
  };
  template <class Flow>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<Flow, PlasticRate>;
    constexpr bool isAbsent = requires { &Both<Flow, Name>::dependsOnPlasticRate; };
    static_assert(isNamed || isAbsent,
                  "the member `dependsOnPlasticRate` is used only if the flow model lists capability::PlasticRate");
    constexpr bool fits = requires { Member<Flow, bool>{&Flow::dependsOnPlasticRate}; };
    static_assert(!isNamed || fits,
                  "capability::PlasticRate needs the public member `bool dependsOnPlasticRate() const`");
    return true;
  }
};

/// All capabilities that a flow model can name.
using OfFlowModels = CapabilityList<Hardening, PlasticRate>;

}  // namespace capability

/// Always true; otherwise compilation stops with a message that says what is missing in Flow.
template <class Flow>
consteval bool isFlowRule() {
  static_assert(
      requires {
        { Flow::name } -> std::convertible_to<std::string_view>;
      },
      "a flow model needs `static constexpr std::string_view name`: its type in a scene");
  static_assert(
      requires {
        { Flow::schema() } -> std::same_as<const input::Schema<Flow>&>;
      },
      "a flow model needs `static const input::Schema<Flow>& schema()` for its own type Flow");
  static_assert(
      requires { Member<Flow, double, const FlowState&>{&Flow::flowStress}; },
      "a flow model needs `double flowStress(const FlowState&) const`");
  constexpr bool hasCapabilities = requires { typename Flow::Capabilities; };
  static_assert(hasCapabilities, "a flow model needs `using Capabilities = CapabilityList<...>`");
  if constexpr (hasCapabilities) return capability::OfFlowModels::check<Flow>();
  return true;
}

/// A yield stress as a function of the state: flowStress [Pa]. A flow model is one struct and one line in FlowModel of
/// flow.hpp. Use the concept in assertions: a type that is not a flow model stops compilation with a message.
template <class Flow>
concept FlowRule = isFlowRule<Flow>();

}  // namespace tushar::mpm::solid
