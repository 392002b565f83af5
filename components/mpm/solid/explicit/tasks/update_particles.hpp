#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/explicit/tasks/share_volume.hpp"
#include "components/mpm/solid/explicit/tasks/update_stresses.hpp"
#include "components/mpm/solid/transfer/gathered_lanes.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Number of substeps for F in a time step: more than `least` where |L| dt is large.
inline int subcyclesForF(double squaredNorm, int least) {
  if (squaredNorm < 1) return least;
  return std::min(std::max(least, 2 * static_cast<int>(std::sqrt(std::min(squaredNorm, 1e8)))), 10000);
}

/// Computes F at the end of a step: (I + L dt/n)^n F in n steps.
inline void deform(const Matrix3& f, const Matrix3& velocityGradient, double dt, int n, Matrix3& result) {
  Rows rows(f);
  const double part = dt / n;
  for (int k = 0; k < n; ++k) {
    const Rows before = rows;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rows.row[i] = multiplyAdd(part * velocityGradient(i, j), before.row[j], rows.row[i]);
  }
  rows.copyTo(result);
}

/// Computes (I + L dt) F of `count` consecutive particles, bitwise equal to the results for single particles.
[[gnu::always_inline]] inline void deform(const Matrix3* f, const TensorOf<Lanes>& velocityGradient, double dt,
                                          int count, Matrix3* result) {
  const TensorOf<Lanes> before = lanesOf(f, count);
  TensorOf<Lanes> now = before;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Lanes change = dt * velocityGradient(i, j);
      for (int k = 0; k < 3; ++k) now(i, k) = multiplyAdd(change, before(j, k), now(i, k));
    }
  storeLanes(now, result, count);
}

/// Computes F at the end of a step: (sum_k (L dt)^k / k!) F, up to the power `order`.
inline void deformBySeries(const Matrix3& f, const Matrix3& velocityGradient, double dt, int order, Matrix3& result) {
  Matrix3 sum = Matrix3::Identity();
  for (int k = order; k > 0; --k) sum = Matrix3::Identity() + dt / k * velocityGradient * sum;
  result = sum * f;
}

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

/// The largest norm |L| dt with which a step may deform a particle. As sum_i |dS_i/dx_j| <= 2/h for tent functions and
/// means of them, each component of L dt is at most 2 if no node moves farther than a cell, and their norm at most 6.
/// Larger ones violate the CFL condition, and exp(L dt) would overflow for a few hundred.
inline constexpr double mostDeformation = 6;
/// The smallest det F after a step with |L| dt above 1: long before det F underflows, and with it the particle's
/// volume.
inline constexpr double leastVolumeRatio = 1e-12;

/// Computes F of a particle at the end of the step from its velocity gradient; `square` is the sum of the gradient's
/// squared components [1/s^2]. Returns whether the step deforms the particle too much: it then counts as inverted, with
/// F = -I.
template <int D>
bool deformBy(const Method& method, double dt, double square, const StateUpdate<D>& u, int p,
              const Matrix3& velocityGradient) {
  const Matrix3& before = u.oldDeformation[p];
  Matrix3& now = u.deformation[p];
  if (method.limitsDeformation && square * dt * dt > mostDeformation * mostDeformation) {
    now = -Matrix3::Identity();
    return true;
  }
  if (method.minimumSubcyclesForF < 1)
    deformBySeries(before, velocityGradient, dt, -method.minimumSubcyclesForF, now);
  else
    deform(before, velocityGradient, dt, subcyclesForF(square * dt * dt, method.minimumSubcyclesForF), now);
  const bool vanishes = method.limitsDeformation && square * dt * dt > 1 && now.determinant() < leastVolumeRatio;
  if (vanishes) now = -Matrix3::Identity();
  return vanishes;
}
/// Completes the update of a particle with a new F: restrains failed particles, and computes its volume.
template <int D>
[[gnu::always_inline]] inline void finishDeformation(const Erosion& erosion, const StateUpdate<D>& u, int p,
                                                     Matrix3& velocityGradient) {
  const Matrix3& before = u.oldDeformation[p];
  Matrix3& now = u.deformation[p];
  if (u.localized && (*u.localized)[p]) erosion.restrain(before, now, velocityGradient);
  if (u.volume) (*u.volume)[p] = (*u.oldVolume)[p] * (now.determinant() / before.determinant());
  if (u.velocityGradient) (*u.velocityGradient)[p] = velocityGradient;
}

