#pragma once

#include <fmt/format.h>

#include <Eigen/LU>

#include "components/mpm/solid/explicit/tasks/interpolate_particles_to_grid.hpp"
#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/extent.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// In how many steps F is brought to the end of a time step: more than `least` where |L| dt is large.
inline int subcyclesForF(double squaredNorm, int least) {
  if (squaredNorm < 1) return least;
  return std::min(std::max(least, 2 * static_cast<int>(std::sqrt(std::min(squaredNorm, 1e8)))), 10000);
}

/// F at the end of a step: (I + L dt/n)^n F in n steps.
inline void deform(const Matrix3& f, const Matrix3& velocityGradient, double dt, int n, Matrix3& result) {
  Rows rows(f);
  const double part = dt / n;
  for (int k = 0; k < n; ++k) {
    const Rows before = rows;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) rows.row[i] = multiplyAdd(part * velocityGradient(i, j), before.row[j], rows.row[i]);
  }
  rows.copyTo(result);
}

/// What particles are at the start of a step and at its end. Null where a scene has none.
template <class Shape>
struct ParticleStates {
  static constexpr int D = Shape::dimension;

  Extents<Shape> extents;
  ParticleView<const Vec<D>> x, velocity;
  const double *mass = nullptr, *temperature = nullptr, *oldVolume = nullptr;
  const Matrix3 *oldDeformation = nullptr, *oldStress = nullptr;
  Vec<D>*newX = nullptr, *newVelocity = nullptr;
  double *volume = nullptr, *viscosity = nullptr, *strainEnergy = nullptr, *temperatureChange = nullptr;
  Matrix3 *deformation = nullptr, *stress = nullptr, *velocityGradient = nullptr;
  double* state = nullptr;
  const double* oldState = nullptr;
  int stateSize = 0;
  const int* localized = nullptr;
};

/// x_p += dt sum_i S_i v*_i,   v_p += sum_i S_i (v*_i - v_i): the FLIP of Brackbill & Ruppel, J. Comput. Phys. 65
/// (1986) 314.
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline void moveParticle(double dt, const Gathered<D>& sums, const ParticleStates<Shape>& s,
                                                int p) {
  const Vec<D> after = lanes<D>(sums.value, lane::velocity), before = lanes<D>(sums.value, lane::before);
  s.newX[p] = s.x[p] + dt * after;
  s.newVelocity[p] = s.velocity[p] + (after - before);
}

/// L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r where axisymmetric),   F_p = (I + L_p dt) F_p.
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline void deformParticle(const Level& level, const Method& method, double dt,
                                                  const Gathered<D>& sums, const Erosion& erosion,
                                                  const ParticleStates<Shape>& s, int p, Matrix3& velocityGradient) {
  if constexpr (D < 3) velocityGradient.setZero();
  if constexpr (Shape::axisymmetric) velocityGradient(2, 2) = sums.hoop[lane::velocity];
  Quad squares = sums.hoop * sums.hoop;
  for (const Quad& derivative : sums.gradient) squares = multiplyAdd(derivative, derivative, squares);
  double square = squares[0];
  for (int i = 1; i < D; ++i) square += squares[i];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      velocityGradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) =
          sums.gradient[static_cast<std::size_t>(j)][lane::velocity + i];
  deform(s.oldDeformation[p], velocityGradient, dt, subcyclesForF(square * dt * dt, method.minimumSubcyclesForF),
         s.deformation[p]);
  if (s.localized && s.localized[p]) erosion.restrain(s.oldDeformation[p], s.deformation[p], velocityGradient);
  if (s.volume) s.volume[p] = s.oldVolume[p] * (s.deformation[p].determinant() / s.oldDeformation[p].determinant());
  if (s.velocityGradient) s.velocityGradient[p] = velocityGradient;
}

/// The artificial viscosity's work on a volume per mass that grows by so much, m^3/kg.
template <class Shape>
void heatByViscosity(const Material& material, double growth, const ParticleStates<Shape>& s, int p) {
  const double heat = -s.viscosity[p] * growth;
  if (s.temperatureChange) s.temperatureChange[p] += heat / material.specificHeat;
  material.model->addViscousHeat(s.state + p * s.stateSize, heat);
}

