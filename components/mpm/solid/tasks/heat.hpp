#pragma once

#include <Eigen/LU>

#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/stencil_groups.hpp"

namespace tushar::mpm::solid {

/// Applies the given temperatures of sides (Dirichlet). Other sides are insulated: no heat flows through them.
template <int D>
void setTemperature(const Patch& patch, int material, NodeView<double> field);

/// Views of the particles whose heat is transferred to the nodes.
template <int D>
struct HeatToNodes {
  Placed<D> particles;
  ParticleView<const double> mass, particleTemperature;
  NodeView<double> capacity, temperatureNoBC, temperature;

  static HeatToNodes from(auto& take, int reach, KeptSizes keepsSizes) {
    return {.particles = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .mass = take(requiresOld(p::mass, reach)),
            .particleTemperature = take(requiresOld(p::temperature, reach)),
            .capacity = take(computes(g::heatCapacity)),
            .temperatureNoBC = take(computes(g::temperatureNoBC)),
            .temperature = take(computes(g::temperature))};
  }
};

/// Computes C_i = sum_p S_i m_p c_v,   T_i = sum_p S_i m_p c_v T_p / C_i; 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void interpolateTemperatureToGrid(const Patch& patch, const Material& material, const Vec3& commonSize,
                                  const HeatToNodes<D>& h) {
  h.capacity.fill(0.0);
  h.temperatureNoBC.fill(0.0);
  const Box& box = h.capacity.box();
  forEachStencilGroup<Shape>(patch, h.particles.x.cells(), h.particles, commonSize,
                             [&]<class Stencils>(int p, int count, const Stencils& stencils) {
                               const Lanes heat = valuesOf(h.mass, p, count) * material.specificHeat;
                               const Lanes temperature = valuesOf(h.particleTemperature, p, count);
                               NodeShares<Stencils> capacity, warmth;
                               stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) {
                                 capacity[at] = s * heat;
                                 warmth[at] = capacity[at] * temperature;
                               });
                               addShares(stencils, count, h.capacity, capacity);
                               addShares(stencils, count, h.temperatureNoBC, warmth);
                             });
  forEach<D>(box, [&](const Index<D>& node) {
    if (h.capacity[node] > 0) h.temperatureNoBC[node] /= h.capacity[node];
    h.temperature[node] = h.temperatureNoBC[node];
  });
  setTemperature<D>(patch, material.index, h.temperature);
}

/// Views of the particles that conduct heat to the nodes, and receive the heat of loads.
template <int D>
struct HeatFlow {
  Placed<D> particles;
  ParticleView<const double> mass;
  OptionalView<const double> heatFlux;  ///< heat flow [W], if loads supply heat
  NodeView<const double> temperature;
  NodeView<double> heatRate;

  static HeatFlow from(auto& take, const ShapeTraits& shape, KeptSizes keepsSizes, bool isHeated) {
    const int reach = shape.reach;
    return {.particles = Placed<D>::from(take, keepsSizes, reach, requiresOld(p::deformationMeasure, reach)),
            .mass = take(requiresOld(p::mass, reach)),
            .heatFlux = take(when(isHeated, requiresNew(p::heatFlux, reach))),
            .temperature = take(requiresNew(g::temperature, reach + shape.ghostNodes)),
            .heatRate = take(computes(g::heatRate))};
  }
};

/// Computes Q_i = sum_p S_i H_p - V_p k grad S_i . grad T_p [W], with the heat flow H_p of loads if there are any
template <class Shape, int D = Shape::dimension>
void computeInternalHeatRate(const Patch& patch, const Material& material, const Vec3& commonSize,
                             const HeatFlow<D>& h) {
  h.heatRate.fill(0.0);
  if (material.thermalConductivity == 0 && !h.heatFlux) return;
  const double density = material.undeformedDensity();
  forEachStencilGroup<Shape>(patch, h.particles.x.cells(), h.particles, commonSize,
                             [&]<class Stencils>(int p, int count, const Stencils& stencils) {
                               const auto temperature = nodeValues(stencils, h.temperature);
                               std::array<Lanes, D> slope;
                               slope.fill(0.0);
                               stencils.forEachNode([&](std::size_t at, Lanes, const std::array<Lanes, D>& gradient) {
                                 for (std::size_t d = 0; d < D; ++d) slope[d] += temperature[at] * gradient[d];
                               });
                               const Lanes ratio = determinant(lanesOf(h.particles.deformation->values() + p, count));
                               const Lanes volume = valuesOf(h.mass, p, count) / density * ratio;
                               for (Lanes& one : slope) one *= -material.thermalConductivity * volume;
                               const Lanes flux = h.heatFlux ? valuesOf(*h.heatFlux, p, count) : Lanes(0.0);
                               NodeShares<Stencils> shares;
                               stencils.forEachNode([&](std::size_t at, Lanes s, const std::array<Lanes, D>& gradient) {
                                 Lanes conducted = gradient[0] * slope[0];
                                 for (std::size_t d = 1; d < D; ++d) conducted += gradient[d] * slope[d];
                                 shares[at] = conducted + s * flux;
                               });
                               addShares(stencils, count, h.heatRate, shares);
                             });
}

