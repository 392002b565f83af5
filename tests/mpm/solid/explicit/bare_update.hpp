#pragma once

#include "components/mpm/solid/explicit/tasks/state_update.hpp"

namespace tushar::mpm::solid {

/// The views of a step that updates particles, initially empty: tests set those that they need.
inline StateUpdate<2> bareUpdate(const data::ParticleSet& set, const Level& level) {
  static thread_local Minimum stableTimeStep;
  const ParticleView<const Vec<2>> none{nullptr, set, level.cells()};
  return {.record = {nullptr, level.nodes()},
          .x = none,
          .size = {},
          .velocity = none,
          .mass = {nullptr, set, level.cells()},
          .oldDeformation = {nullptr, set, level.cells()},
          .temperature = {},
          .oldVolume = {},
          .oldStress = {},
          .oldState = {},
          .localized = {},
          .deformation = {nullptr, set, level.cells()},
          .volume = {},
          .stress = {},
          .state = {},
          .viscosity = {},
          .strainEnergy = {},
          .temperatureChange = {},
          .velocityGradient = {},
          .stableTimeStep = stableTimeStep,
          .stableTimeSteps = {},
          .newX = {}};
}

}  // namespace tushar::mpm::solid
