#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

// Optional updates after FLIP, which remove noise from the particles' velocities. The records hold v* and v.

/// Computes v_p = (1 - a) v_p^FLIP + a sum_i S_i v*_i: the PIC of Harlow, Meth. Comput. Phys. 3 (1964) 319, if a = 1.
template <class Shape, int D = Shape::dimension>
void blendVelocity(const Patch& patch, const Material&, const Method& method, NodeView<const NodeRecord> record,
                   const Placed<D>& particles, ParticleView<Vec<D>> velocity) {
  const double a = method.picFraction;
  forEachStencil<Shape>(patch, patch.cells(), particles, method.commonSize, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
    velocity[p] = (1 - a) * velocity[p] + a * lanes<D>(sums.value, lane::velocity);
  });
}

/// Computes v+_p = sum_i S_i v_i, the velocity at the start of the step, filtered by the grid.
template <class Shape, int D = Shape::dimension>
void computeSSPlusVp(const Patch& patch, const Material&, const Vec3& commonSize, NodeView<const NodeRecord> record,
                     const Placed<D>& particles, ParticleView<Vec<D>> smooth) {
  forEachStencil<Shape>(patch, patch.cells(), particles, commonSize, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
    smooth[p] = lanes<D>(sums.value, lane::before);
  });
}

/// Slows particles that are faster than the maximum speed down to 9/10 of it, as in Uintah.
template <int D>
void limitVelocity(const Patch&, const Material&, double greatest, ParticleView<const Vec<D>> oldVelocity,
                   ParticleView<Vec<D>> velocity) {
  for (int p = 0; p < velocity.owned(); ++p) {
    const double speed = velocity[p].norm();
    if (speed > greatest && speed >= oldVelocity[p].norm()) velocity[p] *= 0.9 * greatest / speed;
  }
}

/// Views for the XPIC correction of particles that have been moved by FLIP.
template <int D>
struct XpicUpdate {
  NodeView<const NodeRecord> smoothRecord;
  Placed<D> particles;
  ParticleView<const Vec<D>> oldVelocity, smooth;
  ParticleView<Vec<D>> newX, velocity;

  /// `deformation` is the access to F.
  static XpicUpdate from(auto& take, int ghostNodes, KeptSizes keepsSizes, auto deformation) {
    return {.smoothRecord = take(requiresNew(g::smoothRecord, ghostNodes)),
            .particles = Placed<D>::from(take, keepsSizes, 0, deformation),
            .oldVelocity = take(requiresOld(p::velocity<D>)),
            .smooth = take(requiresNew(p::smoothVelocity<D>)),
            .newX = take(modifies(p::x<D>)),
            .velocity = take(modifies(p::velocity<D>))};
  }
};

/// v_p = 2 v+_p - v++_p + a dt,   x_p += (v* - (v_p + a dt - 2 v+_p + v++_p) / 2) dt with v++_p = sum_i S_i v+_i, where
/// v+_i is v+_p interpolated to the grid: XPIC of order 2, Hammerquist & Nairn, Comput. Methods Appl. Mech. Engng 318
/// (2017) 724. The particles have already moved by FLIP; as in Uintah, those of a rigid material are not corrected.
template <class Shape, int D = Shape::dimension>
void applyXpic(const Patch& patch, const Material& material, const Vec3& commonSize, double dt,
               const XpicUpdate<D>& u) {
  if (material.isRigid) return;
  forEachStencil<Shape>(patch, patch.cells(), u.particles, commonSize, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.smoothRecord, stencil));
    const Vec<D> smoother = lanes<D>(sums.value, lane::velocity), correction = smoother - 2 * u.smooth[p];
    u.newX[p] -= 0.5 * dt * (u.velocity[p] + correction);
    u.velocity[p] -= u.oldVelocity[p] + correction;
  });
}

}  // namespace tushar::mpm::solid