/// Stress, artificial viscosity and strain energy of particles of a cell, where a scene keeps them; tells `rate` of
/// their waves.
template <class Shape, int D = Shape::dimension>
void updateStress(const Material& material, const Method& method, double dt, const ParticleStates<Shape>& s,
                  const Matrix3* velocityGradient, int first, int count, CrossingRate<D>& rate) {
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
  const ArtificialViscosity own =
      material.model->ownViscosity().value_or(method.viscosity.value_or(ArtificialViscosity{}));
  for (int k = 0; k < count; ++k) rate.add(waveSpeed[static_cast<std::size_t>(k)], s.velocity[first + k]);
  if (!s.viscosity && !s.strainEnergy) return;
  const bool heated = method.viscosityHeats && material.model->hasViscousHeat();
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const auto at = static_cast<std::size_t>(k);
    if (s.viscosity) {
      const double jump = std::max(-velocityGradient[k].trace(), 0.0) * method.meanWidth;
      const double density = material.density / s.deformation[p].determinant();
      s.viscosity[p] = density * jump * (own.linear * bulkSpeed[at] + own.quadratic * jump);
      if (heated) heatByViscosity(material, velocityGradient[k].trace() * dt / density, s, p);
    }
    const bool bears = !s.localized || !s.localized[p];
    if (s.strainEnergy) s.strainEnergy[p] = bears ? energyDensity[at] * s.mass[p] / material.density : 0.0;
  }
}

/// Of the particles of a cell the first that moves or is deformed so that waves in it have no speed.
template <class Shape, int D = Shape::dimension>
NumericalError withoutWaveSpeed(const Level& level, const ParticleStates<Shape>& s, const Index<D>& cell,
                                const data::ParticleRange& range) {
  const auto isSound = [&](int p) { return s.velocity[p].allFinite() && s.deformation[p].determinant() > 0; };
  int p = range.first;
  while (p + 1 < range.last && isSound(p)) ++p;
  const Vec3 x = level.expandPoint<D>(s.x[p]);
  return {fmt::format(
              "the wave speed of the particle at ({:g}, {:g}, {:g}) m is no number: det F is {:g}, its speed {:g} m/s",
              x[0], x[1], x[2], s.deformation[p].determinant(), s.velocity[p].norm()),
          "", "p.deformationMeasure", level.cellNumber<D>(cell)};
}

/// What updateParticles does.
enum class Update {
  motion,  ///< positions and velocities
  stress,  ///< deformation gradients, stresses, and how long a step each cell may take
  all
};

/// Brings the patch's own particles to the end of the step. Throws NumericalError where a wave has no speed.
template <class Shape, Update what = Update::all, int D = Shape::dimension>
void updateParticles(const Patch& patch, const Material& material, const Method& method, double dt,
                     NodeView<const NodeRecord> record, const ParticleStates<Shape>& s,
                     const std::optional<CellView<double>>& stableTimeStep) {
  const Level& level = patch.level();
  const CrossingRate<D> none(level);
  std::array<Matrix3, stressGroup> velocityGradient;
  if constexpr (what != Update::motion) stableTimeStep->fill(none.time());
  s.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    CrossingRate<D> rate = none;
    const CellFrame<D> frame(level, cell);
    for (int first = range.first; first < range.last; first += stressGroup) {
      const int count = std::min(stressGroup, range.last - first);
      for (int k = 0; k < count; ++k) {
        const int p = first + k;
        const typename Shape::Stencil stencil(frame, cell, s.x[p], s.extents[p]);
        const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(record, stencil));
        if constexpr (what != Update::stress) moveParticle<Shape>(dt, sums, s, p);
        if constexpr (what != Update::motion)
          deformParticle<Shape>(level, method, dt, sums, material.erosion, s, p,
                                velocityGradient[static_cast<std::size_t>(k)]);
      }
      if constexpr (what != Update::motion)
        updateStress<Shape>(material, method, dt, s, velocityGradient.data(), first, count, rate);
    }
    if constexpr (what != Update::motion) {
      if (!rate.isKnown()) throw withoutWaveSpeed<Shape>(level, s, cell, range);
      (*stableTimeStep)[cell] = rate.time();
    }
  });
}

}  // namespace tushar::mpm::solid