/// Computes L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r in axisymmetric scenes), F_p = (I + L_p dt)
/// F_p, in substeps or, if the scene requests it, by terms of the series of exp(L_p dt). Returns whether the step
/// deforms the particle too much.
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline bool deformParticle(const Level& level, const Method& method, double dt,
                                                  const Gathered<D>& sums, const Erosion& erosion,
                                                  const StateUpdate<D>& u, int p, Matrix3& velocityGradient) {
  if constexpr (D < 3) velocityGradient.setZero();
  if constexpr (Shape::axisymmetric) velocityGradient(2, 2) = sums.hoop[lane::velocity];
  Quad squares = sums.hoop * sums.hoop;
  for (const Quad& derivative : sums.gradient) squares = multiplyAdd(derivative, derivative, squares);
  double square = squares[0];
  for (int i = 1; i < D; ++i) square += squares[i];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      velocityGradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) = sums.gradient[j][lane::velocity + i];
  const bool lost = deformBy(method, dt, square, u, p, velocityGradient);
  finishDeformation(erosion, u, p, velocityGradient);
  return lost;
}

/// Deforms `count` particles in three dimensions, starting with `first`, one per lane, as deformParticle deforms one;
/// `velocityGradient` points to L of the first particle. Returns whether the step deforms one of them too much.
[[gnu::always_inline]] inline bool deformParticles(const Method& method, double dt, const GatheredLanes<3>& sums,
                                                   const Erosion& erosion, const StateUpdate<3>& u, int first,
                                                   int count, Matrix3* velocityGradient) {
  TensorOf<Lanes> gradient;
  std::array<Lanes, 3> squares;
  for (int i = 0; i < 3; ++i) {
    squares[i] = sums.gradient[0][i] * sums.gradient[0][i];
    for (int j = 0; j < 3; ++j) {
      gradient(i, j) = sums.gradient[j][i];
      if (j > 0) squares[i] = multiplyAdd(gradient(i, j), gradient(i, j), squares[i]);
    }
  }
  const Lanes square = squares[0] + squares[1] + squares[2];
  storeLanes(gradient, velocityGradient, count);
  bool lost = false;
  if (method.minimumSubcyclesForF == 1 && all(square * dt * dt < 1.0))
    deform(u.oldDeformation.values() + first, gradient, dt, count, u.deformation.values() + first);
  else
    for (int k = 0; k < count; ++k) lost |= deformBy(method, dt, square[k], u, first + k, velocityGradient[k]);
  for (int k = 0; k < count; ++k) finishDeformation(erosion, u, first + k, velocityGradient[k]);
  return lost;
}

/// Whether several particles are updated together: only in three dimensions do cells contain enough of them.
template <class Shape>
inline constexpr bool updatesTogether = Shape::dimension == 3;

/// Moves the particles of a cell to the end of the step, without updating their stress. Returns whether the step
/// deforms one of them too much.
template <class Shape, class Move, int D = Shape::dimension>
[[gnu::always_inline]] inline bool moveAndDeform(const Level& level, const Index<D>& cell,
                                                 const Extents<Shape>& extents, const Material& material,
                                                 const Method& method, double dt, const StateUpdate<D>& u,
                                                 const data::ParticleRange& range, Matrix3* velocityGradient,
                                                 Move&& move) {
  const CellFrame<D> frame(level, cell);
  const int first = range.first, count = range.last - range.first;
  prefetch(u.x.values(), first + count, count);
  prefetch(u.velocity.values(), first + count, count);
  prefetch(u.oldDeformation.values(), first + count, count);
  prefetch(u.deformation.values(), first + count, count);
  bool lost = false;
  if constexpr (updatesTogether<Shape>) {
    for (int k = 0; k < count; k += Lanes::count) {
      const int group = std::min(count - k, Lanes::count);
      const GatheredLanes<D> sums = gatherLanes(frame, cell, u.x.values(), extents, first + k, group, u.record);
      move(first + k, group, sums);
      lost |= deformParticles(method, dt, sums, material.erosion, u, first + k, group, velocityGradient + k);
    }
  } else {
    forEachStencilOf(frame, cell, u.x.values(), extents, first, count, [&](int k, const auto& stencil) {
      const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.record, stencil));
      move(first + k, 1, sums);
      lost |= deformParticle<Shape>(level, method, dt, sums, material.erosion, u, first + k, velocityGradient[k]);
    });
  }
  return lost;
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
  MovedParticles<D> moved;
  u.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    if (!moved.cells.takes(range)) updateStresses<D>(level, material, method, time, dt, u, none, space, moved);
    Matrix3* const velocityGradient = moved.add(cell, range);
    moved.hasLost |= moveAndDeform(level, cell, extents, material, method, dt, u, range, velocityGradient, move);
    if (volumes == Volumes::shared) shareVolume<D>(dt, range, u, velocityGradient);
  });
  updateStresses<D>(level, material, method, time, dt, u, none, space, moved);
}

}  // namespace tushar::mpm::solid
