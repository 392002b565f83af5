#pragma once

#include <Eigen/LU>

#include <vector>

#include "components/mpm/solid/explicit/tasks/remove_lost.hpp"
#include "components/mpm/solid/explicit/tasks/share_volume.hpp"
#include "components/mpm/solid/explicit/tasks/stable_time_step.hpp"
#include "components/mpm/solid/explicit/tasks/state_update.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/cell_run.hpp"
#include "components/mpm/solid/transfer/gathered_lanes.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Number of substeps for F in a time step: more than `least` where |L| dt is large.
inline int subcyclesForF(double squaredNorm, int least) {
  if (squaredNorm < 1) return least;
  return std::min(std::max(least, 2 * static_cast<int>(std::sqrt(std::min(squaredNorm, 1e8)))), 10000);
}

/// Computes F at the end of a step: (I + L dt/n)^n F in n steps.
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

/// Computes (I + L dt) F of `count` consecutive particles, with the same bits as for single particles.
[[gnu::always_inline]] inline void deform(const Matrix3* f, const TensorOf<Lanes>& velocityGradient, double dt,
                                          int count, Matrix3* result) {
  const TensorOf<Lanes> before = lanesOf(f, count);
  TensorOf<Lanes> now = before;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Lanes change = dt * velocityGradient(i, j);
      for (int k = 0; k < 3; ++k) now(i, k) = multiplyAdd(change, before(j, k), now(i, k));
    }
  storeLanes(now, result, count);
}

/// Computes F at the end of a step: (sum_k (L dt)^k / k!) F, up to the power `order`.
inline void deformBySeries(const Matrix3& f, const Matrix3& velocityGradient, double dt, int order, Matrix3& result) {
  Matrix3 sum = Matrix3::Identity();
  for (int k = order; k > 0; --k) sum = Matrix3::Identity() + dt / k * velocityGradient * sum;
  result = sum * f;
}

/// Computes x_p += dt sum_i S_i v*_i,   v_p += sum_i S_i (v*_i - v_i): the FLIP of Brackbill & Ruppel, J. Comput. Phys.
/// 65 (1986) 314.
template <int D>
[[gnu::always_inline]] inline void moveParticle(double dt, const Gathered<D>& sums, const Vec<D>& x,
                                                const Vec<D>& velocity, Vec<D>& newX, Vec<D>& newVelocity) {
  const Vec<D> after = lanes<D>(sums.value, lane::velocity), before = lanes<D>(sums.value, lane::before);
  newX = x + dt * after;
  newVelocity = velocity + (after - before);
}

template <int D>
[[gnu::always_inline]] inline void moveGroup(double dt, const Gathered<D>& sums, int, const Vec<D>* x,
                                             const Vec<D>* velocity, Vec<D>* newX, Vec<D>* newVelocity) {
  moveParticle<D>(dt, sums, *x, *velocity, *newX, *newVelocity);
}
/// Moves `count` consecutive particles, as moveParticle moves one.
template <int D>
[[gnu::always_inline]] inline void moveGroup(double dt, const GatheredLanes<D>& sums, int count, const Vec<D>* x,
                                             const Vec<D>* velocity, Vec<D>* newX, Vec<D>* newVelocity) {
  std::array<Lanes, D> at = vectorsOf<D>(x, count), v = vectorsOf<D>(velocity, count);
  for (std::size_t d = 0; d < D; ++d) {
    at[d] += dt * sums.after[d];
    v[d] += sums.after[d] - sums.before[d];
  }
  storeVectors<D>(at, count, newX);
  storeVectors<D>(v, count, newVelocity);
}

/// Computes F of a particle at the end of the step from its velocity gradient; `square` is the sum of the gradient's
/// squared components [1/s^2].
template <int D>
void deformBy(const Method& method, double dt, double square, const StateUpdate<D>& u, int p,
              const Matrix3& velocityGradient) {
  const Matrix3& before = u.oldDeformation[p];
  Matrix3& now = u.deformation[p];
  if (method.minimumSubcyclesForF < 1)
    deformBySeries(before, velocityGradient, dt, -method.minimumSubcyclesForF, now);
  else
    deform(before, velocityGradient, dt, subcyclesForF(square * dt * dt, method.minimumSubcyclesForF), now);
}
/// Completes the update of a particle with a new F: restrains failed particles, and computes its volume.
template <int D>
[[gnu::always_inline]] inline void finishDeformation(const Erosion& erosion, const StateUpdate<D>& u, int p,
                                                     Matrix3& velocityGradient) {
  const Matrix3& before = u.oldDeformation[p];
  Matrix3& now = u.deformation[p];
  if (u.localized && (*u.localized)[p]) erosion.restrain(before, now, velocityGradient);
  if (u.volume) (*u.volume)[p] = (*u.oldVolume)[p] * (now.determinant() / before.determinant());
  if (u.velocityGradient) (*u.velocityGradient)[p] = velocityGradient;
}

