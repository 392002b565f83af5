#pragma once

#include "components/mpm/solid/constitutive/capability_list.hpp"
#include "components/mpm/solid/constitutive/model_types.hpp"

// Capabilities of constitutive models that concern the start of a run.

namespace tushar::mpm::solid::capability {

struct DependsOnDeformationOnly;

/// The initial det F of particles, which determines their initial stress through updateStress. Particles fill their
/// body in this deformed state. Without this capability det F is 1, and there is no initial stress unless the model
/// names InitialStress. Offer it for materials that may have an initial pressure.
struct InitialVolumeRatio {
  struct Name {
    int initialVolumeRatio;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, InitialVolumeRatio>;
    constexpr bool isAbsent = requires { &Both<M, Name>::initialVolumeRatio; };
    static_assert(isNamed || isAbsent,
                  "the member `initialVolumeRatio` is used only if the model lists capability::InitialVolumeRatio");
    constexpr bool fits = requires { Member<M, double>{&M::initialVolumeRatio}; };
    static_assert(!isNamed || fits,
                  "capability::InitialVolumeRatio needs the public member `double initialVolumeRatio() const`");
    return true;
  }
};

/// Stress at the start of the run [Pa]; without this capability it is 0. Offer it for solids whose pores contain a
/// fluid under pressure.
struct InitialStress {
  struct Name {
    int initialStress;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, InitialStress>;
    constexpr bool isAbsent = requires { &Both<M, Name>::initialStress; };
    static_assert(isNamed || isAbsent,
                  "the member `initialStress` is used only if the model lists capability::InitialStress");
    constexpr bool fits = requires { Member<M, Matrix3>{&M::initialStress}; };
    static_assert(!isNamed || fits,
                  "capability::InitialStress needs the public member `Matrix3 initialStress() const`");
    constexpr bool isFunctionOfF = providesCapability<M, DependsOnDeformationOnly>;
    static_assert(!isNamed || !isFunctionOfF,
                  "capability::InitialStress needs a model whose particles keep their stress");
    return true;
  }
};

/// The initial State depends on the particle. Intended for materials whose constants vary within a body.
struct StateByParticle {
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, StateByParticle>;
    constexpr bool fits = requires(const M& model) {
      { model.initialState(Birth{}) } -> std::same_as<typename M::State>;
    };
    static_assert(isNamed == fits,
                  "capability::StateByParticle and the public member `State initialState(const Birth&) const` require "
                  "each other");
    return true;
  }
};

}  // namespace tushar::mpm::solid::capability
