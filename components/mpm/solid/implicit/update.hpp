#pragma once

#include "components/mpm/solid/implicit/solve.hpp"

namespace tushar::mpm::solid::implicit {

/// What a particle takes from a field of the nodes: sum_i S_i f_i and the gradient, in x, y, z.
template <class Stencil, int D = Stencil::dimension>
std::pair<Vec<D>, Matrix3> interpolated(const Level& level, const Stencil& stencil,
                                        const NodeView<const Vec<D>>& field) {
  Vec<D> value = Vec<D>::Zero();
  Matrix3 gradient = Matrix3::Zero();
  stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& slope) {
    const Vec<D>& f = field[node];
    value += s * f;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) gradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) += f[i] * slope[j];
    gradient(2, 2) += f[0] * hoopOf(stencil, node);
  });
  return {value, gradient};
}

/// F_p = (I + G_p) F_p of the particles of a patch, and the stress that follows, where `states` knows each G_p.
template <int D>
void stressOfStep(const Patch& patch, const Material& material, PointStates& states, ParticleView<const double> mass,
                  ParticleView<const double> temperature, ParticleView<const Matrix3> oldDeformation,
                  ParticleView<const Matrix3> oldStress, ParticleView<const double> oldState,
                  ParticleView<Matrix3> deformation, ParticleView<Matrix3> stress, ParticleView<double> state,
                  ParticleView<double> volume, ParticleView<double> strainEnergy,
                  OptionalView<double> temperatureChange) {
  PointGroup group{&material,
                   mass.owned(),
                   0,
                   valuesOf(mass),
                   valuesOf(temperature),
                   valuesOf(oldDeformation),
                   valuesOf(oldStress),
                   valuesOf(oldState),
                   valuesOf(state),
                   valuesOf(strainEnergy)};
  if (temperatureChange) group.temperatureChange = valuesOf(*temperatureChange);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange range = mass.in(cell);
    const PointRun run{&group, range.first, range.size()};
    states.deform(run);
    states.updateStress(run);
  });
  for (int p = 0; p < mass.owned(); ++p) {
    deformation[p] = states.deformation[static_cast<std::size_t>(p)];
    stress[p] = states.stress[static_cast<std::size_t>(p)];
    volume[p] = mass[p] / material.density * deformation[p].determinant();
  }
}

/// x_p += sum_i S_i u_i,  F_p = (I + sum_i u_i grad S_i) F_p, and the stress that follows.
template <class Shape, int D = Shape::dimension>
void moveAndStress(const Patch& patch, const Material& material, const ImplicitSetup& setup, double dt,
                   NodeView<const Vec<D>> increment, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size,
                   ParticleView<const double> mass, ParticleView<const double> temperature,
                   ParticleView<const Matrix3> oldDeformation, ParticleView<const Matrix3> oldStress,
                   ParticleView<const double> oldState, ParticleView<Vec<D>> newX, ParticleView<Matrix3> deformation,
                   ParticleView<Matrix3> stress, ParticleView<double> state, ParticleView<double> volume,
                   ParticleView<double> strainEnergy, OptionalView<double> temperatureChange) {
  if (x.owned() == 0) return;
  PointStates states(static_cast<std::size_t>(x.owned()), setup.stateSize, dt, setup.how.sharesVolume);
  const Extents<Shape> extents(patch.level(), setup.problem->method.commonSize, size, std::nullopt);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const auto [moved, gradient] = interpolated(patch.level(), stencil, increment);
    newX[p] = x[p] + moved;
    states.gradient[static_cast<std::size_t>(p)] = gradient;
  });
  stressOfStep<D>(patch, material, states, mass, temperature, oldDeformation, oldStress, oldState, deformation, stress,
                  state, volume, strainEnergy, temperatureChange);
}