/// Computes L_p = sum_i v*_i grad S_i (and L_theta = sum_i v*_r S_i / r where axisymmetric), F_p = (I + L_p dt) F_p, in
/// substeps or, if the scene requests it, by terms of the series of exp(L_p dt).
template <class Shape, int D = Shape::dimension>
[[gnu::always_inline]] inline void deformParticle(const Level& level, const Method& method, double dt,
                                                  const Gathered<D>& sums, const Erosion& erosion,
                                                  const StateUpdate<D>& u, int p, Matrix3& velocityGradient) {
  if constexpr (D < 3) velocityGradient.setZero();
  if constexpr (Shape::axisymmetric) velocityGradient(2, 2) = sums.hoop[lane::velocity];
  Quad squares = sums.hoop * sums.hoop;
  for (const Quad& derivative : sums.gradient) squares = multiplyAdd(derivative, derivative, squares);
  double square = squares[0];
  for (int i = 1; i < D; ++i) square += squares[i];
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      velocityGradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) = sums.gradient[j][lane::velocity + i];
  deformBy(method, dt, square, u, p, velocityGradient);
  finishDeformation(erosion, u, p, velocityGradient);
}

/// Deforms `count` particles in three dimensions, starting with `first`, one per lane, as deformParticle deforms one;
/// `velocityGradient` points to L of the first particle.
[[gnu::always_inline]] inline void deformParticles(const Method& method, double dt, const GatheredLanes<3>& sums,
                                                   const Erosion& erosion, const StateUpdate<3>& u, int first,
                                                   int count, Matrix3* velocityGradient) {
  TensorOf<Lanes> gradient;
  std::array<Lanes, 3> squares;
  for (int i = 0; i < 3; ++i) {
    squares[i] = sums.gradient[0][i] * sums.gradient[0][i];
    for (int j = 0; j < 3; ++j) {
      gradient(i, j) = sums.gradient[j][i];
      if (j > 0) squares[i] = multiplyAdd(gradient(i, j), gradient(i, j), squares[i]);
    }
  }
  const Lanes square = squares[0] + squares[1] + squares[2];
  storeLanes(gradient, velocityGradient, count);
  if (method.minimumSubcyclesForF == 1 && all(square * dt * dt < 1.0))
    deform(u.oldDeformation.values() + first, gradient, dt, count, u.deformation.values() + first);
  else
    for (int k = 0; k < count; ++k) deformBy(method, dt, square[k], u, first + k, velocityGradient[k]);
  for (int k = 0; k < count; ++k) finishDeformation(erosion, u, first + k, velocityGradient[k]);
}

/// The results of a constitutive model for up to stressGroup particles, besides their stresses and wave speeds.
struct StressResults {
  std::array<double, stressGroup> bulkSpeed;      ///< bulk speed [m/s]
  std::array<double, stressGroup> energyDensity;  ///< strain energy density [J/m^3 of the initial volume]
};

/// Passes the positions and masses of the particles from `first` on, and the time, to a model that reads them.
template <int D>
void placePoints(const Level& level, const StateUpdate<D>& u, double time, int first,
                 std::array<Vec3, stressGroup>& positions, StressPoints& points) {
  for (int k = 0; k < points.count; ++k) positions[k] = level.expandPoint<D>(u.x[first + k]);
  points.position = positions.data();
  points.mass = u.mass.values() + first;
  points.time = time;
}

/// The particles starting with `first`, in the form for a constitutive model. `velocityGradient` points to L of the
/// first particle.
template <int D>
StressPoints stressPoints(const StateUpdate<D>& u, double dt, const Matrix3* velocityGradient, int first, int count,
                          double* waveSpeed, StressResults& results) {
  const auto of = [&](const auto& view) { return view ? valuesOf(view) + first : nullptr; };
  return {.count = count,
          .timeStep = dt,
          .oldDeformationGradient = u.oldDeformation.values() + first,
          .deformationGradient = u.deformation.values() + first,
          .velocityGradient = velocityGradient,
          .temperature = of(u.temperature),
          .oldStress = of(u.oldStress),
          .stress = of(u.stress),
          .state = u.state ? valuesOf(u.state) + first * u.stateSize : nullptr,
          .stateStride = u.stateSize,
          .waveSpeed = waveSpeed,
          .bulkSpeed = u.viscosity ? results.bulkSpeed.data() : nullptr,
          .temperatureChange = of(u.temperatureChange),
          .strainEnergyDensity = u.strainEnergy ? results.energyDensity.data() : nullptr};
}

