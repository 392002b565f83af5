#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/tasks/boundary.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// v*_i = v_i + (F_i / m_i - damping v_i + gravity) dt
template <int D, bool Loaded>
void computeAndIntegrateAcceleration(const Patch& patch, const Material&, const Method& method,
                                     NodeView<const double> mass, NodeView<const Vec<D>> internalForce,
                                     Optional<Loaded, NodeView<const Vec<D>>> externalForce,
                                     NodeView<const Vec<D>> velocity, double dt, NodeView<Vec<D>> velocityStar) {
  const Vec<D> gravity = patch.level().reduce<D>(method.gravity);
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    Vec<D> a = gravity;
    if (mass[node] > method.minimumMassForAcceleration) {
      Vec<D> force = internalForce[node];
      if constexpr (Loaded) force += externalForce[node];
      a += force / mass[node] - method.damping * velocity[node];
    }
    velocityStar[node] = velocity[node] + a * dt;
  });
}

/// v*_i on the sides of the grid, and what the velocity changed by: a_i = (v*_i - v_i) / dt.
template <int D>
void setGridBoundaryConditions(const Patch& patch, const Material& material, NodeView<const Vec<D>> velocity, double dt,
                               NodeView<Vec<D>> velocityStar, NodeView<Vec<D>> acceleration) {
  setVelocity<D>(patch, material.index, velocityStar);
  setSymmetry<D>(patch, material.index, velocityStar);
  forEach<D>(velocity.box(),
             [&](const Index<D>& node) { acceleration[node] = (velocityStar[node] - velocity[node]) / dt; });
}

}  // namespace tushar::mpm::solid
