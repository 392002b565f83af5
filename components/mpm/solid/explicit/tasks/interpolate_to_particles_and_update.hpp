#pragma once

#include "components/mpm/solid/explicit/tasks/update_particles.hpp"

namespace tushar::mpm::solid {

/// Views of the variables with which particles are moved to the end of a step.
template <int D>
struct ParticleUpdate {
  ParticleView<Vec<D>> newX, newVelocity;
  StateUpdate<D> state;

  static ParticleUpdate from(auto& take, int ghostNodes, const Keeps& keeps) {
    return {.newX = take(computes(p::x<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .state = StateUpdate<D>::from(take, ghostNodes, keeps, &g::record, false)};
  }
};

/// Updates x, v, F and the stress in one pass over the particles: Uintah's interpolateToParticlesAndUpdate,
/// computeParticleGradients and computeStressTensor.
template <class Shape, int D = Shape::dimension>
void interpolateToParticlesAndUpdate(const Patch& patch, const Material& material, const Method& method, double time,
                                     double dt, const ParticleUpdate<D>& u) {
  StateUpdate<D> state = u.state;
  if (method.removesLost) state.newX = u.newX;
  updateParticles<Shape>(patch, material, method, time, dt, Volumes::own, state,
                         [&](int p, int count, const auto& sums) {
                           prefetch(u.newX.values(), p + count, count);
                           prefetch(u.newVelocity.values(), p + count, count);
                           moveGroup<D>(dt, sums, count, u.state.x.values() + p, u.state.velocity.values() + p,
                                        u.newX.values() + p, u.newVelocity.values() + p);
                         });
}

}  // namespace tushar::mpm::solid
