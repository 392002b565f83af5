#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/symmetry_planes.hpp"

namespace tushar::mpm::gas::paper {

/// a_i = F_i / m_i                                               (10)
/// v*_i = v_i + a_i dt                                           (11) of Tran, Kim & Berzins
///
/// v* is v^{n+1} of the paper. A node without mass does not move.
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

/// Ensures that nothing moves through a symmetry plane: the normal components of v*_i and a_i are set to 0 there.
template <int D>
void setGridBoundaryConditions(const Patch& patch, const Gas&, NodeView<Vec<D>> acceleration,
                               NodeView<Vec<D>> velocityStar) {
  stopAtSymmetryPlanes<D>(patch, acceleration);
  stopAtSymmetryPlanes<D>(patch, velocityStar);
}

}  // namespace tushar::mpm::gas::paper
