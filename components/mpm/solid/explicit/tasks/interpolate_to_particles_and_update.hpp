#pragma once

#include "components/mpm/solid/explicit/tasks/update_particles.hpp"

namespace tushar::mpm::solid {

/// updateParticles as a task: Uintah's interpolateToParticlesAndUpdate, computeParticleGradients and
/// computeStressTensor in one pass over the particles.
template <class Shape, int D = Shape::dimension>
void interpolateToParticlesAndUpdate(const Patch& patch, const Material& material, const Method& method, int stateSize,
                                     double dt, NodeView<const NodeRecord> record, ParticleView<const Vec<D>> x,
                                     OptionalView<const Vec<D>> size, ParticleView<const Vec<D>> velocity,
                                     ParticleView<const double> mass, ParticleView<const Matrix3> oldDeformation,
                                     OptionalView<const double> temperature, OptionalView<const double> oldVolume,
                                     OptionalView<const Matrix3> oldStress, OptionalView<const double> oldState,
                                     OptionalView<const int> localized, ParticleView<Vec<D>> newX,
                                     ParticleView<Vec<D>> newVelocity, ParticleView<Matrix3> deformation,
                                     OptionalView<double> volume, OptionalView<Matrix3> stress,
                                     OptionalView<double> state, OptionalView<double> viscosity,
                                     OptionalView<double> strainEnergy, OptionalView<double> temperatureChange,
                                     OptionalView<Matrix3> velocityGradient, CellView<double> stableTimeStep) {
  const ParticleStates<Shape> states{
      Extents<Shape>(patch.level(), method.commonSize, size, oldDeformation),
      x,
      velocity,
      valuesOf(mass),
      valuesOf(temperature),
      valuesOf(oldVolume),
      valuesOf(oldDeformation),
      valuesOf(oldStress),
      valuesOf(newX),
      valuesOf(newVelocity),
      valuesOf(volume),
      valuesOf(viscosity),
      valuesOf(strainEnergy),
      valuesOf(temperatureChange),
      valuesOf(deformation),
      valuesOf(stress),
      valuesOf(velocityGradient),
      valuesOf(state),
      valuesOf(oldState),
      stateSize,
      valuesOf(localized),
  };
  updateParticles<Shape>(patch, material, method, dt, record, states, stableTimeStep);
}

}  // namespace tushar::mpm::solid
