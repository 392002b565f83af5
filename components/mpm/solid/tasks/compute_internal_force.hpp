#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/tasks/boundary.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// The components of a tensor in x, y, z along the kernel axes.
template <int D>
Eigen::Matrix<double, D, D> reduced(const Level& level, const Matrix3& tensor) {
  Eigen::Matrix<double, D, D> part;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) part(i, j) = tensor(level.axis(i), level.axis(j));
  return part;
}

/// F_i = - sum_p V_p (sigma_p - q_p I) grad S_i; where axisymmetric, the hoop stress pulls inwards with S_i / r.
template <class Shape, bool Viscous, int D = Shape::dimension>
void computeInternalForce(const Patch& patch, const Material& material, ParticleView<const Vec<D>> x, SizeView<Shape> size,
                          DeformationView<Shape> deformation, ParticleView<const double> volume,
                          ParticleView<const Matrix3> stress, Optional<Viscous, ParticleView<const double>> viscosity,
                          NodeView<Vec<D>> force) {
  force.fill(Vec<D>::Zero());
  const Box& box = force.box();
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    Eigen::Matrix<double, D, D> push = reduced<D>(patch.level(), stress[p]);
    double q = 0;
    if constexpr (Viscous) q = viscosity[p];
    push.diagonal().array() -= q;
    push *= -volume[p];
    const double hoopPush = -volume[p] * (stress[p](2, 2) - q);
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& gradient, auto... hoop) {
      if (!box.contains(node)) return;
      force[node] += push * gradient;
      ((force[node][0] += hoopPush * hoop), ...);
    });
  });
  setSymmetry<D>(patch, material.index, force);
}

}  // namespace tushar::mpm::solid
