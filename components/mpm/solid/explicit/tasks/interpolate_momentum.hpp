#pragma once

#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"

namespace tushar::mpm::solid {

/// m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i of any velocity of the particles, without forces.
template <class Shape, int D = Shape::dimension>
void interpolateMomentum(const Patch& patch, const Material& material, const Vec3& commonSize,
                         ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size, ParticleView<const double> mass,
                         OptionalView<const Matrix3> deformation, ParticleView<const Vec<D>> velocity,
                         NodeView<NodeRecord> record) {
  const Extents<Shape> extents(patch.level(), commonSize, size, deformation);
  const Sources<Shape> from{extents, x, velocity, valuesOf(mass), nullptr, nullptr, nullptr, nullptr, nullptr};
  scatterParticles<Shape>(patch, material, true, from, record);
}

}  // namespace tushar::mpm::solid
