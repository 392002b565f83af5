#pragma once

#include <Eigen/LU>

#include <vector>

#include "components/mpm/solid/constitutive/tensor_lanes.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/tasks/subgrid_heat.hpp"
#include "components/mpm/solid/transfer/stencil_groups.hpp"
#include "core/base/function_ref.hpp"

namespace tushar::mpm::solid {

/// Calls `visit(nodes, temperature)` for the nodes of a patch on and beyond sides with a given temperature [K]
/// (Dirichlet). Other sides are insulated: no heat flows through them.
void forEachGivenTemperature(const Patch& patch, int material, FunctionRef<void(const Box&, double)> visit);

/// Sets a field to the given temperatures of sides.
template <int D>
void setTemperature(const Patch& patch, int material, NodeView<double> field) {
  forEachGivenTemperature(patch, material, [&](const Box& nodes, double given) {
    forEach<D>(nodes, [&](const Index<D>& node) { field[node] = given; });
  });
}

/// Views of the particles whose heat is transferred to the nodes.
template <int D>
struct HeatToNodes {
  ThermalParticles<D> particles;
  NodeView<double> capacity, temperatureNoBC, temperature;
  std::optional<NodeView<double>> isGiven;  ///< 1 at nodes with a given temperature, if there are any

  static HeatToNodes from(auto& take, int reach, KeptSizes keepsSizes, bool isAnyGiven) {
    return {.particles = ThermalParticles<D>::from(take, reach, keepsSizes),
            .capacity = take(computes(g::heatCapacity)),
            .temperatureNoBC = take(computes(g::temperatureNoBC)),
            .temperature = take(computes(g::temperature)),
            .isGiven = take(when(isAnyGiven, computes(g::hasGivenTemperature)))};
  }
};

/// Computes C_i = sum_p S_i m_p c_v,   T_i = sum_p S_i m_p c_v T_p / C_i; 0 at nodes without mass.
template <class Shape, int D = Shape::dimension>
void interpolateTemperatureToGrid(const Patch& patch, const Material& material, const Vec3& commonSize,
                                  const HeatToNodes<D>& h) {
  h.capacity.fill(0.0);
  h.temperatureNoBC.fill(0.0);
  const Box& box = h.capacity.box();
  forEachStencilGroup<Shape>(patch, h.particles.placed.x.cells(), h.particles.placed, commonSize,
                             [&]<class Stencils>(int p, int count, const Stencils& stencils) {
                               const Lanes heat = valuesOf(h.particles.mass, p, count) * material.specificHeat;
                               const Lanes temperature = valuesOf(h.particles.temperature, p, count);
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
  if (!h.isGiven) return;
  h.isGiven->fill(0.0);
  forEachGivenTemperature(patch, material.index, [&](const Box& nodes, double) {
    forEach<D>(nodes, [&](const Index<D>& node) { (*h.isGiven)[node] = 1; });
  });
}

/// Views of the particles near nodes with a given temperature.
template <int D>
struct NearGivenTemperature {
  ThermalParticles<D> particles;
  NodeView<const double> temperature, isGiven;
  NodeView<double> change;

  static NearGivenTemperature from(auto& take, const ShapeTraits& shape, KeptSizes keepsSizes) {
    const int reach = shape.reach, nodes = reach + shape.ghostNodes;
    return {.particles = ThermalParticles<D>::from(take, reach, keepsSizes),
            .temperature = take(requiresNew(g::temperature, nodes)),
            .isGiven = take(requiresNew(g::hasGivenTemperature, nodes)),
            .change = take(computes(g::givenTemperatureChange))};
  }
};

/// Computes the changes of given nodal temperatures with which particles follow the field T(x) = sum_j S_j T_j, which
/// has the given temperatures G: Delta_i = sum_p S_i m_p (T(x_p) - T_p) / sum_p (S_i m_p sum_{j in G} S_j); 0 at other
/// nodes. If the particles have this field, nothing changes. (If instead the mean of the particles at the node became
/// the given temperature, particles would overshoot, by as much as the field varies within a cell.)
template <class Shape, int D = Shape::dimension>
void followGivenTemperature(const Patch& patch, const Material&, const Vec3& commonSize,
                            const NearGivenTemperature<D>& h) {
  const Box& box = h.change.box();
  std::vector<double> sums(static_cast<std::size_t>(box.size()), 0.0);
  const NodeView<double> weight(sums.data(), box);
  h.change.fill(0.0);
  forEachStencilGroup<Shape>(
      patch, h.particles.placed.x.cells(), h.particles.placed, commonSize,
      [&]<class Stencils>(int p, int count, const Stencils& stencils) {
        const Lanes share = fieldAt(stencils, h.isGiven);
        bool isNear = false;
        for (int k = 0; k < count; ++k) isNear |= share[k] > 0;
        if (!isNear) return;
        const Lanes mass = valuesOf(h.particles.mass, p, count);
        const Lanes gap = mass * (fieldAt(stencils, h.temperature) - valuesOf(h.particles.temperature, p, count));
        NodeShares<Stencils> gaps, weights;
        stencils.forEachNode([&](std::size_t at, Lanes s, const auto&) {
          gaps[at] = s * gap;
          weights[at] = s * (mass * share);
        });
        addShares(stencils, count, h.change, gaps);
        addShares(stencils, count, weight, weights);
      });
  forEach<D>(box, [&](const Index<D>& node) {
    h.change[node] = h.isGiven[node] > 0 && weight[node] > 0 ? h.change[node] / weight[node] : 0.0;
  });
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

/// The indices of the materials that conduct heat.
inline std::vector<std::size_t> conductors(const std::vector<Material>& materials) {
  std::vector<std::size_t> conducting;
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (materials[m].thermalConductivity > 0) conducting.push_back(m);
  return conducting;
}

/// Gives the materials at a node that conduct heat one temperature before they do so: the mean weighted by their heat
/// capacities. So two bodies that touch conduct as one.
template <int D>
void shareTemperature(const Patch&, const std::vector<Material>& materials,
                      const std::vector<NodeView<const double>>& capacity,
                      const std::vector<NodeView<double>>& temperatureNoBC,
                      const std::vector<NodeView<double>>& temperature) {
  const std::vector<std::size_t> conducting = conductors(materials);
  const auto equalise = [&](const std::vector<NodeView<double>>& field, const Index<D>& node) {
    double heat = 0, total = 0;
    for (const std::size_t m : conducting) {
      heat += capacity[m][node] * field[m][node];
      total += capacity[m][node];
    }
    for (const std::size_t m : conducting)
      if (capacity[m][node] > 0 && capacity[m][node] < total) field[m][node] = heat / total;
  };
  forEach<D>(capacity.front().box(), [&](const Index<D>& node) {
    equalise(temperatureNoBC, node);
    equalise(temperature, node);
  });
}

/// Views of the heat of a material at nodes.
struct HeatOfMaterial {
  NodeView<const double> capacity, heatRate, subgridChange;
  std::optional<NodeView<const double>> frictionHeat;  ///< heat of friction [J], if friction produces heat

  static HeatOfMaterial from(auto& take, bool hasFriction) {
    return {.capacity = take(requiresNew(g::heatCapacity)),
            .heatRate = take(requiresNew(g::heatRate)),
            .subgridChange = take(requiresNew(g::subgridTemperatureChange)),
            .frictionHeat = take(when(hasFriction, requiresNew(g::frictionHeat)))};
  }
  /// The heat that the material gains in a step [J], without what its particles conduct within cells.
  template <int D>
  double gain(const Index<D>& node, double dt) const {
    const double friction = frictionHeat ? (*frictionHeat)[node] : 0.0;
    return heatRate[node] * dt + friction - capacity[node] * subgridChange[node];
  }
};

/// Computes the rates [K/s] with which materials that conduct and share a node exchange the heat that they gain in a
/// step, so that their temperatures change alike. (Uintah equalises temperatures by changing those of particles: a bar
/// that is cut in two then has a wrong steady temperature, the more so the shorter the steps.)
template <int D>
void computeHeatExchange(const Patch&, const std::vector<Material>& materials, const std::vector<HeatOfMaterial>& of,
                         double dt, const std::vector<NodeView<double>>& rate) {
  const std::vector<std::size_t> conducting = conductors(materials);
  for (const NodeView<double>& one : rate) one.fill(0.0);
  forEach<D>(rate.front().box(), [&](const Index<D>& node) {
    double heat = 0, total = 0;
    for (const std::size_t m : conducting) {
      if (of[m].capacity[node] > 0) heat += of[m].template gain<D>(node, dt);
      total += of[m].capacity[node];
    }
    for (const std::size_t m : conducting)
      if (const double own = of[m].capacity[node]; own > 0 && own < total)
        rate[m][node] = (heat / total - of[m].template gain<D>(node, dt) / own) / dt;
  });
}

/// Views of the heat that nodes receive in a step.
struct NodalHeating {
  NodeView<const double> capacity, temperatureNoBC, temperature, heatRate;
  /// Rate due to heat exchange [K/s], if materials in contact exchange heat.
  std::optional<NodeView<const double>> contactRate;
  std::optional<NodeView<const double>> frictionHeat;  ///< heat of friction [J], if friction produces heat
  std::optional<NodeView<const double>> givenChange;   ///< see followGivenTemperature; if temperatures are given
  NodeView<const double> subgridChange;                ///< see computeSubgridHeat
  NodeView<double> rate;

  static NodalHeating from(auto& take, bool hasContact, bool hasFriction, bool isAnyGiven) {
    return {.capacity = take(requiresNew(g::heatCapacity)),
            .temperatureNoBC = take(requiresNew(g::temperatureNoBC)),
            .temperature = take(requiresNew(g::temperature)),
            .heatRate = take(requiresNew(g::heatRate)),
            .contactRate = take(when(hasContact, requiresNew(g::contactTemperatureRate))),
            .frictionHeat = take(when(hasFriction, requiresNew(g::frictionHeat))),
            .givenChange = take(when(isAnyGiven, requiresNew(g::givenTemperatureChange))),
            .subgridChange = take(requiresNew(g::subgridTemperatureChange)),
            .rate = take(computes(g::temperatureRate))};
  }
};

/// Throws NumericalError if the time step is longer than rho c_v h^2 / (2 k), with the smallest cell width h: explicit
/// conduction, with heat capacities lumped at the nodes, is stable up to that. Source: Hughes, The Finite Element
/// Method (1987), chapter 8.
void checkHeatStep(const Level& level, const Material& material, double dt);

/// Computes dT_i/dt [K/s], the rate of change from the temperature without boundary conditions to T*_i = T_i + (Q_i /
/// C_i + contact) dt + H_i / C_i with the heat H_i of friction, minus the change that conduction within cells gives the
/// particles. At nodes with a given temperature, it is the change that followGivenTemperature computes, per dt, without
/// the share of the gap that conduction within cells closes.
template <int D>
void integrateTemperatureRate(const Patch& patch, const Material& material, const NodalHeating& h, double dt) {
  checkHeatStep(patch.level(), material, dt);
  forEach<D>(h.capacity.box(), [&](const Index<D>& node) {
    double change = h.capacity[node] > 0 ? h.heatRate[node] / h.capacity[node] : 0.0;
    if (h.contactRate) change += (*h.contactRate)[node];
    if (h.frictionHeat && h.capacity[node] > 0) change += (*h.frictionHeat)[node] / (h.capacity[node] * dt);
    h.rate[node] = h.temperature[node] + change * dt;
  });
  forEach<D>(h.capacity.box(), [&](const Index<D>& node) {
    h.rate[node] = (h.rate[node] - h.temperatureNoBC[node] - h.subgridChange[node]) / dt;
  });
  if (!h.givenChange) return;
  const double left = 1 - subgridShare<D>(patch.level(), material, dt);
  forEachGivenTemperature(patch, material.index, [&](const Box& nodes, double) {
    forEach<D>(nodes, [&](const Index<D>& node) { h.rate[node] = left * (*h.givenChange)[node] / dt; });
  });
}

/// Views of the particles whose temperature is updated from the nodes.
template <int D>
struct HeatToParticles {
  Placed<D> particles;
  ParticleView<const double> temperature;
  NodeView<const double> rate;
  /// Temperatures of the nodes at the start of the step, if particles conduct heat within cells.
  std::optional<NodeView<const double>> field;
  ParticleView<double> newTemperature;

  static HeatToParticles from(auto& take, int ghostNodes, KeptSizes keepsSizes, bool conductsInCells) {
    return {.particles = Placed<D>::from(take, keepsSizes, 0, requiresOld(p::deformationMeasure)),
            .temperature = take(requiresOld(p::temperature)),
            .rate = take(requiresNew(g::temperatureRate, ghostNodes)),
            .field = take(when(conductsInCells, requiresNew(g::temperature, ghostNodes))),
            .newTemperature = take(computes(p::temperature))};
  }
};

/// Computes T_p += dt sum_i S_i dT_i/dt + share (sum_i S_i T_i - T_p), with the share of conduction within cells (see
/// subgrid_heat.hpp), if particles conduct.
template <class Shape, int D = Shape::dimension>
void updateTemperature(const Patch& patch, const Material& material, const Vec3& commonSize,
                       const HeatToParticles<D>& h, double dt) {
  const double share = h.field ? subgridShare<D>(patch.level(), material, dt) : 0;
  forEachStencilGroup<Shape>(patch, patch.cells(), h.particles, commonSize,
                             [&](int p, int count, const auto& stencils) {
                               Lanes change = dt * fieldAt(stencils, h.rate);
                               if (share > 0)
                                 change += share * (fieldAt(stencils, *h.field) - valuesOf(h.temperature, p, count));
                               for (int k = 0; k < count; ++k)
                                 h.newTemperature[p + k] = h.temperature[p + k] + change[k];
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
