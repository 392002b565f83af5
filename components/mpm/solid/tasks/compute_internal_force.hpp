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

/// F_i = - sum_p V_p (sigma_p - q_p I) grad S_i
template <class Shape, int D = Shape::dimension>
void computeInternalForce(const Patch& patch, const Material&, ParticleView<const Vec<D>> x, SizeView<Shape> size,
                          DeformationView<Shape> deformation, ParticleView<const double> volume,
                          ParticleView<const Matrix3> stress, ParticleView<const double> viscosity,
                          NodeView<Vec<D>> force) {
  force.fill(Vec<D>::Zero());
  const Box& box = force.box();
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    Eigen::Matrix<double, D, D> push = reduced<D>(patch.level(), stress[p]);
    push.diagonal().array() -= viscosity[p];
    push *= -volume[p];
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& gradient) {
      if (box.contains(node)) force[node] += push * gradient;
    });
  });
  setSymmetry<D>(patch, force);
}

}  // namespace tushar::mpm::solid
