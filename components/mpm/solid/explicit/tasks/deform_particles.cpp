#include "components/mpm/solid/explicit/tasks/deform_particles.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace tushar::mpm::solid {

namespace {

/// Number of substeps for F in a time step: more than `least` where |L| dt is large.
int subcyclesForF(double squaredNorm, int least) {
  if (squaredNorm < 1) return least;
  return std::min(std::max(least, 2 * static_cast<int>(std::sqrt(std::min(squaredNorm, 1e8)))), 10000);
}

/// Computes F of a particle at the end of the step from its velocity gradient; `square` is the sum of the gradient's
/// squared components [1/s^2]. Returns whether the step deforms the particle too much.
bool deformBy(const Method& method, double dt, double square, const Matrix3& velocityGradient, const Matrix3& before,
              Matrix3& now) {
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

}  // namespace

void forgetDistortion(Matrix3& deformation) {
  constexpr double most = 1e9;
  const double square = deformation.squaredNorm(), ratio = deformation.determinant();
  if (ratio > 0 && square * std::sqrt(square) > most * ratio) deformation = std::cbrt(ratio) * Matrix3::Identity();
}

void deform(const Matrix3& f, const Matrix3& velocityGradient, double dt, int n, Matrix3& result) {
  Rows rows(f);
  const double part = dt / n;
  for (int k = 0; k < n; ++k) {
    const Rows before = rows;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rows.row[i] = multiplyAdd(part * velocityGradient(i, j), before.row[j], rows.row[i]);
  }
  rows.copyTo(result);
}

void deformBySeries(const Matrix3& f, const Matrix3& velocityGradient, double dt, int order, Matrix3& result) {
  Matrix3 sum = Matrix3::Identity();
  for (int k = order; k > 0; --k) sum = Matrix3::Identity() + dt / k * velocityGradient * sum;
  result = sum * f;
}

bool deformOneByOne(const Method& method, double dt, int count, const Lanes& squares, const Matrix3* velocityGradient,
                    const Matrix3* before, Matrix3* now) {
  bool lost = false;
  for (int k = 0; k < count; ++k) lost |= deformBy(method, dt, squares[k], velocityGradient[k], before[k], now[k]);
  return lost;
}

template <int D>
bool deformParticles(const Method& method, double dt, const StateUpdate<D>& u, int first, int count,
                     const Matrix3* velocityGradient) {
  bool lost = false;
  for (int k = 0; k < count; k += Lanes::count) {
    const int group = std::min(count - k, Lanes::count);
    lost |= deformGroup<D>(method, dt, u, first + k, group, lanesOf(velocityGradient + k, group), velocityGradient + k);
  }
  return lost;
}

template <int D>
void finishDeformation(const Material& material, const StateUpdate<D>& u, int first, int count,
                       Matrix3* velocityGradient) {
  if (!u.localized && !u.volume && !u.velocityGradient && !material.isStressFree) return;
  const bool keepsStress = u.stress && !material.model->dependsOnDeformationOnly();
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const Matrix3& before = u.oldDeformation[p];
    Matrix3& now = u.deformation[p];
    if (u.localized && (*u.localized)[p]) material.erosion.restrain(before, now, velocityGradient[k]);
    if (keepsStress) forgetDistortion(now);
    if (material.isStressFree && now.determinant() * *material.criticalDensity > material.density) now = before;
    if (u.volume) (*u.volume)[p] = (*u.oldVolume)[p] * (now.determinant() / before.determinant());
    if (u.velocityGradient) (*u.velocityGradient)[p] = velocityGradient[k];
  }
}

template bool deformParticles(const Method&, double, const StateUpdate<1>&, int, int, const Matrix3*);
template bool deformParticles(const Method&, double, const StateUpdate<2>&, int, int, const Matrix3*);
template void finishDeformation(const Material&, const StateUpdate<1>&, int, int, Matrix3*);
template void finishDeformation(const Material&, const StateUpdate<2>&, int, int, Matrix3*);
template void finishDeformation(const Material&, const StateUpdate<3>&, int, int, Matrix3*);

}  // namespace tushar::mpm::solid
