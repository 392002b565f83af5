#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/kernels/node_record.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/tasks/extent.hpp"
#include "components/mpm/solid/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/tasks/stable_time_step.hpp"

namespace tushar::mpm::solid {

/// F at the end of a step: (I + L dt/n)^n F in n steps, more than one where |L| dt is large.
inline Matrix3 deformed(const Matrix3& f, const Matrix3& velocityGradient, double dt, int leastSubcycles) {
  const double square = velocityGradient.squaredNorm() * dt * dt;
  int n = leastSubcycles;
  if (square >= 1) n = std::min(std::max(n, 2 * static_cast<int>(std::sqrt(std::min(square, 1e8)))), 10000);
  const Matrix3 step = Matrix3::Identity() + velocityGradient * (dt / n);
  Matrix3 result = step * f;
  for (int k = 1; k < n; ++k) result = step * result;
  return result;
}

/// What particles are at the start of a step and at its end. Null where a scene has none.
template <class Shape>
struct ParticleStates {
  static constexpr int D = Shape::dimension;

  Extents<Shape> extents;
  ParticleView<const Vec<D>> x, velocity;
  const double *mass = nullptr, *temperature = nullptr, *oldVolume = nullptr;
  const Matrix3 *oldDeformation = nullptr, *oldStress = nullptr;
  Vec<D> *newX = nullptr, *newVelocity = nullptr;
  double *volume = nullptr, *viscosity = nullptr, *strainEnergy = nullptr, *temperatureChange = nullptr;
  Matrix3 *deformation = nullptr, *stress = nullptr, *velocityGradient = nullptr;
  double* state = nullptr;
  const double* oldState = nullptr;
  int stateSize = 0;
  const int* localized = nullptr;
};

/// x_p += dt sum_i S_i v*_i,   v_p += sum_i S_i (v*_i - v_i): the FLIP of Brackbill & Ruppel, J. Comput. Phys. 65 (1986)
/// 314.
template <class Shape, int D = Shape::dimension>
void moveParticle(const Method& method, double dt, const Gathered<D>& sums, const ParticleStates<Shape>& s, int p) {
  const Vec<D> after = lanes<D>(sums.value, lane::velocity), before = lanes<D>(sums.value, lane::before);
  s.newX[p] = s.x[p] + dt * after;
  s.newVelocity[p] = s.velocity[p] + (after - before);
  if (method.maximumParticleVelocity < 1e105) {
    const double speed = s.newVelocity[p].norm();
    if (speed > method.maximumParticleVelocity && speed >= s.velocity[p].norm())
      s.newVelocity[p] *= 0.9 * method.maximumParticleVelocity / speed;
  }
}

/// L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r where axisymmetric),   F_p = (I + L_p dt) F_p.
template <class Shape, int D = Shape::dimension>
void deformParticle(const Level& level, const Method& method, double dt, const Gathered<D>& sums,
                    const Erosion& erosion, const ParticleStates<Shape>& s, int p, Matrix3& velocityGradient) {
  velocityGradient.setZero();
  if constexpr (Shape::axisymmetric) velocityGradient(2, 2) = sums.hoop[lane::velocity];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      velocityGradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) =
          sums.gradient[static_cast<std::size_t>(j)][lane::velocity + i];
  s.deformation[p] = deformed(s.oldDeformation[p], velocityGradient, dt, method.minimumSubcyclesForF);
  if (s.localized && s.localized[p]) erosion.restrain(s.oldDeformation[p], s.deformation[p], velocityGradient);
  if (s.volume) s.volume[p] = s.oldVolume[p] * (s.deformation[p].determinant() / s.oldDeformation[p].determinant());
  if (s.velocityGradient) s.velocityGradient[p] = velocityGradient;
}

/// The artificial viscosity's work on a volume per mass that grows by so much, m^3/kg.
template <class Shape>
void heatByViscosity(const Material& material, double growth, const ParticleStates<Shape>& s, int p) {
  const double heat = -s.viscosity[p] * growth;
  if (s.temperatureChange && material.specificHeat > 0) s.temperatureChange[p] += heat / material.specificHeat;
  if (s.state) material.model->addHeat(s.state + p * s.stateSize, heat);
}

