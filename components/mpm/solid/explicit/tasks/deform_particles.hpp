#pragma once

#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "components/mpm/solid/explicit/tasks/state_update.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"

namespace tushar::mpm::solid {

/// The largest norm |L| dt with which a step may deform a particle. As sum_i |dS_i/dx_j| <= 2/h for tent functions and
/// means of them, each component of L dt is at most 2 if no node moves farther than a cell, and their norm at most 6.
/// Larger ones violate the CFL condition, and exp(L dt) would overflow for a few hundred.
inline constexpr double mostDeformation = 6;
/// The smallest det F after a step with |L| dt above 1: long before det F underflows, and with it the particle's
/// volume.
inline constexpr double leastVolumeRatio = 1e-12;

/// Computes F at the end of a step: (I + L dt/n)^n F in n steps.
void deform(const Matrix3& f, const Matrix3& velocityGradient, double dt, int n, Matrix3& result);
/// Computes F at the end of a step: (sum_k (L dt)^k / k!) F, up to the power `order`.
void deformBySeries(const Matrix3& f, const Matrix3& velocityGradient, double dt, int order, Matrix3& result);

/// Replaces an F that is distorted so much that det F is about to lose its digits (|F|^3 > 1e9 det F, with errors up to
/// 1e-6) by the F of the same change of volume without distortion. Intended for materials whose stress does not follow
/// from F alone: gases are sheared without limit.
void forgetDistortion(Matrix3& deformation);

/// The sums of the squared components of L [1/s^2], one particle in each lane.
inline Lanes squaredNorms(const TensorOf<Lanes>& velocityGradient) {
  std::array<Lanes, 3> squares;
  for (int i = 0; i < 3; ++i) {
    squares[i] = velocityGradient(i, 0) * velocityGradient(i, 0);
    for (int j = 1; j < 3; ++j) squares[i] = multiplyAdd(velocityGradient(i, j), velocityGradient(i, j), squares[i]);
  }
  return squares[0] + squares[1] + squares[2];
}

/// Computes (I + L dt) F of `count` consecutive particles, bitwise equal to the results for single particles.
[[gnu::always_inline]] inline void deformInLanes(const Matrix3* f, const TensorOf<Lanes>& velocityGradient, double dt,
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

/// Computes F of particles that the step may deform much, one after another; `squares` has the sums of the squared
/// components of L [1/s^2]. Returns whether the step deforms one of them too much.
bool deformOneByOne(const Method& method, double dt, int count, const Lanes& squares, const Matrix3* velocityGradient,
                    const Matrix3* before, Matrix3* now);

/// Computes F_p = (I + L_p dt) F_p of up to Lanes::count consecutive particles, starting with `first`, in substeps or,
/// if the scene requests it, by terms of the series of exp(L_p dt). L [1/s] is given in lanes, and at
/// `velocityGradient` for each particle. Returns whether the step deforms one of them too much: it then counts as
/// inverted, with F = -I.
template <int D>
[[gnu::always_inline]] inline bool deformGroup(const Method& method, double dt, const StateUpdate<D>& u, int first,
                                               int count, const TensorOf<Lanes>& gradient,
                                               const Matrix3* velocityGradient) {
  const Matrix3* const before = u.oldDeformation.values() + first;
  Matrix3* const now = u.deformation.values() + first;
  const Lanes squares = squaredNorms(gradient);
  if (method.minimumSubcyclesForF != 1 || !all(squares * dt * dt < 1.0))
    return deformOneByOne(method, dt, count, squares, velocityGradient, before, now);
  deformInLanes(before, gradient, dt, count, now);
  return false;
}

/// Computes F of `count` consecutive particles, starting with `first`, as deformGroup does of a few;
/// `velocityGradient` points to L of the first particle.
template <int D>
bool deformParticles(const Method& method, double dt, const StateUpdate<D>& u, int first, int count,
                     const Matrix3* velocityGradient);

/// Completes the update of `count` particles with new F: restrains failed ones, keeps the F of stress-free ones that
/// the step would bring below the critical density, and computes volumes, where they are stored.
template <int D>
void finishDeformation(const Material& material, const StateUpdate<D>& u, int first, int count,
                       Matrix3* velocityGradient);

}  // namespace tushar::mpm::solid
