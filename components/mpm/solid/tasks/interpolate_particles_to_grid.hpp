#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/tasks/boundary.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i: complete on all nodes of the patch. 0 where there is no mass.
template <class Shape, int D = Shape::dimension>
void interpolateParticlesToGrid(const Patch& patch, const Material& material, ParticleView<const Vec<D>> x,
                                SizeView<Shape> size, DeformationView<Shape> deformation,
                                ParticleView<const double> particleMass, ParticleView<const Vec<D>> particleVelocity,
                                NodeView<double> mass, NodeView<Vec<D>> velocity) {
  mass.fill(0.0);
  velocity.fill(Vec<D>::Zero());
  const Box& box = mass.box();
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    const double m = particleMass[p];
    const Vec<D> momentum = m * particleVelocity[p];
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&, auto...) {
      if (!box.contains(node)) return;
      mass[node] += s * m;
      velocity[node] += s * momentum;
    });
  });
  forEach<D>(box, [&](const Index<D>& node) {
    if (mass[node] > 0) velocity[node] /= mass[node];
  });
  setSymmetry<D>(patch, material.index, velocity);
}

/// V_i = sum_p S_i V_p,   sigma_i = sum_p S_i V_p sigma_p / V_i, for those who look at it. 0 where there is no volume.
template <class Shape, int D = Shape::dimension>
void interpolateStressToGrid(const Patch& patch, const Material&, ParticleView<const Vec<D>> x, SizeView<Shape> size,
                             DeformationView<Shape> deformation, ParticleView<const double> particleVolume,
                             ParticleView<const Matrix3> particleStress, NodeView<double> volume,
                             NodeView<Matrix3> stress) {
  volume.fill(0.0);
  stress.fill(Matrix3::Zero());
  const Box& box = volume.box();
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    const Matrix3 product = particleVolume[p] * particleStress[p];
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&, auto...) {
      if (!box.contains(node)) return;
      volume[node] += s * particleVolume[p];
      stress[node] += s * product;
    });
  });
  forEach<D>(box, [&](const Index<D>& node) {
    if (volume[node] > 0) stress[node] /= volume[node];
  });
}

}  // namespace tushar::mpm::solid
