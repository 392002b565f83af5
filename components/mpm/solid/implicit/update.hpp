#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/implicit/solve.hpp"

namespace tushar::mpm::solid::implicit {

/// A nodal field interpolated to a particle: sum_i S_i f_i, and the gradient in x, y, z.
template <int D>
std::pair<Vec<D>, Matrix3> interpolated(const Level& level, std::span<const Touch<D>> touched,
                                        const NodeView<const Vec<D>>& field) {
  Vec<D> value = Vec<D>::Zero();
  Matrix3 gradient = Matrix3::Zero();
  for (const Touch<D>& touch : touched) {
    const Vec<D>& f = field[touch.node];
    value += touch.s * f;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) gradient(sceneAxis<D>(level, i), sceneAxis<D>(level, j)) += f[i] * touch.gradient[j];
    gradient(2, 2) += f[0] * touch.hoop;
  }
  return {value, gradient};
}

/// Views of particles that move and deform in a step.
template <int D>
struct Movement {
  NodeView<const Vec<D>> increment;  ///< displacement in the step
  Placed<D> placed;
  ParticleView<const double> mass, temperature;
  ParticleView<const Matrix3> oldDeformation, oldStress;
  ParticleView<const double> oldState;
  /// Displacement of the grid before the step, if the grid moves with the solid.
  OptionalView<const Vec<D>> oldDisplacement;
  ParticleView<Vec<D>> newX;
  OptionalView<Vec<D>> displacement;  ///< displacement of the grid after the step, if the grid moves with the solid
  ParticleView<Matrix3> deformation, stress;
  ParticleView<double> state, volume, strainEnergy;
  OptionalView<double> temperatureChange;  ///< temperature change, if the work of the step causes heating

  static Movement from(auto& take, int ghostNodes, bool resetsGrid, bool heats, const ParticleLabel<double>* state) {
    return {.increment = take(requiresNew(g::increment<D>, ghostNodes)),
            .placed = Placed<D>::from(take, keepsSizes, 0, when(false, requiresOld(p::deformationMeasure))),
            .mass = take(requiresOld(p::mass)),
            .temperature = take(requiresOld(p::temperature)),
            .oldDeformation = take(requiresOld(p::deformationMeasure)),
            .oldStress = take(requiresOld(p::stress)),
            .oldState = take(requiresOld(*state)),
            .oldDisplacement = take(when(!resetsGrid, requiresOld(p::displacement<D>))),
            .newX = take(computes(p::x<D>)),
            .displacement = take(when(!resetsGrid, computes(p::displacement<D>))),
            .deformation = take(computes(p::deformationMeasure)),
            .stress = take(computes(p::stress)),
            .state = take(computes(*state)),
            .volume = take(computes(p::volume)),
            .strainEnergy = take(computes(p::strainEnergy)),
            .temperatureChange = take(when(heats, computes(p::temperatureChange)))};
  }
};

/// Computes F_p = (I + G_p) F_p of the particles of a patch, with the gradient G_p in `states`, and the stress that
/// follows.
template <int D>
void stressOfStep(const Patch& patch, const Material& material, PointStates& states, const Movement<D>& m) {
  const PointGroup group{.material = &material,
                         .count = m.mass.owned(),
                         .mass = valuesOf(m.mass),
                         .temperature = valuesOf(m.temperature),
                         .oldDeformation = valuesOf(m.oldDeformation),
                         .oldStress = valuesOf(m.oldStress),
                         .oldState = valuesOf(m.oldState),
                         .newState = valuesOf(m.state),
                         .strainEnergy = valuesOf(m.strainEnergy),
                         .temperatureChange = valuesOf(m.temperatureChange)};
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange range = m.mass.in(cell);
    const PointRun run{&group, range.first, range.size()};
    states.deform(run);
    states.updateStress(run);
  });
  for (int p = 0; p < m.mass.owned(); ++p) {
    m.deformation[p] = states.deformation[p];
    m.stress[p] = states.stress[p];
    m.volume[p] = m.mass[p] / material.undeformedDensity() * m.deformation[p].determinant();
  }
}

/// Computes x_p += sum_i S_i u_i,  F_p = (I + sum_i u_i grad S_i) F_p, and the stress that follows. If the grid moves
/// with the solid, x_p stays, sum_i S_i u_i adds to the displacement of the particle, and F_p += sum_i u_i grad_0 S_i.
template <int D>
void moveAndStress(const Patch& patch, const Material& material, const ImplicitSetup<D>& setup, double dt,
                   const Movement<D>& m) {
  const ParticleView<const Vec<D>>& x = m.placed.x;
  if (x.owned() == 0) return;
  PointStates states(x.owned(), setup.stateSize, dt, setup.how.sharesVolume);
  setup.forEachTouched(patch, m.placed, [&](int p, std::span<const Touch<D>> touched) {
    const auto [moved, gradient] = interpolated<D>(patch.level(), touched, m.increment);
    Matrix3& step = states.gradient[p];
    if (m.displacement) {
      m.newX[p] = x[p];
      (*m.displacement)[p] = (*m.oldDisplacement)[p] + moved;
      step = gradient * m.oldDeformation[p].inverse();
    } else {
      m.newX[p] = x[p] + moved;
      step = gradient;
    }
  });
  stressOfStep(patch, material, states, m);
}

