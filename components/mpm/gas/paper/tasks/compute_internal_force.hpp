#pragma once

#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirrored.hpp"
#include "components/mpm/labels.hpp"

namespace tushar::mpm::gas::paper {

/// Adds pressure times volume of a cell, times the gradient of each shape function in its middle, to its nodes.
template <class Shape, int D = Shape::dimension>
void addPressureForce(const Level& level, const Index<D>& cell, double pressureTimesVolume, NodeView<Vec<D>> force) {
  for (int k = 0; k < Shape::nodes; ++k) {
    const Index<D> node = Shape::node(cell, k);
    if (!force.box().contains(node)) continue;
    for (int d = 0; d < D; ++d) force[node][d] += pressureTimesVolume * Shape::centreGradient(level, k, d);
  }
}

/// F_i = sum over the cells c around node i of P_c V_c grad S_i(centre of c), with P_c the mean pressure of the
/// particles in c, artificial viscosity included: (9) of Tran, Kim & Berzins, in any dimension. In one dimension
/// F_i = P_{i-1} - P_i.
///
/// `force` [N] comes out complete on all nodes of the patch. A cell without particles has no pressure.
template <class Shape, int D = Shape::dimension>
void computeInternalForce(const Patch& patch, const Gas&, ParticleView<const double> pressure, NodeView<Vec<D>> force) {
  const Level& level = patch.level();
  force.fill(Vec<D>::Zero());
  forEach<D>(pressure.cells(), [&](const Index<D>& cell) {
    const int count = pressure.in(cell).size();
    if (count == 0) return;
    const auto sum = sumFromBothEnds<double>(pressure.in(cell), [&](int p, double& part) { part += pressure[p]; });
    const double impulse = sum / count * level.cellVolume();
    addPressureForce<Shape>(level, cell, impulse, force);
  });
}

/// The same with P_c the mean weighted by the volume m_p / rho_p that each particle carries.
template <class Shape, int D = Shape::dimension>
void computeInternalForceOfVolumes(const Patch& patch, const Gas&, ParticleView<const double> pressure,
                                   ParticleView<const double> mass, ParticleView<const double> density,
                                   NodeView<Vec<D>> force) {
  const Level& level = patch.level();
  force.fill(Vec<D>::Zero());
  forEach<D>(pressure.cells(), [&](const Index<D>& cell) {
    const auto particles = pressure.in(cell);
    const auto volume = sumFromBothEnds<double>(particles, [&](int p, double& part) { part += mass[p] / density[p]; });
    const auto sum =
        sumFromBothEnds<double>(particles, [&](int p, double& part) { part += pressure[p] * mass[p] / density[p]; });
    if (volume > 0) addPressureForce<Shape>(level, cell, sum / volume * level.cellVolume(), force);
  });
}

}  // namespace tushar::mpm::gas::paper
