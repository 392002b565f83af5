#pragma once

#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"
#include "components/mpm/solid/explicit/tasks/update_states.hpp"
#include "components/mpm/solid/transfer/gathered_lanes.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Computes x_p += dt sum_i S_i v*_i,   v_p += sum_i S_i (v*_i - v_i): the FLIP of Brackbill & Ruppel, J. Comput. Phys.
/// 65 (1986) 314.
template <int D>
[[gnu::always_inline]] inline void moveParticle(double dt, const Gathered<D>& sums, const Vec<D>& x,
                                                const Vec<D>& velocity, Vec<D>& newX, Vec<D>& newVelocity) {
  const Vec<D> after = lanes<D>(sums.value, lane::velocity), before = lanes<D>(sums.value, lane::before);
  newX = x + dt * after;
  newVelocity = velocity + (after - before);
}

template <int D>
[[gnu::always_inline]] inline void moveGroup(double dt, const Gathered<D>& sums, int, const Vec<D>* x,
                                             const Vec<D>* velocity, Vec<D>* newX, Vec<D>* newVelocity) {
  moveParticle<D>(dt, sums, *x, *velocity, *newX, *newVelocity);
}
/// Moves `count` consecutive particles, as moveParticle moves one.
template <int D>
[[gnu::always_inline]] inline void moveGroup(double dt, const GatheredLanes<D>& sums, int count, const Vec<D>* x,
                                             const Vec<D>* velocity, Vec<D>* newX, Vec<D>* newVelocity) {
  std::array<Lanes, D> at = vectorsOf<D>(x, count), v = vectorsOf<D>(velocity, count);
  for (std::size_t d = 0; d < D; ++d) {
    at[d] += dt * sums.after[d];
    v[d] += sums.after[d] - sums.before[d];
  }
  storeVectors<D>(at, count, newX);
  storeVectors<D>(v, count, newVelocity);
}

/// Stores L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r in axisymmetric scenes) of a particle.
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline void storeGradient(const Level& level, const Gathered<D>& sums,
                                                 Matrix3& velocityGradient) {
  if constexpr (D < 3) velocityGradient.setZero();
  if constexpr (Shape::axisymmetric) velocityGradient(2, 2) = sums.hoop[lane::velocity];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      velocityGradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) = sums.gradient[j][lane::velocity + i];
}
/// Stores L of `count` particles in three dimensions, one per lane, and computes their F. Returns whether the step
/// deforms one of them too much.
[[gnu::always_inline]] inline bool deformTogether(const Method& method, double dt, const GatheredLanes<3>& sums,
                                                  const StateUpdate<3>& u, int first, int count,
                                                  Matrix3* velocityGradient) {
  TensorOf<Lanes> gradient;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) gradient(i, j) = sums.gradient[j][i];
  storeLanes(gradient, velocityGradient, count);
  return deformGroup<3>(method, dt, u, first, count, gradient, velocityGradient);
}

/// Gathers the velocities of a cell's particles from the grid, passes them to `move`, and adds the particles to those
/// that have moved.
template <class Shape, class Move, int D = Shape::dimension>
[[gnu::always_inline]] inline void gatherAndMove(const Level& level, const Index<D>& cell,
                                                 const Extents<Shape>& extents, const Method& method, double dt,
                                                 const StateUpdate<D>& u, const data::ParticleRange& range,
                                                 MovedParticles<D>& moved, Move&& move) {
  Matrix3* const velocityGradient = moved.add(cell, range);
  const CellFrame<D> frame(level, cell);
  const int first = range.first, count = range.last - range.first;
  prefetch(u.x.values(), first + count, count);
  prefetch(u.velocity.values(), first + count, count);
  prefetch(u.oldDeformation.values(), first + count, count);
  prefetch(u.deformation.values(), first + count, count);
  if constexpr (updatesTogether<D>) {
    for (int k = 0; k < count; k += Lanes::count) {
      const int group = std::min(count - k, Lanes::count);
      const GatheredLanes<D> sums = gatherLanes(frame, cell, u.x.values(), extents, first + k, group, u.record);
      move(first + k, group, sums);
      moved.hasLost |= deformTogether(method, dt, sums, u, first + k, group, velocityGradient + k);
    }
  } else {
    forEachStencilOf(frame, cell, u.x.values(), extents, first, count, [&](int k, const auto& stencil) {
      const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.record, stencil));
      move(first + k, 1, sums);
      storeGradient<Shape>(level, sums, velocityGradient[k]);
    });
  }
}

/// Updates F, the stress and related quantities of the patch's own particles to the end of the step, and computes the
/// stable time step. Calls `move(p, count, sums)` for `count` particles from p on, with the values that they gather
/// from the grid: for one particle, or for several in lanes. Throws NumericalError if a wave speed is undefined. The
/// step starts at `time` [s].
template <class Shape, class Move, int D = Shape::dimension>
void updateParticles(const Patch& patch, const Material& material, const Method& method, double time, double dt,
                     Volumes volumes, const StateUpdate<D>& u, Move&& move) {
  const Level& level = patch.level();
  const Extents<Shape> extents(level, method.commonSize, u.size, u.oldDeformation);
  const CrossingRate<D> none(level);
  const BetweenPlanes<D> space(level, material.index);
  if (u.stableTimeSteps) u.stableTimeSteps->fill(none.time());
  if (u.x.owned() == 0) return;
  MovedParticles<D> moved{.volumes = volumes};
  u.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    if (!moved.cells.takes(range)) updateStates<D>(level, material, method, time, dt, u, none, space, moved);
    gatherAndMove(level, cell, extents, method, dt, u, range, moved, move);
  });
  updateStates<D>(level, material, method, time, dt, u, none, space, moved);
}

}  // namespace tushar::mpm::solid