/// Views of particles whose velocity follows Newmark's method.
template <int D>
struct NewmarkUpdate {
  NodeView<const Vec<D>> nodalAcceleration;
  Placed<D> placed;
  ParticleView<const Vec<D>> oldVelocity, oldAcceleration;
  ParticleView<Vec<D>> velocity, acceleration;

  static NewmarkUpdate from(auto& take, int ghostNodes) {
    return {.nodalAcceleration = take(requiresNew(g::newAcceleration<D>, ghostNodes)),
            .placed = Placed<D>::from(take, keepsSizes, 0, when(false, requiresOld(p::deformationMeasure))),
            .oldVelocity = take(requiresOld(p::velocity<D>)),
            .oldAcceleration = take(requiresOld(p::acceleration<D>)),
            .velocity = take(computes(p::velocity<D>)),
            .acceleration = take(computes(p::acceleration<D>))};
  }
};

/// Computes Newmark's update, v_p += dt/2 (a_p + a'_p) with a'_p = sum_i S_i a_i. A master whose motion is prescribed
/// has its velocity at the end of the step.
template <int D>
void advanceVelocity(const Patch& patch, const Material& material, const ImplicitSetup<D>& setup, double time,
                     double dt, const NewmarkUpdate<D>& u) {
  if (const auto given = setup.masterVelocity(material.index, time + dt)) {
    for (int p = 0; p < u.velocity.owned(); ++p) {
      u.velocity[p] = patch.level().template reduce<D>(*given);
      u.acceleration[p] = Vec<D>::Zero();
    }
    return;
  }
  setup.forEachTouched(patch, u.placed, [&](int p, std::span<const Touch<D>> touched) {
    u.acceleration[p] = interpolated<D>(patch.level(), touched, u.nodalAcceleration).first;
    u.velocity[p] = u.oldVelocity[p] + dt / 2 * (u.oldAcceleration[p] + u.acceleration[p]);
  });
}

/// Computes the update without inertia, v_p = (x'_p - x_p) / dt, where x_p and x'_p are positions or displacements
/// before and after the step.
template <int D>
void meanVelocity(const Patch&, const Material&, double dt, ParticleView<const Vec<D>> before,
                  ParticleView<const Vec<D>> after, ParticleView<Vec<D>> velocity, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < before.owned(); ++p) {
    velocity[p] = (after[p] - before[p]) / dt;
    acceleration[p] = Vec<D>::Zero();
  }
}

/// Sets a_p = 0 when a run without inertia starts.
template <int D>
void startAtRest(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < mass.owned(); ++p) acceleration[p] = Vec<D>::Zero();
}

/// Sets a_p = sum_i S_i a_i when a run with Newmark's method starts.
template <int D>
void startInMotion(const Patch& patch, const Material&, const ImplicitSetup<D>& setup, NodeView<const Vec<D>> nodal,
                   ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size, ParticleView<Vec<D>> acceleration) {
  const Placed<D> placed{.x = x, .size = size, .deformation = std::nullopt};
  setup.forEachTouched(patch, placed, [&](int p, std::span<const Touch<D>> touched) {
    acceleration[p] = interpolated<D>(patch.level(), touched, nodal).first;
  });
}

/// With inertia: limits the next step so that no particle moves by more than .8 of a cell along any axis at its current
/// velocity, or at that of a master whose motion is prescribed.
template <int D>
void limitBySpeed(const Patch& patch, const Material& material, const ImplicitSetup<D>& setup, double time,
                  ParticleView<const Vec<D>> velocity, Minimum& dt) {
  const auto limit = [&](const Vec<D>& v) {
    for (int d = 0; d < D; ++d)
      if (const double speed = std::abs(v[d]); speed > 0)
        dt.add(0.8 * patch.level().spacing(d) / speed, "the speed of particles");
  };
  if (const auto given = setup.masterVelocity(material.index, time))
    return limit(patch.level().template reduce<D>(*given));
  for (int p = 0; p < velocity.owned(); ++p) limit(velocity[p]);
}

/// Computes the force of loads on each particle at the end of the step.
template <int D>
void applyLoadsAtEnd(const Patch& patch, const Material& material, const Loads& loads, double time, double dt,
                     ParticleView<const Vec<D>> x, ParticleView<const double> mass, ParticleView<const int> loadCurves,
                     ParticleView<Vec<D>> externalForce) {
  applyExternalLoads<D>(patch, material, loads, time + dt, x, mass, loadCurves, std::nullopt, externalForce);
}

/// Computes the heat flow [W] from loads to each particle at the end of a step.
template <int D>
void applyHeatFluxAtEnd(const Patch& patch, const Material& material, const Loads& loads, double time, double dt,
                        ParticleView<const Vec<D>> x, ParticleView<const int> loadCurves,
                        ParticleView<double> heatFlux) {
  applyHeatFlux<D>(patch, material, loads, time + dt, x, loadCurves, heatFlux);
}

}  // namespace tushar::mpm::solid::implicit
