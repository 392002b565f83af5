#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// F at the end of a step: (I + L dt/n)^n F in n steps, more than one where |L| dt is large.
inline Matrix3 deformed(const Matrix3& f, const Matrix3& velocityGradient, double dt, int leastSubcycles) {
  const double increment = velocityGradient.norm() * dt;
  const int n = std::min(std::max(leastSubcycles, 2 * static_cast<int>(std::min(increment, 1e4))), 10000);
  const Matrix3 step = Matrix3::Identity() + velocityGradient * (dt / n);
  Matrix3 result = step * f;
  for (int k = 1; k < n; ++k) result = step * result;
  return result;
}

/// L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r where axisymmetric),   F_p = (I + L_p dt) F_p,   V_p = V_p J / J_old
template <class Shape, int D = Shape::dimension>
void computeParticleGradients(const Patch& patch, const Material&, const Method& method, ParticleView<const Vec<D>> x,
                              SizeView<Shape> size, ParticleView<const Matrix3> deformation,
                              ParticleView<const double> volume, NodeView<const Vec<D>> velocityStar, double dt,
                              ParticleView<Matrix3> velocityGradient, ParticleView<Matrix3> newDeformation,
                              ParticleView<double> newVolume) {
  const Level& level = patch.level();
  DeformationView<Shape> shapeDeformation = [&]() -> DeformationView<Shape> {
    if constexpr (Shape::deforms)
      return deformation;
    else
      return {};
  }();
  forEachStencil<Shape>(patch, patch.cells(), x, size, shapeDeformation, [&](int p, const auto& stencil) {
    Eigen::Matrix<double, D, D> l = Eigen::Matrix<double, D, D>::Zero();
    Matrix3 wide = Matrix3::Zero();
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& gradient, auto... hoop) {
      l += velocityStar[node] * gradient.transpose();
      ((wide(2, 2) += velocityStar[node][0] * hoop), ...);
    });
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) wide(level.axis(i), level.axis(j)) = l(i, j);
    velocityGradient[p] = wide;
    newDeformation[p] = deformed(deformation[p], wide, dt, method.minimumSubcyclesForF);
    newVolume[p] = volume[p] * (newDeformation[p].determinant() / deformation[p].determinant());
  });
}

}  // namespace tushar::mpm::solid
