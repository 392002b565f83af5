#pragma once

#include <array>
#include <type_traits>

#include "components/mpm/solid/constitutive/capabilities_at_start.hpp"
#include "components/mpm/solid/constitutive/capability_list.hpp"
#include "components/mpm/solid/constitutive/model_types.hpp"
#include "core/base/lanes.hpp"

/// Optional capabilities of constitutive models, beyond the members of every model. A model that names a capability
/// must have its member, with that signature; a model that has the member must name the capability. Otherwise
/// compilation fails.
namespace tushar::mpm::solid::capability {

template <class Variables>
inline constexpr bool isListOfVariables = false;
template <std::size_t N>
inline constexpr bool isListOfVariables<const std::array<StateVariable, N>*> = true;

// Properties without a member.

/// The stress at the end of a step depends only on F at the end, so that particles need not store their stress. Offer
/// it for elastic models in total form without a State.
struct DependsOnDeformationOnly {
  template <class M>
  static consteval bool check() {
    static_assert(!providesCapability<M, DependsOnDeformationOnly> || std::is_empty_v<typename M::State>,
                  "capability::DependsOnDeformationOnly needs an empty State");
    return true;
  }
};

/// No member function uses the temperature, which is 0 K unless another material of the scene needs it.
struct IgnoresTemperature {
  template <class M>
  static consteval bool check() {
    return true;
  }
};

/// F-bar in implicit time steps: updateStress uses only F, F_old and the State, and F -> s F changes only the mean of J
/// sigma. Every model that DependsOnDeformationOnly supports it without naming it.
struct FBar {
  template <class M>
  static consteval bool check() {
    return true;
  }
};

/// The model uses the position and mass of the particle, and the time, in explicit steps. Offer it if the state depends
/// on a front that moves through the body at a given speed.
struct PlaceAndTime {
  template <class M>
  static consteval bool check() {
    return true;
  }
};

// Stress and its tangent.

/// J sigma [Pa], the wave speed [m/s] and the strain energy [J/m^3] of several particles at once, with the same
/// arithmetic as for one: templates for a Real that is double or Lanes. Offer it if explicit steps spend most of their
/// time on the stress.
struct Vectorized {
  struct Name {
    int kirchhoffStress;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, Vectorized>;
    constexpr bool isAbsent = requires { &Both<M, Name>::kirchhoffStress; };
    static_assert(isNamed || isAbsent,
                  "the member `kirchhoffStress` is used only if the model lists capability::Vectorized");
    constexpr bool isFunctionOfF = providesCapability<M, DependsOnDeformationOnly>;
    static_assert(!isNamed || isFunctionOfF, "capability::Vectorized needs capability::DependsOnDeformationOnly");
    constexpr bool hasStress = requires { Member<M, TensorOf<Lanes>, const TensorOf<Lanes>&>{&M::kirchhoffStress}; };
    static_assert(
        !isNamed || hasStress,
        "capability::Vectorized needs the public member `template <class Real> TensorOf<Real> kirchhoffStress(const "
        "TensorOf<Real>& f) const`");
    constexpr bool hasSpeed = requires { Member<M, Lanes, double, const TensorOf<Lanes>&>{&M::waveSpeed}; };
    static_assert(
        !isNamed || hasSpeed,
        "capability::Vectorized needs the public member `template <class Real> Real waveSpeed(double initialDensity, "
        "const TensorOf<Real>& f) const`");
    constexpr bool hasEnergy = requires { Member<M, Lanes, const TensorOf<Lanes>&>{&M::strainEnergyDensity}; };
    static_assert(
        !isNamed || hasEnergy,
        "capability::Vectorized needs the public member `template <class Real> Real strainEnergyDensity(const "
        "TensorOf<Real>& f) const`");
    return true;
  }
};

/// Computes dP/dF [Pa] of P = J sigma F^-T at the end of a step in which L dt = F F_old^-1 - I. Row 3 i + J and column
/// 3 k + L contain dP_iJ/dF_kL. It must be the derivative of the stress that updateStress computes from the state at
/// the start of the step. Implicit steps need it.
struct NominalTangent {
  struct Name {
    int nominalTangent;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, NominalTangent>;
    constexpr bool isAbsent = requires { &Both<M, Name>::nominalTangent; };
    static_assert(isNamed || isAbsent,
                  "the member `nominalTangent` is used only if the model lists capability::NominalTangent");
    constexpr bool fits = requires {
      Member<M, Matrix9, const Deformation&, const Matrix3&, const typename M::State&>{&M::nominalTangent};
    };
    static_assert(
        !isNamed || fits,
        "capability::NominalTangent needs the public member `Matrix9 nominalTangent(const Deformation&, const Matrix3& "
        "oldStress, const State& old) const`");
    return true;
  }
};

// Wave speeds.

/// The bulk wave speed c_b = sqrt(K / rho) [m/s] for the artificial viscosity; without it, waveSpeed is used. Intended
/// for solids, in which the fastest wave is faster than the bulk wave because of the shear stiffness.
struct BulkSpeed {
  struct Name {
    int bulkSpeed;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, BulkSpeed>;
    constexpr bool isAbsent = requires { &Both<M, Name>::bulkSpeed; };
    static_assert(isNamed || isAbsent, "the member `bulkSpeed` is used only if the model lists capability::BulkSpeed");
    constexpr bool fits = requires {
      Member<M, double, double, const Deformation&, const Matrix3&, const typename M::State&>{&M::bulkSpeed};
    };
    static_assert(
        !isNamed || fits,
        "capability::BulkSpeed needs the public member `double bulkSpeed(double initialDensity, const Deformation&, "
        "const Matrix3& stress, const State&) const`");
    return true;
  }
};

/// Speed of the fastest wave for the first time step [m/s]; without it, waveSpeed at F = I is used. Offer it where
/// Uintah's first time step comes from another formula.
struct InitialWaveSpeed {
  struct Name {
    int initialWaveSpeed;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, InitialWaveSpeed>;
    constexpr bool isAbsent = requires { &Both<M, Name>::initialWaveSpeed; };
    static_assert(isNamed || isAbsent,
                  "the member `initialWaveSpeed` is used only if the model lists capability::InitialWaveSpeed");
    constexpr bool fits = requires { Member<M, double, double>{&M::initialWaveSpeed}; };
    static_assert(!isNamed || fits,
                  "capability::InitialWaveSpeed needs the public member `double initialWaveSpeed(double "
                  "initialDensity) const`");
    return true;
  }
};

/// Coefficients of the artificial viscosity that replace those of the scene.
struct OwnViscosity {
  struct Name {
    int ownViscosity;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, OwnViscosity>;
    constexpr bool isAbsent = requires { &Both<M, Name>::ownViscosity; };
    static_assert(isNamed || isAbsent,
                  "the member `ownViscosity` is used only if the model lists capability::OwnViscosity");
    constexpr bool fits = requires {
      { &M::ownViscosity } -> std::same_as<const ArtificialViscosity*>;
    };
    static_assert(
        !isNamed || fits,
        "capability::OwnViscosity needs the public member `static constexpr ArtificialViscosity ownViscosity`");
    return true;
  }
};

// Heat.

/// Constants of the material in addition to those of the model, set after the model has been read. Intended for models
/// that need the density, the specific heat or the melting temperature.
struct ConstantsOfMaterial {
  struct Name {
    int material;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, ConstantsOfMaterial>;
    constexpr bool isAbsent = requires { &Both<M, Name>::material; };
    static_assert(isNamed || isAbsent,
                  "the member `material` is filled only if the model lists capability::ConstantsOfMaterial");
    constexpr bool fits = requires {
      { &M::material } -> std::same_as<MaterialConstants M::*>;
    };
    static_assert(!isNamed || fits,
                  "capability::ConstantsOfMaterial needs the public member `MaterialConstants material`");
    return true;
  }
};

/// Change of the temperature due to the work in the step [K]; `stress` and `state` are those at its end. Offer it for
/// materials that plastic work or compression heats.
struct TemperatureChange {
  struct Name {
    int temperatureChange;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, TemperatureChange>;
    constexpr bool isAbsent = requires { &Both<M, Name>::temperatureChange; };
    static_assert(isNamed || isAbsent,
                  "the member `temperatureChange` is used only if the model lists capability::TemperatureChange");
    constexpr bool fits = requires {
      Member<M, double, const Deformation&, const Matrix3&, const typename M::State&>{&M::temperatureChange};
    };
    static_assert(
        !isNamed || fits,
        "capability::TemperatureChange needs the public member `double temperatureChange(const Deformation&, const "
        "Matrix3& stress, const State& state) const`");
    return true;
  }
};

/// Specific heat [J/(kg K)], if it differs from that of the material.
struct HeatCapacity {
  struct Name {
    int heatCapacity;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, HeatCapacity>;
    constexpr bool isAbsent = requires { &Both<M, Name>::heatCapacity; };
    static_assert(isNamed || isAbsent,
                  "the member `heatCapacity` is used only if the model lists capability::HeatCapacity");
    constexpr bool fits = requires { Member<M, double, const Matrix3&, double>{&M::heatCapacity}; };
    static_assert(!isNamed || fits,
                  "capability::HeatCapacity needs the public member `double heatCapacity(const Matrix3& "
                  "deformationGradient, double temperature) const`");
    return true;
  }
};

/// Adds the heat of the artificial viscosity [J/kg] to the State. Without it, the viscosity produces no heat, as in
/// Uintah.
struct ViscousHeat {
  struct Name {
    int addViscousHeat;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, ViscousHeat>;
    constexpr bool isAbsent = requires { &Both<M, Name>::addViscousHeat; };
    static_assert(isNamed || isAbsent,
                  "the member `addViscousHeat` is used only if the model lists capability::ViscousHeat");
    constexpr bool fits = requires { Member<M, void, typename M::State&, double>{&M::addViscousHeat}; };
    static_assert(!isNamed || fits,
                  "capability::ViscousHeat needs the public member `void addViscousHeat(State&, double heat) const`");
    return true;
  }
};

/// Whether a particle with given F, stress [Pa] and temperature [K] is molten: it then fails if the scene has an
/// <erosion>.
struct Melting {
  struct Name {
    int isMolten;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, Melting>;
    constexpr bool isAbsent = requires { &Both<M, Name>::isMolten; };
    static_assert(isNamed || isAbsent, "the member `isMolten` is used only if the model lists capability::Melting");
    constexpr bool fits = requires { Member<M, bool, const Matrix3&, const Matrix3&, double>{&M::isMolten}; };
    static_assert(
        !isNamed || fits,
        "capability::Melting needs the public member `bool isMolten(const Matrix3& deformationGradient, const Matrix3& "
        "stress, double temperature) const`");
    return true;
  }
};

/// Whether plastic flow in the step has become unstable; `stress` [Pa] and `state` are those at its end, before damage.
/// The particle then fails if the scene has an <erosion>. `checksStability`: whether the model checks its stability at
/// all.
struct Stability {
  struct Name {
    int isUnstable;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, Stability>;
    constexpr bool isAbsent = requires { &Both<M, Name>::isUnstable; };
    static_assert(isNamed || isAbsent, "the member `isUnstable` is used only if the model lists capability::Stability");
    constexpr bool fits = requires {
      Member<M, bool, const Deformation&, const Matrix3&, const typename M::State&>{&M::isUnstable};
      Member<M, bool>{&M::checksStability};
    };
    static_assert(!isNamed || fits,
                  "capability::Stability needs the public members `bool isUnstable(const Deformation&, const Matrix3& "
                  "stress, const State&) const` and `bool checksStability() const`");
    return true;
  }
};

// Internal variables.

/// Whether particles store a State, depending on the constants of the model; if not, initialState() is used. Offer it
/// where plasticity can be switched off.
struct OptionalState {
  struct Name {
    int keepsState;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, OptionalState>;
    constexpr bool isAbsent = requires { &Both<M, Name>::keepsState; };
    static_assert(isNamed || isAbsent,
                  "the member `keepsState` is used only if the model lists capability::OptionalState");
    constexpr bool fits = requires { Member<M, bool>{&M::keepsState}; };
    static_assert(!isNamed || fits, "capability::OptionalState needs the public member `bool keepsState() const`");
    return true;
  }
};

/// The number of leading doubles of the State that particles store, depending on the constants of the model; the others
/// are not set. Offer it where a rare choice of constants needs many more variables.
struct PartialState {
  struct Name {
    int keptNumbers;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, PartialState>;
    constexpr bool isAbsent = requires { &Both<M, Name>::keptNumbers; };
    static_assert(isNamed || isAbsent,
                  "the member `keptNumbers` is used only if the model lists capability::PartialState");
    constexpr bool fits = requires { Member<M, int>{&M::keptNumbers}; };
    static_assert(!isNamed || fits, "capability::PartialState needs the public member `int keptNumbers() const`");
    return true;
  }
};

/// Radius [m] within which explicit steps average the State's `p.plasticIncrement` over the particles of the material,
/// at the end of each step, into its `p.meanPlasticIncrement`; 0 for no average.
struct Nonlocal {
  struct Name {
    int nonlocalLength;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, Nonlocal>;
    constexpr bool isAbsent = requires { &Both<M, Name>::nonlocalLength; };
    static_assert(isNamed || isAbsent,
                  "the member `nonlocalLength` is used only if the model lists capability::Nonlocal");
    constexpr bool fits = requires { Member<M, double>{&M::nonlocalLength}; };
    static_assert(!isNamed || fits, "capability::Nonlocal needs the public member `double nonlocalLength() const`");
    return true;
  }
};

/// Variables of Uintah's model of the same name that are always 0 in this model; for scenes that save them.
struct AbsentVariables {
  struct Name {
    int absentVariables;
  };
  template <class M>
  static consteval bool check() {
    constexpr bool isNamed = providesCapability<M, AbsentVariables>;
    constexpr bool isAbsent = requires { &Both<M, Name>::absentVariables; };
    static_assert(isNamed || isAbsent,
                  "the member `absentVariables` is used only if the model lists capability::AbsentVariables");
    constexpr bool fits = requires { requires isListOfVariables<decltype(&M::absentVariables)>; };
    static_assert(!isNamed || fits,
                  "capability::AbsentVariables needs the public member `static constexpr std::array<StateVariable, N> "
                  "absentVariables`");
    return true;
  }
};

/// All capabilities that a constitutive model can name.
using OfModels =
    CapabilityList<DependsOnDeformationOnly, IgnoresTemperature, FBar, PlaceAndTime, Vectorized, NominalTangent,
                   BulkSpeed, InitialWaveSpeed, InitialVolumeRatio, InitialStress, OwnViscosity, ConstantsOfMaterial,
                   TemperatureChange, HeatCapacity, ViscousHeat, Melting, Stability, OptionalState, PartialState,
                   StateByParticle, Nonlocal, AbsentVariables>;

}  // namespace tushar::mpm::solid::capability
