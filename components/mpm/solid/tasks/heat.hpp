#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/tasks/extent.hpp"

namespace tushar::mpm::solid {

/// A temperature is given on a side of the grid (Dirichlet), or what it falls by per metre outwards (Neumann).
template <int D>
void setTemperature(const Patch& patch, int material, NodeView<double> field) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      const grid::BoundaryCondition* condition = patch.level().boundary(d, side, "Temperature", material);
      if (!condition || !patch.isAtBoundary(d, side)) continue;
      const Index<D> inwards = side == 0 ? Index<D>::unit(d) : Index<D>{} - Index<D>::unit(d);
      const double value = condition->value[0], drop = value * patch.level().spacing(d);
      for (const Box& nodes : {patch.faceNodes(d, side), patch.nodesBeyond(d, side)})
        forEach<D>(nodes, [&](const Index<D>& node) {
          field[node] = condition->kind == "Dirichlet" ? value : field[node + inwards] - drop;
        });
    }
}

/// T_i = sum_p S_i m_p T_p / m_i
template <class Shape, int D = Shape::dimension>
void interpolateTemperatureToGrid(const Patch& patch, const Material& material, ParticleView<const Vec<D>> x,
                                  SizeView<Shape> size, DeformationView<Shape> deformation,
                                  ParticleView<const double> particleMass, ParticleView<const double> particleTemperature,
                                  NodeView<const double> mass, NodeView<double> temperatureNoBC,
                                  NodeView<double> temperature) {
  temperatureNoBC.fill(0.0);
  const Box& box = mass.box();
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    const double product = particleMass[p] * particleTemperature[p];
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&, auto...) {
      if (box.contains(node)) temperatureNoBC[node] += s * product;
    });
  });
  forEach<D>(box, [&](const Index<D>& node) {
    if (mass[node] > 0) temperatureNoBC[node] /= mass[node];
    temperature[node] = temperatureNoBC[node];
  });
  setTemperature<D>(patch, material.index, temperature);
}

/// Q_i = - sum_p V_p k grad S_i . grad T_p
template <class Shape, int D = Shape::dimension>
void computeInternalHeatRate(const Patch& patch, const Material& material, ParticleView<const Vec<D>> x,
                             SizeView<Shape> size, DeformationView<Shape> deformation,
                             ParticleView<const double> volume, NodeView<const double> temperature,
                             NodeView<double> heatRate) {
  heatRate.fill(0.0);
  const Box& box = heatRate.box();
  if (material.thermalConductivity == 0) return;
  forEachStencil<Shape>(patch, x.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    Vec<D> slope = Vec<D>::Zero();
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& gradient, auto...) {
      slope += temperature[node] * gradient;
    });
    slope *= -material.thermalConductivity * volume[p];
    stencil.forEachNode([&](const Index<D>& node, double, const Vec<D>& gradient, auto...) {
      if (box.contains(node)) heatRate[node] += gradient.dot(slope);
    });
  });
}

/// Materials that share a node take one temperature there, the mean over their heat capacities.
template <int D>
void computeHeatExchange(const Patch&, const std::vector<Material>& materials,
                         const std::vector<NodeView<const double>>& mass,
                         const std::vector<NodeView<const double>>& temperature, double dt,
                         const std::vector<NodeView<double>>& rate) {
  forEach<D>(mass.front().box(), [&](const Index<D>& node) {
    double heat = 0, capacity = 0;
    for (std::size_t m = 0; m < mass.size(); ++m) {
      const double share = mass[m][node] * materials[m].specificHeat;
      heat += share * temperature[m][node];
      capacity += share;
    }
    for (std::size_t m = 0; m < mass.size(); ++m)
      rate[m][node] = capacity > 0 ? (heat / capacity - temperature[m][node]) / dt : 0.0;
  });
}

/// T*_i = T_i + (Q_i / (m_i c_v) + contact) dt on the sides of the grid as given there, and the rate that comes of it.
template <int D, bool Touching>
void integrateTemperatureRate(const Patch& patch, const Material& material, NodeView<const double> mass,
                              NodeView<const double> temperatureNoBC, NodeView<const double> temperature,
                              NodeView<const double> heatRate,
                              Optional<Touching, NodeView<const double>> contactRate, double dt,
                              NodeView<double> rate) {
  forEach<D>(mass.box(), [&](const Index<D>& node) {
    const double capacity = mass[node] * material.specificHeat;
    double change = capacity > 0 ? heatRate[node] / capacity : 0.0;
    if constexpr (Touching) change += contactRate[node];
    rate[node] = temperature[node] + change * dt;
  });
  setTemperature<D>(patch, material.index, rate);
  forEach<D>(mass.box(), [&](const Index<D>& node) { rate[node] = (rate[node] - temperatureNoBC[node]) / dt; });
}

/// T_p += dt sum_i S_i dT_i/dt
template <class Shape, int D = Shape::dimension>
void updateTemperature(const Patch& patch, const Material&, ParticleView<const Vec<D>> x, SizeView<Shape> size,
                       DeformationView<Shape> deformation, ParticleView<const double> temperature,
                       NodeView<const double> rate, double dt, ParticleView<double> newTemperature) {
  forEachStencil<Shape>(patch, patch.cells(), x, size, deformation, [&](int p, const auto& stencil) {
    double change = 0;
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&, auto...) { change += s * rate[node]; });
    newTemperature[p] = temperature[p] + dt * change;
  });
}

}  // namespace tushar::mpm::solid