/// Heats a particle by the work of the artificial viscosity while its volume per mass grows by `growth` [m^3/kg].
template <int D>
void heatByViscosity(const Material& material, double growth, const StateUpdate<D>& u, int p) {
  const double heat = -(*u.viscosity)[p] * growth;
  if (u.temperatureChange) {
    const double temperature = u.temperature ? (*u.temperature)[p] : 0.0;
    (*u.temperatureChange)[p] +=
        heat / material.model->heatCapacity(u.deformation[p], temperature, material.specificHeat);
  }
  material.model->addViscousHeat(valuesOf(u.state) + p * u.stateSize, heat);
}

/// Updates the artificial viscosity of particles starting with `first`, and its heat; the arrays of velocity gradients
/// and bulk wave speeds [m/s] start with the first particle.
template <int D>
void updateViscosity(const Material& material, const Method& method, double dt, const StateUpdate<D>& u,
                     const Matrix3* velocityGradient, const double* bulkSpeed, int first, int count) {
  const ArtificialViscosity own =
      material.model->ownViscosity().value_or(method.viscosity.value_or(ArtificialViscosity{}));
  const bool heated = method.viscosityHeats && material.model->hasViscousHeat();
  const double undeformed = material.undeformedDensity();
  double* const viscosity = valuesOf(u.viscosity);
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const double jump = std::max(-velocityGradient[k].trace(), 0.0) * method.meanWidth;
    const double density = undeformed / u.deformation[p].determinant();
    viscosity[p] = density * jump * (own.linear * bulkSpeed[k] + own.quadratic * jump);
    if (heated) heatByViscosity(material, velocityGradient[k].trace() * dt / density, u, p);
  }
}

/// Computes the strain energy of particles starting with `first` from its density [J/m^3 of the volume at F = I]; 0 for
/// failed particles.
template <int D>
void updateStrainEnergy(const Material& material, const StateUpdate<D>& u, const double* density, int first,
                        int count) {
  const double undeformed = material.undeformedDensity();
  double* const energy = valuesOf(u.strainEnergy);
  const int* const localized = valuesOf(u.localized);
  for (int k = 0; k < count; ++k) {
    const int p = first + k;
    const bool bears = !localized || !localized[p];
    energy[p] = bears ? density[k] * u.mass[p] / undeformed : 0.0;
  }
}

/// Updates stress, artificial viscosity and strain energy of up to stressGroup particles, if they are stored, and
/// computes the wave speeds [m/s].
template <int D>
void updateStress(const Level& level, const Material& material, const Method& method, double time, double dt,
                  const StateUpdate<D>& u, const Matrix3* velocityGradient, int first, int count, double* waveSpeed) {
  if (u.state)
    std::copy_n(valuesOf(u.oldState) + first * u.stateSize, count * u.stateSize,
                valuesOf(u.state) + first * u.stateSize);
  StressResults results;
  StressPoints points = stressPoints(u, dt, velocityGradient, first, count, waveSpeed, results);
  std::array<Vec3, stressGroup> positions;
  if (material.model->usesPlaceAndTime()) placePoints<D>(level, u, time, first, positions, points);
  material.model->updateStress(material.density, points);
  if (u.viscosity) updateViscosity(material, method, dt, u, velocityGradient, results.bulkSpeed.data(), first, count);
  if (u.strainEnergy) updateStrainEnergy(material, u, results.energyDensity.data(), first, count);
}

/// Whether several particles are updated together: only in three dimensions do cells contain enough of them.
template <class Shape>
inline constexpr bool updatesTogether = Shape::dimension == 3;

