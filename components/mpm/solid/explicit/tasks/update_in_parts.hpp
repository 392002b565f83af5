#pragma once

#include "components/mpm/solid/explicit/tasks/share_volume.hpp"

namespace tushar::mpm::solid {

// The two halves of interpolateToParticlesAndUpdate, for schedules that do not keep them together: stresses first in
// the step, or last with velocities that went to the grid once more.

/// x_p and v_p at the end of the step.
template <class Shape, int D = Shape::dimension>
void moveParticles(const Patch& patch, const Material& material, const Method& method, double dt,
                   NodeView<const NodeRecord> record, ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                   ParticleView<const Vec<D>> velocity, OptionalView<const Matrix3> deformation,
                   ParticleView<Vec<D>> newX, ParticleView<Vec<D>> newVelocity) {
  ParticleStates<Shape> states{Extents<Shape>(patch.level(), method.commonSize, size, deformation), x, velocity};
  states.newX = valuesOf(newX);
  states.newVelocity = valuesOf(newVelocity);
  updateParticles<Shape, Update::motion>(patch, material, method, dt, record, states, {});
}

/// L_p, F_p and the stress with the velocity that the records hold: Uintah's computeStressTensor.
template <class Shape, Volumes volumes = Volumes::own, int D = Shape::dimension>
void computeStressTensor(const Patch& patch, const Material& material, const Method& method, int stateSize, double dt,
                         NodeView<const NodeRecord> record, ParticleView<const Vec<D>> x,
                         OptionalView<const Vec<D>> size, ParticleView<const Vec<D>> velocity,
                         ParticleView<const double> mass, ParticleView<const Matrix3> oldDeformation,
                         OptionalView<const double> temperature, OptionalView<const double> oldVolume,
                         OptionalView<const Matrix3> oldStress, OptionalView<const double> oldState,
                         OptionalView<const int> localized, ParticleView<Matrix3> deformation,
                         OptionalView<double> volume, OptionalView<Matrix3> stress, OptionalView<double> state,
                         OptionalView<double> viscosity, OptionalView<double> strainEnergy,
                         OptionalView<double> temperatureChange, OptionalView<Matrix3> velocityGradient,
                         CellView<double> stableTimeStep) {
  ParticleStates<Shape> states{Extents<Shape>(patch.level(), method.commonSize, size, oldDeformation), x, velocity};
  states.mass = valuesOf(mass);
  states.temperature = valuesOf(temperature);
  states.oldVolume = valuesOf(oldVolume);
  states.oldDeformation = valuesOf(oldDeformation);
  states.oldStress = valuesOf(oldStress);
  states.volume = valuesOf(volume);
  states.viscosity = valuesOf(viscosity);
  states.strainEnergy = valuesOf(strainEnergy);
  states.temperatureChange = valuesOf(temperatureChange);
  states.deformation = valuesOf(deformation);
  states.stress = valuesOf(stress);
  states.velocityGradient = valuesOf(velocityGradient);
  states.state = valuesOf(state);
  states.oldState = valuesOf(oldState);
  states.stateSize = stateSize;
  states.localized = valuesOf(localized);
  if constexpr (volumes == Volumes::own)
    updateParticles<Shape, Update::stress>(patch, material, method, dt, record, states, stableTimeStep);
  else
    updateCells<Shape>(patch, material, method, dt, record, states, stableTimeStep);
}

}  // namespace tushar::mpm::solid
