#pragma once

#include "components/mpm/solid/explicit/tasks/update_particles.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

// The two halves of interpolateToParticlesAndUpdate, for schedules that separate them: stresses first in the step, or
// last with velocities interpolated to the grid once more.

/// Views of the variables with which x and v are updated in a step.
template <int D>
struct MotionUpdate {
  NodeView<const NodeRecord> record;
  Placed<D> particles;
  ParticleView<const Vec<D>> velocity;
  ParticleView<Vec<D>> newX, newVelocity;

  /// `deformation` is the access to F.
  static MotionUpdate from(auto& take, int ghostNodes, KeptSizes keepsSizes, auto deformation) {
    return {.record = take(requiresNew(g::record, ghostNodes)),
            .particles = Placed<D>::from(take, keepsSizes, 0, deformation),
            .velocity = take(requiresOld(p::velocity<D>)),
            .newX = take(computes(p::x<D>)),
            .newVelocity = take(computes(p::velocity<D>))};
  }
};

/// Computes x_p and v_p at the end of the step.
template <class Shape, int D = Shape::dimension>
void moveParticles(const Patch& patch, const Material&, const Vec3& commonSize, double dt, const MotionUpdate<D>& u) {
  forEachStencil<Shape>(patch, patch.cells(), u.particles, commonSize, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.record, stencil));
    moveParticle<D>(dt, sums, u.particles.x[p], u.velocity[p], u.newX[p], u.newVelocity[p]);
  });
}

/// Moves no particles.
struct StayInPlace {
  void operator()(int, int, const auto&) const {}
};

/// Computes L_p, F_p and the stress, with the velocity in the records: Uintah's computeStressTensor.
template <class Shape, Volumes volumes = Volumes::own, int D = Shape::dimension>
void computeStressTensor(const Patch& patch, const Material& material, const Method& method, double time, double dt,
                         const StateUpdate<D>& u) {
  updateParticles<Shape>(patch, material, method, time, dt, volumes, u, StayInPlace());
}

}  // namespace tushar::mpm::solid
