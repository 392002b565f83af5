#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/reference/gas_solution.hpp"

namespace tushar::mpm::gas {

using reference::ErrorNorms;

/// Computes errors of density, velocity, pressure (without artificial viscosity) and internal energy, relative to the
/// exact values at the particles.
template <int D>
void measureParticleError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                          const reference::Clock* clock, ParticleView<const Vec<D>> x,
                          ParticleView<const double> density, ParticleView<const Vec<D>> velocity,
                          ParticleView<const double> internalEnergy, const ErrorNorms& errors) {
  const Level& level = patch.level();
  for (int p = 0; p < density.owned(); ++p) {
    const Vec3 place = level.expandPoint<D>(x[p]);
    if (!exact->covers(place, clock->time)) continue;
    errors.add({.density = density[p],
                .velocity = level.expandDirection<D>(velocity[p]),
                .pressure = gas.pressure(density[p], internalEnergy[p]),
                .energy = gas.fullEnergy(density[p], internalEnergy[p])},
               exact->at(place, clock->time));
  }
}

/// Computes errors of the unweighted means over the particles of a cell, relative to exact cell means. An empty cell
/// counts as vacuum.
template <int D>
void measureCellError(const Patch& patch, const Gas& gas, const reference::GasReference* exact,
                      const reference::Clock* clock, ParticleView<const double> density,
                      ParticleView<const Vec<D>> velocity, ParticleView<const double> internalEnergy,
                      const ErrorNorms& errors) {
  const Level& level = patch.level();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!exact->covers(level.expandPoint<D>(level.cellCentre<D>(cell)), clock->time)) return;
    reference::GasState mean;
    for (const int p : density.in(cell)) {
      mean.density += density[p];
      mean.velocity += level.expandDirection<D>(velocity[p]);
      mean.pressure += gas.pressure(density[p], internalEnergy[p]);
      mean.energy += internalEnergy[p];
    }
    const double count = std::max(density.in(cell).size(), 1);
    mean = {mean.density / count, mean.velocity / count, mean.pressure / count, mean.energy / count};
    errors.add(mean, reference::cellMean<D>(*exact, level, cell, clock->time));
  });
}

/// Computes the error of the nodal density m_i / V_i relative to the exact density at the node; V_i is the integral of
/// S_i over the grid. Each node is counted once: by the patch of the cell above it or, on the upper boundary, of the
/// cell below it.
template <int D>
void measureNodeError(const Patch& patch, const Gas&, const reference::GasReference* exact,
                      const reference::Clock* clock, NodeView<const double> mass, Norm& error) {
  const Level& level = patch.level();
  forEach<D>(patch.nodes(), [&](const Index<D>& node) {
    Vec<D> at;
    double volume = level.cellVolume();
    for (int d = 0; d < D; ++d) {
      if (node[d] == patch.cells().upper[d] && !patch.isAtBoundary(d, 1)) return;
      at[d] = level.nodePosition(d, node[d]);
      if (!level.isPeriodic(d) && (node[d] == 0 || node[d] == level.cells().upper[d])) volume *= 0.5;
    }
    const Vec3 place = level.expandPoint<D>(at);
    if (exact->covers(place, clock->time)) error.add(mass[node] / volume - exact->at(place, clock->time).density);
  });
}

}  // namespace tushar::mpm::gas
