#pragma once

#include "components/mpm/solid/implicit/solve.hpp"

namespace tushar::mpm::solid::implicit {

/// A nodal field at a particle: sum_i S_i f_i, and the gradient in x, y, z.
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

/// Particles that move and deform in a step.
template <class Shape, int D = Shape::dimension>
struct Movement {
  NodeView<const Vec<D>> increment;  ///< displacement in the step
  Placed<Shape> placed;
  ParticleView<const double> mass, temperature;
  ParticleView<const Matrix3> oldDeformation, oldStress;
  ParticleView<const double> oldState;
  OptionalView<const Vec<D>> oldDisplacement;  ///< where the grid moves with the solid
  ParticleView<Vec<D>> newX;
  OptionalView<Vec<D>> displacement;  ///< where the grid moves with the solid
  ParticleView<Matrix3> deformation, stress;
  ParticleView<double> state, volume, strainEnergy;
  OptionalView<double> temperatureChange;  ///< where the work of the step heats

  static Movement from(auto& take, bool resetsGrid, bool heats, const ParticleLabel<double>* state) {
    return {.increment = take(requiresNew(g::increment<D>, Shape::ghostNodes)),
            .placed = Placed<Shape>::from(take, keepsSizes),
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

/// F_p = (I + G_p) F_p of the particles of a patch, with the gradient G_p in `states`, and the stress that follows.
template <class Shape, int D = Shape::dimension>
void stressOfStep(const Patch& patch, const Material& material, PointStates& states, const Movement<Shape>& m) {
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

/// x_p += sum_i S_i u_i,  F_p = (I + sum_i u_i grad S_i) F_p, and the stress that follows. Where the grid moves with
/// the solid, x_p stays, sum_i S_i u_i adds to the displacement of the particle, and F_p += sum_i u_i grad_0 S_i.
template <class Shape, int D = Shape::dimension>
void moveAndStress(const Patch& patch, const Material& material, const ImplicitSetup& setup, double dt,
                   const Movement<Shape>& m) {
  const ParticleView<const Vec<D>>& x = m.placed.x;
  if (x.owned() == 0) return;
  PointStates states(x.owned(), setup.stateSize, dt, setup.how.sharesVolume);
  const Vec3& commonSize = setup.problem->method.commonSize;
  forEachStencil(patch, patch.cells(), m.placed, commonSize, [&](int p, const auto& stencil) {
    const auto [moved, gradient] = interpolated(patch.level(), stencil, m.increment);
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

/// Particles whose velocity follows Newmark's rule.
template <class Shape, int D = Shape::dimension>
struct NewmarkUpdate {
  NodeView<const Vec<D>> nodalAcceleration;
  Placed<Shape> placed;
  ParticleView<const Vec<D>> oldVelocity, oldAcceleration;
  ParticleView<Vec<D>> velocity, acceleration;

  static NewmarkUpdate from(auto& take) {
    return {.nodalAcceleration = take(requiresNew(g::newAcceleration<D>, Shape::ghostNodes)),
            .placed = Placed<Shape>::from(take, keepsSizes),
            .oldVelocity = take(requiresOld(p::velocity<D>)),
            .oldAcceleration = take(requiresOld(p::acceleration<D>)),
            .velocity = take(computes(p::velocity<D>)),
            .acceleration = take(computes(p::acceleration<D>))};
  }
};

/// Newmark: v_p += dt/2 (a_p + a'_p) with a'_p = sum_i S_i a_i.
template <class Shape, int D = Shape::dimension>
void advanceVelocity(const Patch& patch, const Material&, const Vec3& commonSize, double dt,
                     const NewmarkUpdate<Shape>& u) {
  forEachStencil(patch, patch.cells(), u.placed, commonSize, [&](int p, const auto& stencil) {
    u.acceleration[p] = interpolated(patch.level(), stencil, u.nodalAcceleration).first;
    u.velocity[p] = u.oldVelocity[p] + dt / 2 * (u.oldAcceleration[p] + u.acceleration[p]);
  });
}

/// Without inertia: v_p = (x'_p - x_p) / dt, with positions or displacements for x_p.
template <int D>
void meanVelocity(const Patch&, const Material&, double dt, ParticleView<const Vec<D>> before,
                  ParticleView<const Vec<D>> after, ParticleView<Vec<D>> velocity, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < before.owned(); ++p) {
    velocity[p] = (after[p] - before[p]) / dt;
    acceleration[p] = Vec<D>::Zero();
  }
}

/// a_p = 0 when a run without inertia starts.
template <int D>
void startAtRest(const Patch&, const Material&, ParticleView<const double> mass, ParticleView<Vec<D>> acceleration) {
  for (int p = 0; p < mass.owned(); ++p) acceleration[p] = Vec<D>::Zero();
}

/// Newmark: a_p = sum_i S_i a_i when a run starts.
template <class Shape, int D = Shape::dimension>
void startInMotion(const Patch& patch, const Material&, const Vec3& commonSize, NodeView<const Vec<D>> nodal,
                   ParticleView<const Vec<D>> x, ParticleView<const Vec<D>> size, ParticleView<Vec<D>> acceleration) {
  const Extents<Shape> extents(patch.level(), commonSize, size, std::nullopt);
  forEachStencil<Shape>(patch, patch.cells(), x, extents, [&](int p, const auto& stencil) {
    acceleration[p] = interpolated(patch.level(), stencil, nodal).first;
  });
}

/// With inertia: at its present velocity no particle moves more than .8 of a cell along any axis in the next step.
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
  applyExternalLoads<D>(patch, material, loads, time + dt, x, mass, loadCurves, std::nullopt, externalForce);
}

}  // namespace tushar::mpm::solid::implicit
