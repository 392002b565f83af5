#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// v_p += dt sum_i S_i a_i,   x_p += dt sum_i S_i v*_i: the FLIP of Brackbill & Ruppel, J. Comput. Phys. 65 (1986) 314.
template <class Shape, int D = Shape::dimension>
void interpolateToParticlesAndUpdate(const Patch& patch, const Material&, const Method& method,
                                     ParticleView<const Vec<D>> x, SizeView<Shape> size,
                                     DeformationView<Shape> deformation, ParticleView<const Vec<D>> velocity,
                                     NodeView<const Vec<D>> acceleration, NodeView<const Vec<D>> velocityStar,
                                     double dt, ParticleView<Vec<D>> newX, ParticleView<Vec<D>> newVelocity) {
  const double fastest = method.maximumParticleVelocity;
  forEachStencil<Shape>(patch, patch.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    Vec<D> a = Vec<D>::Zero(), v = Vec<D>::Zero();
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&, auto...) {
      a += s * acceleration[node];
      v += s * velocityStar[node];
    });
    newX[p] = x[p] + dt * v;
    newVelocity[p] = velocity[p] + dt * a;
    const double speed = newVelocity[p].norm();
    if (speed > fastest && speed >= velocity[p].norm()) newVelocity[p] *= 0.9 * fastest / speed;
  });
}

/// The displacement since the start.
template <int D>
void addDisplacement(const Patch&, const Material&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> newX,
                     ParticleView<const Vec<D>> displacement, ParticleView<Vec<D>> newDisplacement) {
  for (int p = 0; p < x.owned(); ++p) newDisplacement[p] = displacement[p] + (newX[p] - x[p]);
}

}  // namespace tushar::mpm::solid
