#pragma once

#include "components/mpm/solid/loads/inserted_particles.hpp"
#include "components/mpm/solid/material.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// Moves the particles that enter in the step, which have the color of an insertion, and sets their velocity (Uintah's
/// insertParticles). F and the stress do not change.
template <int D>
void insertParticles(const Patch& patch, const Material&, const std::vector<Insertion>& insertions, double time,
                     double dt, ParticleView<const double> color, ParticleView<Vec<D>> x,
                     ParticleView<Vec<D>> velocity) {
  for (const Insertion& insertion : insertions) {
    if (!insertion.isIn(time, dt)) continue;
    const Vec<D> shift = patch.level().reduce<D>(insertion.shift), given = patch.level().reduce<D>(insertion.velocity);
    for (int p = 0; p < x.owned(); ++p) {
      if (color[p] != insertion.color) continue;
      x[p] += shift;
      velocity[p] = given;
    }
  }
}

}  // namespace tushar::mpm::solid