/// The same where the grid goes along with the solid: x_p stays, and the displacement of the particle grows;
/// F_p += sum_i u_i grad_0 S_i.
template <class Shape, int D = Shape::dimension>
void stressInPlace(const Patch& patch, const Material& material, const ImplicitSetup& setup, double dt,
                   NodeView<const Vec<D>> increment, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size,
                   ParticleView<const double> mass, ParticleView<const double> temperature,
                   ParticleView<const Matrix3> oldDeformation, ParticleView<const Matrix3> oldStress,
                   ParticleView<const double> oldState, ParticleView<const Vec<D>> oldDisplacement,
                   ParticleView<Vec<D>> newX, ParticleView<Vec<D>> displacement, ParticleView<Matrix3> deformation,
                   ParticleView<Matrix3> stress, ParticleView<double> state, ParticleView<double> volume,
                   ParticleView<double> strainEnergy, OptionalView<double> temperatureChange) {
  if (x.owned() == 0) return;
  PointStates states(static_cast<std::size_t>(x.owned()), setup.stateSize, dt, setup.how.sharesVolume);
  const Extents<Shape> extents(patch.level(), setup.problem->method.commonSize, size, std::nullopt);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    const auto [moved, gradient] = interpolated(patch.level(), stencil, increment);
    newX[p] = x[p];
    displacement[p] = oldDisplacement[p] + moved;
    states.gradient[static_cast<std::size_t>(p)] = gradient * oldDeformation[p].inverse();
  });
  stressOfStep<D>(patch, material, states, mass, temperature, oldDeformation, oldStress, oldState, deformation, stress,
                  state, volume, strainEnergy, temperatureChange);
}

/// Newmark: v_p += dt/2 (a_p + a'_p) with a'_p = sum_i S_i a_i.
template <class Shape, int D = Shape::dimension>
void advanceVelocity(const Patch& patch, const Material&, const ImplicitSetup& setup, double dt,
                     NodeView<const Vec<D>> acceleration, ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size,
                     ParticleView<const Vec<D>> oldVelocity, ParticleView<const Vec<D>> oldAcceleration,
                     ParticleView<Vec<D>> velocity, ParticleView<Vec<D>> newAcceleration) {
  const Extents<Shape> extents(patch.level(), setup.problem->method.commonSize, size, std::nullopt);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    newAcceleration[p] = interpolated(patch.level(), stencil, acceleration).first;
    velocity[p] = oldVelocity[p] + dt / 2 * (oldAcceleration[p] + newAcceleration[p]);
  });
}

/// Without inertia: v_p is how far the particle went over dt, by its place or its displacement; what the next step
/// starts from.
template <int D>
void meanVelocity(const Patch&, const Material&, double dt, ParticleView<const Vec<D>> before,
                  ParticleView<const Vec<D>> after, ParticleView<Vec<D>> velocity, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < before.owned(); ++p) {
    velocity[p] = (after[p] - before[p]) / dt;
    acceleration[p] = Vec<D>::Zero();
  }
}

template <int D>
void startAtRest(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < mass.owned(); ++p) acceleration[p] = Vec<D>::Zero();
}

/// Newmark: a_p = sum_i S_i a_i when a run starts.
template <class Shape, int D = Shape::dimension>
void startInMotion(const Patch& patch, const Material&, const ImplicitSetup& setup, NodeView<const Vec<D>> nodal,
                   ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size, ParticleView<Vec<D>> acceleration) {
  const Extents<Shape> extents(patch.level(), setup.problem->method.commonSize, size, std::nullopt);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    acceleration[p] = interpolated(patch.level(), stencil, nodal).first;
  });
}

/// No particle goes further than .8 of a cell along any axis in the next step; with inertia, where it keeps its
/// velocity.
template <int D>
void limitBySpeed(const Patch& patch, const Material&, ParticleView<const Vec<D>> velocity, Minimum& dt) {
  for (int p = 0; p < velocity.owned(); ++p)
    for (int d = 0; d < D; ++d)
      if (const double speed = std::abs(velocity[p][d]); speed > 0)
        dt.add(0.8 * patch.level().spacing(d) / speed, "the speed of particles");
}

/// The force of loads on each particle at the end of the step.
template <int D>
void applyLoadsAtEnd(const Patch& patch, const Material& material, const Loads& loads, double time, double dt,
                     ParticleView<const Vec<D>> x, ParticleView<const double> mass, ParticleView<const int> loadCurves,
                     ParticleView<Vec<D>> externalForce) {
  applyExternalLoads<D>(patch, material, loads, time + dt, x, mass, loadCurves, externalForce);
}

}  // namespace tushar::mpm::solid::implicit