/// Stress, artificial viscosity and strain energy of particles of a cell, where a scene keeps them. Returns the time in
/// which the fastest wave of any of them crosses the cell, s.
template <class Shape, int D = Shape::dimension>
double updateStress(const Level& level, const Material& material, const Method& method, double dt,
                    const ParticleStates<Shape>& s, const Matrix3* velocityGradient, int first, int count) {
  std::array<double, stressGroup> waveSpeed, bulkSpeed, energyDensity;
  StressPoints points;
  points.count = count;
  points.timeStep = dt;
  points.oldDeformationGradient = s.oldDeformation + first;
  points.deformationGradient = s.deformation + first;
  points.velocityGradient = velocityGradient;
  points.temperature = s.temperature ? s.temperature + first : nullptr;
  points.oldStress = s.oldStress ? s.oldStress + first : nullptr;
  points.stress = s.stress ? s.stress + first : nullptr;
  points.stateStride = s.stateSize;
  if (s.state) {
    points.state = s.state + first * s.stateSize;
    std::copy_n(s.oldState + first * s.stateSize, count * s.stateSize, points.state);
  }
  points.waveSpeed = waveSpeed.data();
  points.bulkSpeed = s.viscosity ? bulkSpeed.data() : nullptr;
  points.temperatureChange = s.temperatureChange ? s.temperatureChange + first : nullptr;
  points.strainEnergyDensity = s.strainEnergy ? energyDensity.data() : nullptr;
  material.model->updateStress(material.density, points);
  const ArtificialViscosity own = material.model->ownViscosity().value_or(method.viscosity.value_or(ArtificialViscosity{}));
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const auto at = static_cast<std::size_t>(k);
    least = std::min(least, crossingTime<D>(level, waveSpeed[at], s.velocity[p]));
    if (s.viscosity) {
      const double jump = std::max(-velocityGradient[k].trace(), 0.0) * method.meanWidth;
      const double density = material.density / s.deformation[p].determinant();
      s.viscosity[p] = density * jump * (own.linear * bulkSpeed[at] + own.quadratic * jump);
      if (method.viscosityHeats) heatByViscosity(material, velocityGradient[k].trace() * dt / density, s, p);
    }
    const bool bears = !s.localized || !s.localized[p];
    if (s.strainEnergy) s.strainEnergy[p] = bears ? energyDensity[at] * s.mass[p] / material.density : 0.0;
  }
  return least;
}

/// What updateParticles does.
enum class Update {
  motion,  ///< positions and velocities
  stress,  ///< deformation gradients, stresses, and how long a step each cell may take
  all
};

/// Brings the patch's own particles to the end of the step.
template <class Shape, Update what = Update::all, int D = Shape::dimension>
void updateParticles(const Patch& patch, const Material& material, const Method& method, double dt,
                     NodeView<const Octet> record, const ParticleStates<Shape>& s,
                     const std::optional<CellView<double>>& stableTimeStep) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double least = std::numeric_limits<double>::infinity();
    const data::ParticleRange range = s.x.in(cell);
    const CellFrame<D> frame(level, cell);
    std::array<Matrix3, stressGroup> velocityGradient;
    for (int first = range.first; first < range.last; first += stressGroup) {
      const int count = std::min(stressGroup, range.last - first);
      for (int k = 0; k < count; ++k) {
        const int p = first + k;
        const typename Shape::Stencil stencil(frame, cell, s.x[p], s.extents[p]);
        const Gathered<D> sums = gather(stencil, windowOf<const Octet>(record, stencil));
        if constexpr (what != Update::stress) moveParticle<Shape>(method, dt, sums, s, p);
        if constexpr (what != Update::motion)
          deformParticle<Shape>(level, method, dt, sums, material.erosion, s, p,
                                velocityGradient[static_cast<std::size_t>(k)]);
      }
      if constexpr (what != Update::motion)
        least = std::min(least, updateStress<Shape>(level, material, method, dt, s, velocityGradient.data(), first, count));
    }
    if constexpr (what != Update::motion) (*stableTimeStep)[cell] = least;
  });
}

/// The displacement since the start.
template <int D>
void addDisplacement(const Patch&, const Material&, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> newX,
                     ParticleView<const Vec<D>> displacement, ParticleView<Vec<D>> newDisplacement) {
  for (int p = 0; p < x.owned(); ++p) newDisplacement[p] = displacement[p] + (newX[p] - x[p]);
}

}  // namespace tushar::mpm::solid
