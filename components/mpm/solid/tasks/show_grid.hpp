#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "components/mpm/solid/labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/stencil_groups.hpp"
#include "components/mpm/solid/transfer/stress_source.hpp"

namespace tushar::mpm::solid {

// The state of the particles on the grid, as outputs that only some scenes save: no step reads it.

/// Computes V_p = m_p J / density.
inline void computeVolume(const Patch&, const Material& material, ParticleView<const double> mass,
                          ParticleView<const Matrix3> deformation, ParticleView<double> volume) {
  const double density = material.undeformedDensity();
  const int count = mass.owned();
  for (int p = 0; p < count; p += Lanes::count) {
    const Lanes of = valuesOf(mass, p, count - p) / density * determinant(lanesOf(&deformation[p], count - p));
    for (int k = p; k < std::min(p + Lanes::count, count); ++k) volume[k] = of[k - p];
  }
}
/// Computes sigma_p [Pa], if the stress is a function of F alone.
inline void computeStress(const Patch&, const Material& material, ParticleView<const Matrix3> deformation,
                          ParticleView<Matrix3> stress) {
  if (deformation.owned() == 0) return;
  cauchyStress(material, &deformation[0], deformation.owned(), &stress[0]);
}

/// Views of mass and velocity of particles and on the grid.
template <int D>
struct MotionPicture {
  Placed<D> particles;
  ParticleView<const double> particleMass;
  ParticleView<const Vec<D>> particleVelocity;
  NodeView<double> mass;
  NodeView<Vec<D>> velocity;

  static MotionPicture from(auto& take, int reach, KeptSizes keepsSizes) {
    return {.particles = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .particleMass = take(requiresOld(p::mass, reach)),
            .particleVelocity = take(requiresOld(p::velocity<D>, reach)),
            .mass = take(computes(g::mass)),
            .velocity = take(computes(g::velocity<D>))};
  }
};

/// Computes m_i = sum_p S_i m_p,   v_i = sum_p S_i m_p v_p / m_i; 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void showMotion(const Patch& patch, const Material&, const Vec3& commonSize, const MotionPicture<D>& picture) {
  picture.mass.fill(0.0);
  picture.velocity.fill(Vec<D>::Zero());
  const Box& box = picture.mass.box();
  forEachStencilGroup<Shape>(
      patch, picture.particles.x.cells(), picture.particles, commonSize,
      [&]<class Stencils>(int p, int count, const Stencils& stencils) {
        const Lanes mass = valuesOf(picture.particleMass, p, count);
        const std::array<Lanes, D> v = vectorsOf<D>(picture.particleVelocity.values() + p, count);
        NodeShares<Stencils> shares;
        stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) { shares[at] = s * mass; });
        addShares(stencils, count, picture.mass, shares);
        forEachNodeOfGroup(stencils, count, picture.velocity, [&](Vec<D>& velocity, std::size_t at, int lane) {
          for (int d = 0; d < D; ++d) velocity[d] += shares[at][lane] * v[static_cast<std::size_t>(d)][lane];
        });
      });
  forEach<D>(box, [&](const Index<D>& node) {
    if (picture.mass[node] > 0) picture.velocity[node] /= picture.mass[node];
  });
}

/// Views of particles whose volume and stress act on the grid; `volume` and `stress` read them, with the ghost cells
/// that shape functions reach.
template <int D>
struct StressedParticles {
  Placed<D> placed;
  ParticleView<const double> volume;
  ParticleView<const Matrix3> stress;
  OptionalView<const double> viscosity;  ///< viscous pressure [Pa], with artificial viscosity

  static StressedParticles from(auto& take, int reach, KeptSizes keepsSizes, auto volume, auto stress, bool isViscous) {
    return {.placed = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .volume = take(volume),
            .stress = take(stress),
            .viscosity = take(when(isViscous, requiresOld(p::viscosity, reach)))};
  }
};