/// Equalises the temperatures of the materials at a node: all get the mean weighted by their heat capacities.
template <int D>
void computeHeatExchange(const Patch&, const std::vector<Material>&,
                         const std::vector<NodeView<const double>>& capacity,
                         const std::vector<NodeView<const double>>& temperature, double dt,
                         const std::vector<NodeView<double>>& rate) {
  forEach<D>(capacity.front().box(), [&](const Index<D>& node) {
    double heat = 0, total = 0;
    for (std::size_t m = 0; m < capacity.size(); ++m) {
      heat += capacity[m][node] * temperature[m][node];
      total += capacity[m][node];
    }
    for (std::size_t m = 0; m < capacity.size(); ++m)
      rate[m][node] = total > 0 ? (heat / total - temperature[m][node]) / dt : 0.0;
  });
}

/// Views of the heat that nodes receive in a step.
struct NodalHeating {
  NodeView<const double> capacity, temperatureNoBC, temperature, heatRate;
  /// Rate due to heat exchange [K/s], if materials in contact exchange heat.
  std::optional<NodeView<const double>> contactRate;
  std::optional<NodeView<const double>> frictionHeat;  ///< heat of friction [J], if friction produces heat
  NodeView<double> rate;

  static NodalHeating from(auto& take, bool hasContact, bool hasFriction) {
    return {.capacity = take(requiresNew(g::heatCapacity)),
            .temperatureNoBC = take(requiresNew(g::temperatureNoBC)),
            .temperature = take(requiresNew(g::temperature)),
            .heatRate = take(requiresNew(g::heatRate)),
            .contactRate = take(when(hasContact, requiresNew(g::contactTemperatureRate))),
            .frictionHeat = take(when(hasFriction, requiresNew(g::frictionHeat))),
            .rate = take(computes(g::temperatureRate))};
  }
};

/// Throws NumericalError if the time step is longer than rho c_v h^2 / (2 k), with the smallest cell width h: explicit
/// conduction, with heat capacities lumped at the nodes, is stable up to that. Source: Hughes, The Finite Element
/// Method (1987), chapter 8.
void checkHeatStep(const Level& level, const Material& material, double dt);

/// Computes T*_i = T_i + (Q_i / C_i + contact) dt + H_i / C_i with the heat H_i of friction, or the given temperature
/// on sides of the grid that have one; and dT_i/dt [K/s], the rate of change from T_i to T*_i before boundary
/// conditions.
template <int D>
void integrateTemperatureRate(const Patch& patch, const Material& material, const NodalHeating& h, double dt) {
  checkHeatStep(patch.level(), material, dt);
  forEach<D>(h.capacity.box(), [&](const Index<D>& node) {
    double change = h.capacity[node] > 0 ? h.heatRate[node] / h.capacity[node] : 0.0;
    if (h.contactRate) change += (*h.contactRate)[node];
    if (h.frictionHeat && h.capacity[node] > 0) change += (*h.frictionHeat)[node] / (h.capacity[node] * dt);
    h.rate[node] = h.temperature[node] + change * dt;
  });
  setTemperature<D>(patch, material.index, h.rate);
  forEach<D>(h.capacity.box(),
             [&](const Index<D>& node) { h.rate[node] = (h.rate[node] - h.temperatureNoBC[node]) / dt; });
}

/// Views of the particles whose temperature is updated from the nodes.
template <int D>
struct HeatToParticles {
  Placed<D> particles;
  ParticleView<const double> temperature;
  NodeView<const double> rate;
  ParticleView<double> newTemperature;

  static HeatToParticles from(auto& take, int ghostNodes, KeptSizes keepsSizes) {
    return {.particles = Placed<D>::from(take, keepsSizes, 0, requiresOld(p::deformationMeasure)),
            .temperature = take(requiresOld(p::temperature)),
            .rate = take(requiresNew(g::temperatureRate, ghostNodes)),
            .newTemperature = take(computes(p::temperature))};
  }
};

/// Computes T_p += dt sum_i S_i dT_i/dt.
template <class Shape, int D = Shape::dimension>
void updateTemperature(const Patch& patch, const Material&, const Vec3& commonSize, const HeatToParticles<D>& h,
                       double dt) {
  forEachStencilGroup<Shape>(
      patch, patch.cells(), h.particles, commonSize, [&](int p, int count, const auto& stencils) {
        const auto rate = nodeValues(stencils, h.rate);
        Lanes change = 0.0;
        stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) { change += s * rate[at]; });
        for (int k = 0; k < count; ++k) h.newTemperature[p + k] = h.temperature[p + k] + dt * change[k];
      });
}

/// Changes T_p due to the work of the step, after conduction.
inline void addWorkOfStep(const Patch&, const Material&, ParticleView<const double> change,
                          ParticleView<double> temperature) {
  for (int p = 0; p < change.owned(); ++p) temperature[p] += change[p];
}
/// Changes T_p due to the work of the step, without conduction.
inline void heatByWorkOfStep(const Patch&, const Material&, ParticleView<const double> change,
                             ParticleView<const double> oldTemperature, ParticleView<double> temperature) {
  for (int p = 0; p < change.owned(); ++p) temperature[p] = oldTemperature[p] + change[p];
}

/// Heats the particles by the work of the step, unless this has been done together with conduction.
inline void scheduleHeatOfWork(TaskList& tasks, const std::vector<Material>& materials, bool conductsHeat) {
  if (conductsHeat)
    tasks.perMaterial("mpm::finalParticleUpdate", addWorkOfStep, materials, requiresNew(p::temperatureChange),
                      modifies(p::temperature));
  else
    tasks.perMaterial("mpm::finalParticleUpdate", heatByWorkOfStep, materials, requiresNew(p::temperatureChange),
                      requiresOld(p::temperature), computes(p::temperature));
}

}  // namespace tushar::mpm::solid
