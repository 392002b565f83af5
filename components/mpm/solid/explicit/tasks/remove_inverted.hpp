#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/state_update.hpp"
#include "core/data/vanished.hpp"

namespace tushar::mpm::solid {

/// The error for the first particle of a cell without a wave speed: its velocity is not a number, or it is inverted.
template <int D>
NumericalError withoutWaveSpeed(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                                const data::ParticleRange& range) {
  const auto isSound = [&](int p) { return u.velocity[p].allFinite() && u.deformation[p].determinant() > 0; };
  int p = range.first;
  while (p + 1 < range.last && isSound(p)) ++p;
  const Vec3 x = level.expandPoint<D>(u.x[p]);
  return {fmt::format("the wave speed of the particle at ({:g}, {:g}, {:g}) m is not a number: det F is {:g}, the "
                      "particle's speed {:g} m/s",
                      x[0], x[1], x[2], u.deformation[p].determinant(), u.velocity[p].norm()),
          "", "p.deformationMeasure", level.cellNumber<D>(cell)};
}

/// Removes a particle, and gives it the state at the start of the step, which later tasks of the step can read.
template <int D>
void removeParticle(const StateUpdate<D>& u, int p) {
  (*u.newX)[p][0] = data::removed;
  u.deformation[p] = u.oldDeformation[p];
  if (u.volume) (*u.volume)[p] = (*u.oldVolume)[p];
  if (u.stress) (*u.stress)[p] = (*u.oldStress)[p];
  if (u.state) std::copy_n(valuesOf(u.oldState) + p * u.stateSize, u.stateSize, valuesOf(u.state) + p * u.stateSize);
  if (u.viscosity) (*u.viscosity)[p] = 0;
  if (u.strainEnergy) (*u.strainEnergy)[p] = 0;
  if (u.temperatureChange) (*u.temperatureChange)[p] = 0;
  if (u.velocityGradient) (*u.velocityGradient)[p].setZero();
}

/// Removes the particles of a cell that the step turns inside out, det F <= 0, as finite elements with negative
/// Jacobians are deleted in explicit codes. Returns the waves of the others; `none` has none. Throws NumericalError
/// if particles cannot be removed, or a wave of the others has no speed.
template <int D>
CrossingRate<D> withoutInverted(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                                const data::ParticleRange& range, const CrossingRate<D>& none,
                                const double* waveSpeed) {
  NumericalError error = withoutWaveSpeed<D>(level, u, cell, range);
  CrossingRate<D> rate = none;
  for (int k = 0; k < range.size(); ++k) {
    const int p = range.first + k;
    if (u.deformation[p].determinant() > 0)
      rate.add(waveSpeed[k], u.velocity[p]);
    else if (u.newX)
      removeParticle<D>(u, p);
    else
      throw error;
  }
  if (!rate.isKnown()) throw error;
  return rate;
}

}  // namespace tushar::mpm::solid
