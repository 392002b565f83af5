#pragma once

#include <array>
#include <type_traits>

#include "components/mpm/solid/constitutive/capability_list.hpp"
#include "components/mpm/solid/constitutive/model_types.hpp"
#include "core/base/lanes.hpp"

/// What a constitutive model can do beyond the members of every model. A model that names a capability must have its
/// member, with that signature; a model that has the member must name the capability. Anything else does not compile.
namespace tushar::mpm::solid::capability {

template <class Variables>
inline constexpr bool isListOfVariables = false;
template <std::size_t N>
inline constexpr bool isListOfVariables<const std::array<StateVariable, N>*> = true;

// Properties without a member.

/// The stress at the end of a step is a function of F at the end alone, so that no particle keeps its stress. Offer it
/// for elastic models in total form without a State.
struct DependsOnDeformationOnly {
  template <class M>
  static consteval bool check() {
    static_assert(!offers<M, DependsOnDeformationOnly> || std::is_empty_v<typename M::State>,
                  "capability::DependsOnDeformationOnly needs an empty State");
    return true;
  }
};

/// No member function reads the temperature, which is 0 K for them unless another material of the scene needs it.
struct IgnoresTemperature {
  template <class M>
  static consteval bool check() {
    return true;
  }
};

/// F-bar in implicit time steps: updateStress reads F, F_old and the State, and F -> s F changes nothing but the mean
/// of J sigma. Every model that DependsOnDeformationOnly supports it without naming it.
struct FBar {
  template <class M>
  static consteval bool check() {
    return true;
  }
};

// Stress and its tangent.

/// J sigma, Pa, and the wave speed, m/s, of several particles at once, with the arithmetic of one: templates for a Real
/// that is double or Lanes. Offer it where explicit steps spend their time in the stress.
struct Vectorized {
  struct Name {
    int kirchhoffStress;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, Vectorized> || requires { &Both<M, Name>::kirchhoffStress; },
        "a member kirchhoffStress is used only by a model that names capability::Vectorized");
    static_assert(!offers<M, Vectorized> || offers<M, DependsOnDeformationOnly>,
                  "capability::Vectorized needs capability::DependsOnDeformationOnly");
    static_assert(
        !offers<M, Vectorized> || requires { Member<M, TensorOf<Lanes>, const TensorOf<Lanes>&>{&M::kirchhoffStress}; },
        "capability::Vectorized needs the public member `template <class Real> TensorOf<Real> kirchhoffStress(const "
        "TensorOf<Real>& f) const`");
    static_assert(
        !offers<M, Vectorized> || requires { Member<M, Lanes, double, const TensorOf<Lanes>&>{&M::waveSpeed}; },
        "capability::Vectorized needs the public member `template <class Real> Real waveSpeed(double initialDensity, "
        "const TensorOf<Real>& f) const`");
    return true;
  }
};

/// dP/dF, Pa, of P = J sigma F^-T at the end of a step in which L dt = F F_old^-1 - I; row 3 i + J, column 3 k + L.
/// It must be the derivative of updateStress. Implicit time steps need it.
struct NominalTangent {
  struct Name {
    int nominalTangent;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, NominalTangent> || requires { &Both<M, Name>::nominalTangent; },
        "a member nominalTangent is used only by a model that names capability::NominalTangent");
    static_assert(
        !offers<M, NominalTangent> ||
            requires {
              Member<M, Matrix9, const Deformation&, const Matrix3&, const typename M::State&>{&M::nominalTangent};
            },
        "capability::NominalTangent needs the public member `Matrix9 nominalTangent(const Deformation&, const Matrix3& "
        "oldStress, const State& old) const`");
    return true;
  }
};

// Wave speeds.

/// c_b = sqrt(K / rho), m/s, for the artificial viscosity; without it waveSpeed stands in. Offer it for solids, whose
/// shear stiffness makes the fastest wave faster than the bulk wave.
struct BulkSpeed {
  struct Name {
    int bulkSpeed;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, BulkSpeed> || requires { &Both<M, Name>::bulkSpeed; },
        "a member bulkSpeed is used only by a model that names capability::BulkSpeed");
    static_assert(
        !offers<M, BulkSpeed> ||
            requires {
              Member<M, double, double, const Deformation&, const Matrix3&, const typename M::State&>{&M::bulkSpeed};
            },
        "capability::BulkSpeed needs the public member `double bulkSpeed(double initialDensity, const Deformation&, "
        "const Matrix3& stress, const State&) const`");
    return true;
  }
};

/// Speed of the fastest wave for the first time step, m/s; without it waveSpeed at F = I stands in. Offer it where
/// Uintah's first time step comes from another formula.
struct InitialWaveSpeed {
  struct Name {
    int initialWaveSpeed;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, InitialWaveSpeed> || requires { &Both<M, Name>::initialWaveSpeed; },
        "a member initialWaveSpeed is used only by a model that names capability::InitialWaveSpeed");
    static_assert(
        !offers<M, InitialWaveSpeed> || requires { Member<M, double, double>{&M::initialWaveSpeed}; },
        "capability::InitialWaveSpeed needs the public member `double initialWaveSpeed(double "
        "initialDensity) const`");
    return true;
  }
};

