#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

// What a state looks like on the grid, for those who save it: not part of a step.

/// V_p = m_p J / density, and sigma_p where the stress is a function of F alone.
inline void computeVolume(const Patch&, const Material& material, ParticleView<const double> mass,
                          ParticleView<const Matrix3> deformation, ParticleView<double> volume) {
  for (int p = 0; p < mass.owned(); ++p) volume[p] = mass[p] / material.density * deformation[p].determinant();
}
inline void computeStress(const Patch&, const Material& material, ParticleView<const Matrix3> deformation,
                          ParticleView<Matrix3> stress) {
  if (deformation.owned() == 0) return;
  material.model->kirchhoffStress(&deformation[0], deformation.owned(), &stress[0]);
  for (int p = 0; p < deformation.owned(); ++p) stress[p] /= deformation[p].determinant();
}

/// m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i, f_i = - sum_p V_p sigma_p grad S_i (and - V_p sigma_theta
/// S_i / r where axisymmetric) and f_i / m_i before any contact or boundary condition; V_i = sum_p S_i V_p,   sigma_i =
/// sum_p S_i V_p sigma_p / V_i. 0 where there is no mass.
template <class Shape, int D = Shape::dimension>
void showOnGrid(const Patch& patch, const Material&, const Vec3& commonSize, ParticleView<const Vec<D>> x,
                OptionalView<const Vec<D>> size, ParticleView<const Matrix3> deformation,
                ParticleView<const double> particleMass, ParticleView<const Vec<D>> particleVelocity,
                ParticleView<const double> particleVolume, ParticleView<const Matrix3> particleStress,
                NodeView<double> mass, NodeView<double> volume, NodeView<Vec<D>> velocity, NodeView<Vec<D>> force,
                NodeView<Vec<D>> acceleration, NodeView<Matrix3> stress) {
  mass.fill(0.0);
  volume.fill(0.0);
  velocity.fill(Vec<D>::Zero());
  force.fill(Vec<D>::Zero());
  stress.fill(Matrix3::Zero());
  const Box& box = mass.box();
  const Level& level = patch.level();
  const Extents<Shape> extents(level, commonSize, size, deformation);
  forEachStencil<Shape>(patch, x.cells(), x, extents, [&](int p, const auto& stencil) {
    const Matrix3 moment = particleVolume[p] * particleStress[p];
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      if (!box.contains(node)) return;
      mass[node] += s * particleMass[p];
      volume[node] += s * particleVolume[p];
      velocity[node] += s * particleMass[p] * particleVelocity[p];
      stress[node] += s * moment;
      for (int i = 0; i < D; ++i)
        for (int d = 0; d < D; ++d)
          force[node][i] -= moment(sceneAxis<D>(level, i), sceneAxis<D>(level, d)) * gradient[d];
      if constexpr (Shape::axisymmetric) force[node][0] -= moment(2, 2) * hoopOf(stencil, node);
    });
  });
  forEach<D>(box, [&](const Index<D>& node) {
    if (mass[node] > 0) velocity[node] /= mass[node];
    if (volume[node] > 0) stress[node] /= volume[node];
    acceleration[node] = mass[node] > 0 ? Vec<D>(force[node] / mass[node]) : Vec<D>(Vec<D>::Zero());
  });
}

/// `size`, `volume` and `stress` read those of particles, as far as shape functions reach.
template <class Shape, class Size, class Volume, class Stress>
void scheduleShowOnGrid(TaskList& tasks, const std::vector<Material>& materials, const Vec3& commonSize, Size size,
                        Volume volume, Stress stress) {
  constexpr int D = Shape::dimension;
  tasks.perMaterial("mpm::showOnGrid", showOnGrid<Shape>, materials, with(commonSize),
                    requiresOld(p::x<D>, Shape::reach), size, requiresOld(p::deformationMeasure, Shape::reach),
                    requiresOld(p::mass, Shape::reach), requiresOld(p::velocity<D>, Shape::reach), volume, stress,
                    computes(g::mass), computes(g::volume), computes(g::velocity<D>), computes(g::internalForce<D>),
                    computes(g::acceleration<D>), computes(g::stress));
}

}  // namespace tushar::mpm::solid
