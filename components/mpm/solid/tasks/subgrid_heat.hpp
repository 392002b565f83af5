#pragma once

#include <cmath>

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/tasks/thermal_particles.hpp"

// Conduction within cells, which the nodes do not see; Gerya & Yuen, Phys. Earth Planet. Inter. 140 (2003) 293, section
// 4: particles relax towards the field of the nodes, and the nodes conduct that much less.

namespace tushar::mpm::solid {

/// The fraction 1 - exp(-dt / tau) by which the temperatures of particles approach the field of the nodes in a step,
/// with tau = rho c_v / (k sum_d 2 / h_d^2), about the time in which heat crosses a cell (equation 39 of the source, d
/// = 1).
template <int D>
double subgridShare(const Level& level, const Material& material, double dt) {
  if (material.thermalConductivity == 0) return 0;
  double rate = 0;
  for (int d = 0; d < D; ++d) rate += 2 * level.inverseSpacing(d) * level.inverseSpacing(d);
  return -std::expm1(-dt * rate * material.thermalConductivity /
                     (material.undeformedDensity() * material.specificHeat));
}

/// Views of the particles that conduct heat within cells.
template <int D>
struct SubgridHeat {
  ThermalParticles<D> particles;
  NodeView<const double> temperature, capacity;
  NodeView<double> change;

  static SubgridHeat from(auto& take, const ShapeTraits& shape, KeptSizes keepsSizes) {
    return {.particles = ThermalParticles<D>::from(take, shape.reach, keepsSizes),
            .temperature = take(requiresNew(g::temperature, shape.reach + shape.ghostNodes)),
            .capacity = take(requiresNew(g::heatCapacity)),
            .change = take(computes(g::subgridTemperatureChange))};
  }
};

/// Computes the change of the nodes' temperatures that conduction within cells already gives the particles,
/// sum_p S_i m_p c_v delta_p / C_i [K] with delta_p = share (sum_j S_j T_j - T_p).
template <class Shape, int D = Shape::dimension>
void computeSubgridHeat(const Patch& patch, const Material& material, const Vec3& commonSize, const SubgridHeat<D>& h,
                        double dt) {
  h.change.fill(0.0);
  if (material.thermalConductivity == 0) return;
  const double share = subgridShare<D>(patch.level(), material, dt) * material.specificHeat;
  forEachStencilGroup<Shape>(
      patch, h.particles.placed.x.cells(), h.particles.placed, commonSize,
      [&]<class Stencils>(int p, int count, const Stencils& stencils) {
        const Lanes gap = fieldAt(stencils, h.temperature) - valuesOf(h.particles.temperature, p, count);
        const Lanes heat = share * valuesOf(h.particles.mass, p, count) * gap;
        NodeShares<Stencils> shares;
        stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) { shares[at] = s * heat; });
        addShares(stencils, count, h.change, shares);
      });
  forEach<D>(h.change.box(), [&](const Index<D>& node) {
    h.change[node] = h.capacity[node] > 0 ? h.change[node] / h.capacity[node] : 0.0;
  });
}

}  // namespace tushar::mpm::solid
