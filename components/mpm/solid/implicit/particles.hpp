#pragma once

#include "components/mpm/solid/implicit/shapes.hpp"

// The particles that the solves of an implicit step read.

namespace tushar::mpm::solid::implicit {

/// Accesses of a task to all materials on all patches of a rank, as groups[patch][material].
template <class Group>
using OfRank = std::vector<std::vector<Group>>;

/// Every particle stores its size in p.size.
inline constexpr bool keepsSizes = true;

/// Accesses for the solve of a step, which reads the state at the start of the step.
struct InStep {
  static constexpr bool hasAcceleration = true;
  static auto read(const auto& label) { return requiresOld(label); }
};
/// Accesses for the solve that starts a run. It reads the state that earlier tasks of the same phase compute; there are
/// no accelerations yet.
struct AtStart {
  static constexpr bool hasAcceleration = false;
  static auto read(const auto& label) { return requiresNew(label); }
};

/// Views of particles of solids and rigid bodies before a step.
template <int D>
struct SolidParticles {
  Placed<D> placed;
  ParticleView<const double> mass;
  ParticleView<const Vec<D>> velocity;
  OptionalView<const Vec<D>> acceleration;  ///< acceleration; none at the start of a run
  ParticleView<const Vec<D>> externalForce;
  ParticleView<const double> temperature;
  ParticleView<const Matrix3> deformation, stress;
  ParticleView<const double> state;  ///< internal variables of the constitutive model

  /// `When` is either InStep or AtStart.
  template <class When>
  static SolidParticles from(auto& take, When, const ParticleLabel<double>* state) {
    return {
        .placed = {.x = take(When::read(p::x<D>)), .size = take(When::read(p::size<D>)), .deformation = std::nullopt},
        .mass = take(When::read(p::mass)),
        .velocity = take(When::read(p::velocity<D>)),
        .acceleration = take(when(When::hasAcceleration, requiresOld(p::acceleration<D>))),
        .externalForce = take(requiresNew(p::externalForce<D>)),
        .temperature = take(When::read(p::temperature)),
        .deformation = take(When::read(p::deformationMeasure)),
        .stress = take(When::read(p::stress)),
        .state = take(When::read(*state))};
  }
};

/// Views of particles that conduct heat.
template <int D>
struct HeatedParticles {
  Placed<D> placed;
  ParticleView<const double> mass, temperature;
  ParticleView<const Matrix3> deformation;
  OptionalView<const double> heatFlux = {};  ///< heat flow from loads [W]

  static HeatedParticles from(auto& take, bool areLoaded) {
    return {.placed = Placed<D>::from(take, keepsSizes, 0, when(false, requiresOld(p::deformationMeasure))),
            .mass = take(requiresOld(p::mass)),
            .temperature = take(requiresOld(p::temperature)),
            .deformation = take(requiresOld(p::deformationMeasure)),
            .heatFlux = take(when(areLoaded, requiresNew(p::heatFlux)))};
  }
};

}  // namespace tushar::mpm::solid::implicit