/// V_p (sigma_p - q_p) [N m] of several particles.
template <int D>
struct ForceMoments {
  std::array<std::array<Lanes, D>, D> across;  ///< by kernel axes
  Lanes around;                                ///< the hoop stress

  ForceMoments(const Level& level, const TensorOf<Lanes>& stress, Lanes viscosity, Lanes volume)
      : around(volume * (stress(2, 2) - viscosity)) {
    for (int i = 0; i < D; ++i)
      for (int d = 0; d < D; ++d) across[i][d] = volume * stress(sceneAxis<D>(level, i), sceneAxis<D>(level, d));
    for (int d = 0; d < D; ++d) across[d][d] -= volume * viscosity;
  }
};

/// Computes V_i = sum_p S_i V_p,   f_i = - sum_p V_p (sigma_p - q_p) grad S_i (and - V_p (sigma_theta - q_p) S_i / r in
/// axisymmetric scenes), q_p the viscous pressure, before any contact or boundary condition; 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void showForce(const Patch& patch, const Material&, const Vec3& commonSize, const StressedParticles<D>& particles,
               NodeView<double> volume, NodeView<Vec<D>> force) {
  volume.fill(0.0);
  force.fill(Vec<D>::Zero());
  forEachStencilGroup<Shape>(
      patch, particles.placed.x.cells(), particles.placed, commonSize,
      [&]<class Stencils>(int p, int count, const Stencils& stencils) {
        const Lanes volumes = valuesOf(particles.volume, p, count);
        const Lanes viscosity = particles.viscosity ? valuesOf(*particles.viscosity, p, count) : Lanes(0.0);
        const ForceMoments<D> moments(patch.level(), lanesOf(particles.stress.values() + p, count), viscosity, volumes);
        NodeShares<Stencils> shares;
        std::array<NodeShares<Stencils>, D * D> forces;
        stencils.forEachNode([&](std::size_t at, Lanes s, const std::array<Lanes, D>& gradient) {
          shares[at] = s * volumes;
          for (std::size_t i = 0; i < D; ++i)
            for (std::size_t d = 0; d < D; ++d) forces[D * i + d][at] = moments.across[i][d] * gradient[d];
        });
        addShares(stencils, count, volume, shares);
        forEachNodeOfGroup(stencils, count, force, [&](Vec<D>& sum, std::size_t at, int lane) {
          for (int i = 0; i < D; ++i)
            for (int d = 0; d < D; ++d) sum[i] -= forces[D * i + d][at][lane];
          if constexpr (Shape::axisymmetric) sum[0] -= moments.around[lane] * stencils.hoop(at)[lane];
        });
      });
}

/// Computes sigma_i = sum_p S_i V_p sigma_p / V_i; 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void showStress(const Patch& patch, const Material&, const Vec3& commonSize, const StressedParticles<D>& particles,
                NodeView<const double> volume, NodeView<Matrix3> stress) {
  stress.fill(Matrix3::Zero());
  forEachStencil<Shape>(
      patch, particles.placed.x.cells(), particles.placed, commonSize, [&](int p, const auto& stencil) {
        const Matrix3 moment = particles.volume[p] * particles.stress[p];
        forEachNodeWithin(stencil, stress.box(),
                          [&](const Index<D>& node, double s, const Vec<D>&) { stress[node] += s * moment; });
      });
  forEach<D>(stress.box(), [&](const Index<D>& node) {
    if (volume[node] > 0) stress[node] /= volume[node];
  });
}

/// Computes f_i / m_i; 0 at nodes without mass.
template <int D>
void showAcceleration(const Patch&, const Material&, NodeView<const double> mass, NodeView<const Vec<D>> force,
                      NodeView<Vec<D>> acceleration) {
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    acceleration[node] = mass[node] > 0 ? Vec<D>(force[node] / mass[node]) : Vec<D>(Vec<D>::Zero());
  });
}

}  // namespace tushar::mpm::solid
