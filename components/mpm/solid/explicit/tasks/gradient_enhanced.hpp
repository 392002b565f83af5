#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/mirror_images.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

/// Computes v_i += sum_p S_i m_p L_p (x_i - x_p) / m_i, with L_p of the previous step: a node receives the value, at
/// the node, of the particle's linear velocity field; Wallstedt & Guilkey, Comput. Model. Eng. Sci. 19 (2007) 223.
template <class Shape, int D = Shape::dimension>
void addVelocityGradient(const Patch& patch, const Material& material, const Vec3& commonSize,
                         const Placed<D>& particles, ParticleView<const double> mass,
                         ParticleView<const Matrix3> velocityGradient, NodeView<NodeRecord> record) {
  const Level& level = patch.level();
  const SymmetryPlanes<D> planes(level, material);
  const auto& x = particles.x;
  forEachStencil<Shape>(patch, x.cells(), particles, commonSize, [&](int p, const auto& stencil) {
    Eigen::Matrix<double, D, D> gradient;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) gradient(i, j) = velocityGradient[p](sceneAxis<D>(level, i), sceneAxis<D>(level, j));
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
      Vec<D> away;
      for (int d = 0; d < D; ++d) away[d] = level.nodePosition(d, node[d]) - x[p][d];
      addVelocityAndImage<D>(planes, record, node, gradient * away, s * mass[p]);
    });
  });
  setSymmetry<D>(patch, material.index, touchedRows<D>(x, Shape::ghostNodes), record);
}

}  // namespace tushar::mpm::solid
