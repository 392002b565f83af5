#pragma once

#include "components/mpm/solid/loads/prescribed_deformation.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/node_windows.hpp"

namespace tushar::mpm::solid {

/// Sets v*_i = L(t) x_i on all nodes near particles, without acceleration: velocities of particles do not change,
/// while particles move and deform with the grid, about the origin.
template <int D>
void prescribeMotion(const Patch& patch, const Material&, const PrescribedDeformation* deformation, int ghostNodes,
                     double time, ParticleView<const Vec<D>> x, NodeView<NodeRecord> record) {
  const Level& level = patch.level();
  const Matrix3 gradient = deformation->velocityGradient(time);
  touchedRows<D>(x, ghostNodes).forEachRow(record.box(), [&](const Index3& first, int end) {
    NodeRecord* node = record.values() + record.stored().offset(first);
    Vec<D> place;
    for (int d = 0; d < D; ++d) place[d] = level.nodePosition(d, first[d]);
    for (int k = first[0]; k < end; ++k, ++node) {
      place[0] = level.nodePosition(0, k);
      const Vec<D> velocity = level.reduce<D>(Vec3(gradient * level.expandPoint<D>(place)));
      setLanes<D>(*node, lane::velocity, velocity);
      setLanes<D>(*node, lane::before, velocity);
    }
  });
}

}  // namespace tushar::mpm::solid
