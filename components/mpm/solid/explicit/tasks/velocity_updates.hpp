#pragma once

#include "components/mpm/solid/explicit/tasks/update_particles.hpp"

namespace tushar::mpm::solid {

// What may follow FLIP in a step, to take the noise out of the particles' velocities. The records hold v* and v.

/// v_p = (1 - a) v_p^FLIP + a sum_i S_i v*_i: the PIC of Harlow, Meth. Comput. Phys. 3 (1964) 319, where a = 1.
template <class Shape, int D = Shape::dimension>
void blendVelocity(const Patch& patch, const Material&, const Method& method, NodeView<const NodeRecord> record,
                   ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                   OptionalView<const Matrix3> deformation, ParticleView<Vec<D>> velocity) {
  const double a = method.picFraction;
  const Extents<Shape> extents(patch.level(), method.commonSize, size, deformation);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
    velocity[p] = (1 - a) * velocity[p] + a * lanes<D>(sums.value, lane::velocity);
  });
}

/// v+_p = sum_i S_i v_i, the velocity at the start of the step seen through the grid.
template <class Shape, int D = Shape::dimension>
void computeSSPlusVp(const Patch& patch, const Material&, const Method& method, NodeView<const NodeRecord> record,
                     ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                     OptionalView<const Matrix3> deformation, ParticleView<Vec<D>> smooth) {
  const Extents<Shape> extents(patch.level(), method.commonSize, size, deformation);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
    smooth[p] = lanes<D>(sums.value, lane::before);
  });
}

/// A particle that has become faster than the greatest speed is slowed down to 9/10 of it, as in Uintah.
template <int D>
void limitVelocity(const Patch&, const Material&, double greatest, ParticleView<const Vec<D>> oldVelocity,
                   ParticleView<Vec<D>> velocity) {
  for (int p = 0; p < velocity.owned(); ++p) {
    const double speed = velocity[p].norm();
    if (speed > greatest && speed >= oldVelocity[p].norm()) velocity[p] *= 0.9 * greatest / speed;
  }
}

/// v_p = 2 v+_p - v++_p + a dt,   x_p += (v* - (v_p + a dt - 2 v+_p + v++_p) / 2) dt with v++_p = sum_i S_i v+_i of the
/// grid that v+ went to: XPIC of order 2, Hammerquist & Nairn, Comput. Methods Appl. Mech. Engng 318 (2017) 724. The
/// particles have moved by FLIP before; as in Uintah those of a rigid material stay with it.
template <class Shape, int D = Shape::dimension>
void applyXpic(const Patch& patch, const Material& material, const Method& method, double dt,
               NodeView<const NodeRecord> smoothRecord, ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
               OptionalView<const Matrix3> deformation, ParticleView<const Vec<D>> oldVelocity,
               ParticleView<const Vec<D>> smooth, ParticleView<Vec<D>> newX, ParticleView<Vec<D>> velocity) {
  if (material.isRigid) return;
  const Extents<Shape> extents(patch.level(), method.commonSize, size, deformation);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(smoothRecord, stencil));
    const Vec<D> smoother = lanes<D>(sums.value, lane::velocity), correction = smoother - 2 * smooth[p];
    newX[p] -= 0.5 * dt * (velocity[p] + correction);
    velocity[p] -= oldVelocity[p] + correction;
  });
}

}  // namespace tushar::mpm::solid
