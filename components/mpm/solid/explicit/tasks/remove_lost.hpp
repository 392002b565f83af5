#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include <limits>

#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/state_update.hpp"
#include "core/data/vanished.hpp"

namespace tushar::mpm::solid {

/// The error for the first particle of a cell whose wave speed is undefined: its velocity is not a number, or it is
/// inverted.
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

/// Removes a particle, and gives it the state at the start of the step, so that later tasks of the step can read it.
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

/// The space between the symmetry planes at the sides of the grid [m]; infinite along axes without such planes.
template <int D>
struct BetweenPlanes {
  Vec<D> lower = Vec<D>::Constant(-std::numeric_limits<double>::infinity()), upper = -lower;

  BetweenPlanes(const Level& level, int material) {
    for (int d = 0; d < D; ++d) {
      if (level.isSymmetry(d, 0, material)) lower[d] = level.nodePosition(d, 0);
      if (level.isSymmetry(d, 1, material)) upper[d] = level.nodePosition(d, level.cells().upper[d]);
    }
  }
  /// Whether a position is inside. A position that is not a number counts as inside: the relocation reports it as a
  /// separate error.
  bool contains(const Vec<D>& x) const { return containAll(&x, 1); }
  /// Whether all of `count` positions are inside.
  bool containAll(const Vec<D>* x, int count) const {
    bool inside = true;
    for (int k = 0; k < count; ++k)
      for (int d = 0; d < D; ++d) inside &= !(x[k][d] < lower[d]) & !(x[k][d] > upper[d]);
    return inside;
  }
};

/// Removes the lost particles of a cell in which a wave speed is undefined or a particle is behind a symmetry plane:
/// those that the step turns inside out (det F <= 0), as explicit finite-element codes delete elements with a negative
/// Jacobian, and those that it throws through a symmetry plane. Returns the crossing rate of the other particles'
/// waves; `none` is the rate without waves. Throws NumericalError if particles cannot be removed, or if the wave speed
/// of one of the others is undefined.
template <int D>
CrossingRate<D> withoutLost(const Level& level, const StateUpdate<D>& u, const Index<D>& cell,
                            const data::ParticleRange& range, const CrossingRate<D>& none,
                            const BetweenPlanes<D>& space, const double* waveSpeed) {
  CrossingRate<D> rate = none;
  for (int k = 0; k < range.size(); ++k) {
    const int p = range.first + k;
    const bool isInverted = u.deformation[p].determinant() <= 0;
    if (!isInverted && (!u.newX || space.contains((*u.newX)[p])))
      rate.add(waveSpeed[k], u.velocity[p]);
    else if (u.newX)
      removeParticle<D>(u, p);
    else
      throw withoutWaveSpeed<D>(level, u, cell, range);
  }
  if (!rate.isKnown()) throw withoutWaveSpeed<D>(level, u, cell, range);
  return rate;
}

}  // namespace tushar::mpm::solid
