#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/paper/shape_functions.hpp"

namespace tushar::mpm::gas::paper {

/// Adds the contribution of one cell in (9), P_c V_c grad S_i at the centre of the cell, to the force on its nodes.
template <int D>
void addPressureForce(const Level& level, const Index<D>& cell, double pressureTimesVolume, NodeView<Vec<D>> force) {
  for (int k = 0; k < Linear<D>::nodes; ++k) {
    const Index<D> node = Linear<D>::node(cell, k);
    if (!force.box().contains(node)) continue;
    for (int d = 0; d < D; ++d) force[node][d] += pressureTimesVolume * Linear<D>::centreGradient(level, k, d);
  }
}

/// Computes F_i = sum over the cells c around node i of P_c V_c grad S_i(middle of c),   P_c = 1/N_c sum over p in c of
/// p_p:
/// (9) of Tran, Kim & Berzins, in any dimension. In one dimension F_i = P_below - P_above, times the cross-section.
///
/// `pressure` belongs to the state at the start of the step: the previous step computed it with (16), including
/// artificial viscosity. `force` [N] is complete on all nodes of the patch. A cell without particles has no pressure.
template <int D>
void computeInternalForce(const Patch& patch, const Gas&, ParticleView<const double> pressure, NodeView<Vec<D>> force) {
  const Level& level = patch.level();
  force.fill(Vec<D>::Zero());
  forEach<D>(pressure.cells(), [&](const Index<D>& cell) {
    const int count = pressure.in(cell).size();
    if (count == 0) return;
    const auto sum = sumOverParticles<double>(pressure.in(cell), [&](int p, double& part) { part += pressure[p]; });
    addPressureForce<D>(level, cell, sum / count * level.cellVolume(), force);
  });
}

/// Computes (9) for particles that keep their mass: P_c is the mean of p_p, weighted by the particles' volumes m_p /
/// rho_p.
template <int D>
void computeInternalForceOfVolumes(const Patch& patch, const Gas&, ParticleView<const double> pressure,
                                   ParticleView<const double> mass, ParticleView<const double> density,
                                   NodeView<Vec<D>> force) {
  const Level& level = patch.level();
  force.fill(Vec<D>::Zero());
  forEach<D>(pressure.cells(), [&](const Index<D>& cell) {
    const auto particles = pressure.in(cell);
    const auto volume = sumOverParticles<double>(particles, [&](int p, double& part) { part += mass[p] / density[p]; });
    const auto sum =
        sumOverParticles<double>(particles, [&](int p, double& part) { part += pressure[p] * mass[p] / density[p]; });
    if (volume > 0) addPressureForce<D>(level, cell, sum / volume * level.cellVolume(), force);
  });
}

}  // namespace tushar::mpm::gas::paper