/// Coefficients of the artificial viscosity in place of those of the scene.
struct OwnViscosity {
  struct Name {
    int ownViscosity;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, OwnViscosity> || requires { &Both<M, Name>::ownViscosity; },
        "a member ownViscosity is used only by a model that names capability::OwnViscosity");
    static_assert(
        !offers<M, OwnViscosity> ||
            requires {
              { &M::ownViscosity } -> std::same_as<const ArtificialViscosity*>;
            },
        "capability::OwnViscosity needs the public member `static constexpr ArtificialViscosity ownViscosity`");
    return true;
  }
};

// Heat.

/// Constants of the material beside those of the model, filled in after the model has been read. Offer it where the
/// model needs the density, the specific heat or the melting temperature.
struct ConstantsOfMaterial {
  struct Name {
    int material;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, ConstantsOfMaterial> || requires { &Both<M, Name>::material; },
        "a member material is filled only for a model that names capability::ConstantsOfMaterial");
    static_assert(
        !offers<M, ConstantsOfMaterial> ||
            requires {
              { &M::material } -> std::same_as<MaterialConstants M::*>;
            },
        "capability::ConstantsOfMaterial needs the public member `MaterialConstants material`");
    return true;
  }
};

/// Change of the temperature by the work of the step, K; `stress` and `state` are those at its end. Offer it for
/// materials that plastic work or compression heats.
struct TemperatureChange {
  struct Name {
    int temperatureChange;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, TemperatureChange> || requires { &Both<M, Name>::temperatureChange; },
        "a member temperatureChange is used only by a model that names capability::TemperatureChange");
    static_assert(
        !offers<M, TemperatureChange> ||
            requires {
              Member<M, double, const Deformation&, const Matrix3&, const typename M::State&>{&M::temperatureChange};
            },
        "capability::TemperatureChange needs the public member `double temperatureChange(const Deformation&, const "
        "Matrix3& stress, const State& state) const`");
    return true;
  }
};

/// Adds the heat of the artificial viscosity, J/kg, to the State. Without it the viscosity heats nothing, as in Uintah.
struct ViscousHeat {
  struct Name {
    int addViscousHeat;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, ViscousHeat> || requires { &Both<M, Name>::addViscousHeat; },
        "a member addViscousHeat is used only by a model that names capability::ViscousHeat");
    static_assert(
        !offers<M, ViscousHeat> || requires { Member<M, void, typename M::State&, double>{&M::addViscousHeat}; },
        "capability::ViscousHeat needs the public member `void addViscousHeat(State&, double heat) const`");
    return true;
  }
};

/// Whether a point with F, a stress (Pa) and a temperature (K) is molten: it fails then where the scene has an
/// <erosion>.
struct Melting {
  struct Name {
    int isMolten;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, Melting> || requires { &Both<M, Name>::isMolten; },
        "a member isMolten is used only by a model that names capability::Melting");
    static_assert(
        !offers<M, Melting> || requires { Member<M, bool, const Matrix3&, const Matrix3&, double>{&M::isMolten}; },
        "capability::Melting needs the public member `bool isMolten(const Matrix3& deformationGradient, const Matrix3& "
        "stress, double temperature) const`");
    return true;
  }
};

// Internal variables.

/// Whether the particles keep a State, which depends on the constants of the model; where not, initialState() stands
/// in. Offer it where plasticity can be switched off.
struct OptionalState {
  struct Name {
    int keepsState;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, OptionalState> || requires { &Both<M, Name>::keepsState; },
        "a member keepsState is used only by a model that names capability::OptionalState");
    static_assert(
        !offers<M, OptionalState> || requires { Member<M, bool>{&M::keepsState}; },
        "capability::OptionalState needs the public member `bool keepsState() const`");
    return true;
  }
};

/// Variables of Uintah's model of the same name that are always 0 here, for scenes that save them.
struct AbsentVariables {
  struct Name {
    int absentVariables;
  };
  template <class M>
  static consteval bool check() {
    static_assert(
        offers<M, AbsentVariables> || requires { &Both<M, Name>::absentVariables; },
        "a member absentVariables is used only by a model that names capability::AbsentVariables");
    static_assert(
        !offers<M, AbsentVariables> || requires { requires isListOfVariables<decltype(&M::absentVariables)>; },
        "capability::AbsentVariables needs the public member `static constexpr std::array<StateVariable, N> "
        "absentVariables`");
    return true;
  }
};

/// Every capability that a constitutive model can name.
using OfModels = CapabilityList<DependsOnDeformationOnly, IgnoresTemperature, FBar, Vectorized, NominalTangent,
                                BulkSpeed, InitialWaveSpeed, OwnViscosity, ConstantsOfMaterial, TemperatureChange,
                                ViscousHeat, Melting, OptionalState, AbsentVariables>;

}  // namespace tushar::mpm::solid::capability
