#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/method.hpp"
#include "components/mpm/solid/transfer/boundary.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// Computes v*_i = v_i + (f_i / m_i - damping v_i + gravity) dt, or v_i if the material transmits force; afterwards the
/// record holds v* and v.
template <int D>
void computeAndIntegrateAcceleration(const Patch& patch, const Material& material, const Method& method, int ghostNodes,
                                     ParticleView<const Vec<D>> x, double dt, NodeView<NodeRecord> record) {
  const Vec<D> gravity = patch.level().reduce<D>(method.gravity);
  touchedRows<D>(x, ghostNodes).forEachRow(record.box(), [&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    for (int k = first[0]; k < end; ++k, ++node) {
      const double mass = (*node)[lane::mass];
      const Vec<D> v = lanes<D>(*node, lane::velocity);
      Vec<D> a = gravity;
      if (mass > method.minimumMassForAcceleration) a += lanes<D>(*node, lane::force) / mass - method.damping * v;
      if (!material.transmitsForce) setLanes<D>(*node, lane::velocity, v + a * dt);
      setLanes<D>(*node, lane::before, v);
    }
  });
}

/// Sets v*_i at the sides of the grid, at nodes near particles.
template <int D>
void setGridBoundaryConditions(const Patch& patch, const Material& material, int ghostNodes,
                               ParticleView<const Vec<D>> x, NodeView<NodeRecord> record) {
  const data::TouchedRows& rows = touchedRows<D>(x, ghostNodes);
  setVelocity<D>(patch, material.index, rows, record);
  if (!material.transmitsForce) setSymmetry<D>(patch, material.index, rows, record);
}

}  // namespace tushar::mpm::solid
