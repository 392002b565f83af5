#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/placed.hpp"

namespace tushar::mpm::solid {

// The state of the particles on the grid, as outputs that only some scenes save: no step reads it.

/// V_p = m_p J / density
inline void computeVolume(const Patch&, const Material& material, ParticleView<const double> mass,
                          ParticleView<const Matrix3> deformation, ParticleView<double> volume) {
  const double density = material.undeformedDensity();
  for (int p = 0; p < mass.owned(); ++p) volume[p] = mass[p] / density * deformation[p].determinant();
}
/// sigma_p, Pa, if the stress is a function of F alone.
inline void computeStress(const Patch&, const Material& material, ParticleView<const Matrix3> deformation,
                          ParticleView<Matrix3> stress) {
  if (deformation.owned() == 0) return;
  material.model->kirchhoffStress(&deformation[0], deformation.owned(), &stress[0]);
  for (int p = 0; p < deformation.owned(); ++p) stress[p] /= deformation[p].determinant();
}

/// Particles, and their state on the grid.
template <int D>
struct GridPicture {
  Placed<D> particles;
  ParticleView<const double> particleMass;
  ParticleView<const Vec<D>> particleVelocity;
  ParticleView<const double> particleVolume;
  ParticleView<const Matrix3> particleStress;
  NodeView<double> mass, volume;
  NodeView<Vec<D>> velocity, force, acceleration;
  NodeView<Matrix3> stress;

  /// `volume` and `stress` read those of particles, with the ghost cells that shape functions reach.
  static GridPicture from(auto& take, int reach, KeptSizes keepsSizes, auto volume, auto stress) {
    return {.particles = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .particleMass = take(requiresOld(p::mass, reach)),
            .particleVelocity = take(requiresOld(p::velocity<D>, reach)),
            .particleVolume = take(volume),
            .particleStress = take(stress),
            .mass = take(computes(g::mass)),
            .volume = take(computes(g::volume)),
            .velocity = take(computes(g::velocity<D>)),
            .force = take(computes(g::internalForce<D>)),
            .acceleration = take(computes(g::acceleration<D>)),
            .stress = take(computes(g::stress))};
  }
};

/// m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i, f_i = - sum_p V_p sigma_p grad S_i (and - V_p sigma_theta
/// S_i / r where axisymmetric) and f_i / m_i before any contact or boundary condition; V_i = sum_p S_i V_p,   sigma_i =
/// sum_p S_i V_p sigma_p / V_i. 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void showOnGrid(const Patch& patch, const Material&, const Vec3& commonSize, const GridPicture<D>& picture) {
  picture.mass.fill(0.0);
  picture.volume.fill(0.0);
  picture.velocity.fill(Vec<D>::Zero());
  picture.force.fill(Vec<D>::Zero());
  picture.stress.fill(Matrix3::Zero());
  const Box& box = picture.mass.box();
  const Level& level = patch.level();
  forEachStencil<Shape>(
      patch, picture.particles.x.cells(), picture.particles, commonSize, [&](int p, const auto& stencil) {
        const Matrix3 moment = picture.particleVolume[p] * picture.particleStress[p];
        stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
          if (!box.contains(node)) return;
          picture.mass[node] += s * picture.particleMass[p];
          picture.volume[node] += s * picture.particleVolume[p];
          picture.velocity[node] += s * picture.particleMass[p] * picture.particleVelocity[p];
          picture.stress[node] += s * moment;
          for (int i = 0; i < D; ++i)
            for (int d = 0; d < D; ++d)
              picture.force[node][i] -= moment(sceneAxis<D>(level, i), sceneAxis<D>(level, d)) * gradient[d];
          if constexpr (Shape::axisymmetric) picture.force[node][0] -= moment(2, 2) * hoopOf(stencil, node);
        });
      });
  forEach<D>(box, [&](const Index<D>& node) {
    if (picture.mass[node] > 0) picture.velocity[node] /= picture.mass[node];
    if (picture.volume[node] > 0) picture.stress[node] /= picture.volume[node];
    picture.acceleration[node] =
        picture.mass[node] > 0 ? Vec<D>(picture.force[node] / picture.mass[node]) : Vec<D>(Vec<D>::Zero());
  });
}

}  // namespace tushar::mpm::solid
