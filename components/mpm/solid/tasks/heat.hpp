#pragma once

#include "components/mpm/boundary_labels.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpm/solid/transfer/extent.hpp"

namespace tushar::mpm::solid {

/// A temperature is given on a side of the grid (Dirichlet), or what it falls by per metre outwards (Neumann).
template <int D>
void setTemperature(const Patch& patch, int material, NodeView<double> field) {
  for (int d = 0; d < D; ++d)
    for (const int side : {0, 1}) {
      const auto given = patch.level().boundary(d, side, boundary::temperature, material);
      if (!given || !patch.isAtBoundary(d, side)) continue;
      const Index<D> inwards = side == 0 ? Index<D>::unit(d) : Index<D>{} - Index<D>::unit(d);
      const double value = given->value, drop = value * patch.level().spacing(d);
      for (const Box& nodes : {patch.faceNodes(d, side), patch.nodesBeyond(d, side)})
        forEach<D>(nodes, [&](const Index<D>& node) {
          field[node] = given->isDirichlet() ? value : field[node + inwards] - drop;
        });
    }
}

/// Where the particles of a material are, and what its shape functions ask of them.
template <class Shape>
struct Places {
  const Patch& patch;
  ParticleView<const Vec<Shape::dimension>> x;
  Extents<Shape> extents;

  /// Calls `visit(p, stencil)` for each particle of `cells`.
  template <class Visit>
  void forEachStencil(const Box& cells, Visit&& visit) const {
    solid::forEachStencil<Shape>(patch, cells, x, extents, visit);
  }
};

/// C_i = sum_p S_i m_p c_v,   T_i = sum_p S_i m_p c_v T_p / C_i; 0 where there is no mass.
template <class Shape, int D = Shape::dimension>
void interpolateTemperatureToGrid(const Patch& patch, const Material& material, const Vec3& commonSize,
                                  ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                                  ParticleView<const Matrix3> deformation, ParticleView<const double> mass,
                                  ParticleView<const double> particleTemperature, NodeView<double> capacity,
                                  NodeView<double> temperatureNoBC, NodeView<double> temperature) {
  capacity.fill(0.0);
  temperatureNoBC.fill(0.0);
  const Box& box = capacity.box();
  const Places<Shape> places{patch, x, Extents<Shape>(patch.level(), commonSize, size, deformation)};
  places.forEachStencil(x.cells(), [&](int p, const auto& stencil) {
    const double heat = mass[p] * material.specificHeat;
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) {
      if (!box.contains(node)) return;
      capacity[node] += s * heat;
      temperatureNoBC[node] += s * heat * particleTemperature[p];
    });
  });
  forEach<D>(box, [&](const Index<D>& node) {
    if (capacity[node] > 0) temperatureNoBC[node] /= capacity[node];
    temperature[node] = temperatureNoBC[node];
  });
  setTemperature<D>(patch, material.index, temperature);
}

/// Q_i = sum_p S_i H_p - V_p k grad S_i . grad T_p with the heat H_p of loads, if there are any
template <class Shape, int D = Shape::dimension>
void computeInternalHeatRate(const Patch& patch, const Material& material, const Vec3& commonSize,
                             ParticleView<const Vec<D>> x, OptionalView<const Vec<D>> size,
                             ParticleView<const Matrix3> deformation, ParticleView<const double> mass,
                             OptionalView<const double> heatFlux, NodeView<const double> temperature,
                             NodeView<double> heatRate) {
  heatRate.fill(0.0);
  const Box& box = heatRate.box();
  if (material.thermalConductivity == 0 && !heatFlux) return;
  const Places<Shape> places{patch, x, Extents<Shape>(patch.level(), commonSize, size, deformation)};
  places.forEachStencil(x.cells(), [&](int p, const auto& stencil) {
    Vec<D> slope = Vec<D>::Zero();
    stencil.forEachNode(
        [&](const Index<D>& node, double, const Vec<D>& gradient) { slope += temperature[node] * gradient; });
    const double volume = mass[p] / material.density * deformation[p].determinant();
    slope *= -material.thermalConductivity * volume;
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>& gradient) {
      if (box.contains(node)) heatRate[node] += gradient.dot(slope) + (heatFlux ? s * (*heatFlux)[p] : 0.0);
    });
  });
}

/// Materials that share a node take one temperature there, the mean over their heat capacities.
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

/// T*_i = T_i + (Q_i / C_i + contact) dt + H_i / C_i with the heat H_i of rubbing, on the sides of the grid as given
/// there, and the rate that comes of it.
template <int D>
void integrateTemperatureRate(const Patch& patch, const Material& material, NodeView<const double> capacity,
                              NodeView<const double> temperatureNoBC, NodeView<const double> temperature,
                              NodeView<const double> heatRate, std::optional<NodeView<const double>> contactRate,
                              std::optional<NodeView<const double>> frictionHeat, double dt, NodeView<double> rate) {
  forEach<D>(capacity.box(), [&](const Index<D>& node) {
    double change = capacity[node] > 0 ? heatRate[node] / capacity[node] : 0.0;
    if (contactRate) change += (*contactRate)[node];
    if (frictionHeat && capacity[node] > 0) change += (*frictionHeat)[node] / (capacity[node] * dt);
    rate[node] = temperature[node] + change * dt;
  });
  setTemperature<D>(patch, material.index, rate);
  forEach<D>(capacity.box(), [&](const Index<D>& node) { rate[node] = (rate[node] - temperatureNoBC[node]) / dt; });
}

/// T_p += dt sum_i S_i dT_i/dt
template <class Shape, int D = Shape::dimension>
void updateTemperature(const Patch& patch, const Material&, const Vec3& commonSize, ParticleView<const Vec<D>> x,
                       OptionalView<const Vec<D>> size, ParticleView<const Matrix3> deformation,
                       ParticleView<const double> temperature, NodeView<const double> rate, double dt,
                       ParticleView<double> newTemperature) {
  const Places<Shape> places{patch, x, Extents<Shape>(patch.level(), commonSize, size, deformation)};
  places.forEachStencil(patch.cells(), [&](int p, const auto& stencil) {
    double change = 0;
    stencil.forEachNode([&](const Index<D>& node, double s, const Vec<D>&) { change += s * rate[node]; });
    newTemperature[p] = temperature[p] + dt * change;
  });
}

/// Adds what the work of the step does to the temperature, where heat is conducted, too.
inline void addWorkOfStep(const Patch&, const Material&, ParticleView<const double> change,
                          ParticleView<double> temperature) {
  for (int p = 0; p < change.owned(); ++p) temperature[p] += change[p];
}
/// The same where nothing else changes the temperature.
inline void heatByWorkOfStep(const Patch&, const Material&, ParticleView<const double> change,
                             ParticleView<const double> oldTemperature, ParticleView<double> temperature) {
  for (int p = 0; p < change.owned(); ++p) temperature[p] = oldTemperature[p] + change[p];
}

}  // namespace tushar::mpm::solid
