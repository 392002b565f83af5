#pragma once

#include "components/mpm/labels.hpp"
#include "components/mpm/materials/gas.hpp"

namespace tushar::mpm {

/// a_i = F_i / m_i,   v*_i = v_i + a_i dt      (10)-(11) of Tran, Kim & Berzins. A node without mass does not move.
template <int D>
void computeAndIntegrateAcceleration(const Patch&, const Gas&, NodeView<const double> mass,
                                     NodeView<const Vec<D>> force, NodeView<const Vec<D>> velocity, double dt,
                                     NodeView<Vec<D>> acceleration, NodeView<Vec<D>> velocityStar) {
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    Vec<D> a = Vec<D>::Zero();
    if (mass[node] > 0) a = force[node] / mass[node];
    acceleration[node] = a;
    velocityStar[node] = velocity[node] + a * dt;
  });
}

/// At a symmetry plane nothing moves through it: the normal components of v*_i and a_i are 0.
template <int D>
void setGridBoundaryConditions(const Patch& patch, const Gas&, NodeView<Vec<D>> acceleration,
                               NodeView<Vec<D>> velocityStar) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      if (!patch.isAtBoundary(d, side) || !patch.level().isSymmetry(d, side)) continue;
      forEach<D>(patch.faceNodes(d, side), [&](const Index<D>& node) {
        acceleration[node][d] = 0;
        velocityStar[node][d] = 0;
      });
    }
}

}  // namespace tushar::mpm