/// Moves `count` particles of a cell, starting with `first`, to the end of the step, without updating their stress.
template <class Shape, class Move, int D = Shape::dimension>
[[gnu::always_inline]] inline void moveAndDeform(const Level& level, const Index<D>& cell,
                                                 const Extents<Shape>& extents, const Material& material,
                                                 const Method& method, double dt, const StateUpdate<D>& u,
                                                 const data::ParticleRange& range, Matrix3* velocityGradient,
                                                 Move&& move) {
  const CellFrame<D> frame(level, cell);
  const int first = range.first, count = range.last - range.first;
  prefetch(u.x.values(), first + count, count);
  prefetch(u.velocity.values(), first + count, count);
  prefetch(u.oldDeformation.values(), first + count, count);
  prefetch(u.deformation.values(), first + count, count);
  if constexpr (updatesTogether<Shape>) {
    for (int k = 0; k < count; k += Lanes::count) {
      const int group = std::min(count - k, Lanes::count);
      const GatheredLanes<D> sums = gatherLanes(frame, cell, u.x.values(), extents, first + k, group, u.record);
      move(first + k, group, sums);
      deformParticles(method, dt, sums, material.erosion, u, first + k, group, velocityGradient + k);
    }
  } else {
    forEachStencilOf(frame, cell, u.x.values(), extents, first, count, [&](int k, const auto& stencil) {
      const Gathered<D> sums = gather(stencil, windowOf<const NodeRecord>(u.record, stencil));
      move(first + k, 1, sums);
      deformParticle<Shape>(level, method, dt, sums, material.erosion, u, first + k, velocityGradient[k]);
    });
  }
}

/// Particles that have moved to the end of the step, but whose stress has not been updated.
template <int D>
struct MovedParticles {
  CellRun<D> cells;
  std::vector<Matrix3> velocityGradient;  ///< room for at least the particles of the cells
  std::vector<double> waveSpeed;          ///< same size as velocityGradient

  /// Adds a cell; returns memory for L of its particles [1/s].
  Matrix3* add(const Index<D>& cell, const data::ParticleRange& range) {
    cells.add(cell, range);
    if (velocityGradient.size() < static_cast<std::size_t>(cells.count())) {
      velocityGradient.resize(std::max(cells.count(), stressGroup));
      waveSpeed.resize(velocityGradient.size());
    }
    return velocityGradient.data() + (range.first - cells.first());
  }
};

/// Updates the stress of particles that have moved, and the stable time step of their cells. Removes particles that the
/// step turns inside out or throws out of `space`, or throws NumericalError. Empties `moved`.
template <int D>
void updateStresses(const Level& level, const Material& material, const Method& method, double time, double dt,
                    const StateUpdate<D>& u, const CrossingRate<D>& none, const BetweenPlanes<D>& space,
                    MovedParticles<D>& moved) {
  moved.cells.forEachGroup([&](int k, int count) {
    updateStress<D>(level, material, method, time, dt, u, moved.velocityGradient.data() + k, moved.cells.first() + k,
                    count, moved.waveSpeed.data() + k);
  });
  moved.cells.forEachCell([&](const Index<D>& cell, const data::ParticleRange& range) {
    CrossingRate<D> rate = none;
    const double* const waveSpeed = moved.waveSpeed.data() + (range.first - moved.cells.first());
    rate.add(waveSpeed, u.velocity.values() + range.first, range.size());
    if (!rate.isKnown() || (u.newX && !space.containAll(u.newX->values() + range.first, range.size())))
      rate = withoutLost<D>(level, u, cell, range, none, space, waveSpeed);
    u.stableTimeStep[cell] = rate.time();
  });
  moved.cells.clear();
}

/// Updates F, the stress and related quantities of the patch's own particles to the end of the step, and computes the
/// stable time step of each cell. Calls `move(p, count, sums)` for the sums that particles from p on gather from the
/// grid: for one particle, or for several in lanes. Throws NumericalError if a wave speed is undefined. The step starts
/// at `time` [s].
template <class Shape, Volumes volumes, class Move, int D = Shape::dimension>
void updateParticles(const Patch& patch, const Material& material, const Method& method, double time, double dt,
                     const StateUpdate<D>& u, Move&& move) {
  const Level& level = patch.level();
  const Extents<Shape> extents(level, method.commonSize, u.size, u.oldDeformation);
  const CrossingRate<D> none(level);
  const BetweenPlanes<D> space(level, material.index);
  u.stableTimeStep.fill(none.time());
  if (u.x.owned() == 0) return;
  MovedParticles<D> moved;
  u.x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    if (!moved.cells.takes(range)) updateStresses<D>(level, material, method, time, dt, u, none, space, moved);
    Matrix3* const velocityGradient = moved.add(cell, range);
    moveAndDeform(level, cell, extents, material, method, dt, u, range, velocityGradient, move);
    if constexpr (volumes == Volumes::shared) shareVolume<D>(dt, range, u, velocityGradient);
  });
  updateStresses<D>(level, material, method, time, dt, u, none, space, moved);
}

}  // namespace tushar::mpm::solid
