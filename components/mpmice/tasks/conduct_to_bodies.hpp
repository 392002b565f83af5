#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/tasks/add_diffusion.hpp"

namespace tushar::mpmice {

/// Views of the heat capacity and the temperature of those bodies in a cell that exchange heat with the gas.
struct BodyHeat {
  CellView<double> capacity, temperature;

  static BodyHeat from(auto& take) {
    return {.capacity = take(computes(c::bodyCapacity)), .temperature = take(computes(c::bodyTemperature))};
  }
};
struct KnownBodyHeat {
  CellView<const double> capacity, temperature;

  static KnownBodyHeat from(auto& take) {
    return {.capacity = take(requiresNew(c::bodyCapacity, 1)), .temperature = take(requiresNew(c::bodyTemperature, 1))};
  }
};
/// Views of the particles at the start of a step, ordered by the cell in which they are.
struct HeatOfParticles {
  ParticleView<const double> mass, temperature;

  static HeatOfParticles from(auto& take) {
    return {.mass = take(requiresOld(p::mass)), .temperature = take(requiresOld(p::temperature))};
  }
};

/// Whether a body exchanges heat with a gas, that is, whether one of its coefficients with the gases is positive. They
/// are the last ones in the body's row, which contains its pairs with all materials after it.
inline bool warmsGas(const Settings& settings, std::size_t body, std::size_t bodies) {
  if (settings.heat.byMasses) return true;
  if (!settings.heat.act()) return false;
  const std::size_t gases = std::max<std::size_t>(1, settings.gases.size());
  std::size_t end = 0;
  for (std::size_t row = 0; row <= body; ++row) end += bodies + gases - row - 1;
  const auto first = settings.heat.pairs.begin();
  return std::any_of(first + static_cast<std::ptrdiff_t>(end - gases), first + static_cast<std::ptrdiff_t>(end),
                     [](double h) { return h > 0; });
}

/// Computes the heat capacity [J/(m³ K)] and the temperature [K] of the bodies in each cell.
template <int D>
void measureBodyHeat(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                     const std::vector<HeatOfParticles>& bodies, const BodyHeat& found) {
  const double inverse = 1 / patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    double capacity = 0, heat = 0;
    for (std::size_t m = 0; m < bodies.size(); ++m) {
      if (!warmsGas(settings, m, bodies.size())) continue;
      for (const int p : bodies[m].mass.template in<D>(cell)) {
        const double own = bodies[m].mass[p] * materials[m].specificHeat * inverse;
        capacity += own;
        heat += own * bodies[m].temperature[p];
      }
    }
    found.capacity[cell] = capacity;
    found.temperature[cell] = capacity > 0 ? heat / capacity : 0;
  });
}

/// Computes the heat that the gas conducts to bodies through walls, k A dT / d, given the state at the start of the
/// step. The bodies at a face are those in the cells on both sides.
template <int D>
class WallHeat {
 public:
  WallHeat(const Level& level, const Settings& settings, const GasInCells<D>& cells, const KnownBodyHeat& bodies,
           double dt)
      : level_(level), settings_(settings), cells_(cells), space_(level, settings, cells), bodies_(bodies), dt_(dt) {}

  /// Heat that the gas of a cell loses in the step, per cell volume [J/m³].
  double given(const Index<D>& cell) const {
    double sum = 0;
    for (int a = 0; a < D; ++a)
      for (int side = 0; side < 2; ++side) sum += through(cell, a, side);
    return sum;
  }
  /// The heat that the bodies of a cell receive. The heat through each face of the cell is divided between the bodies
  /// on both sides, in proportion to their heat capacities.
  double taken(const Index<D>& cell) const {
    double sum = 0;
    for (int a = 0; a < D; ++a)
      for (int side = 0; side < 2; ++side) {
        double heat = through(cell, a, side);
        const auto next = neighbour(cell, a, side);
        if (next) heat += through(*next, a, 1 - side);
        if (heat != 0) sum += heat * bodies_.capacity[cell] / capacityAt(cell, next);
      }
    return sum;
  }

 private:
  std::optional<Index<D>> neighbour(const Index<D>& cell, int axis, int side) const {
    if (space_.isAtSide(cell, axis, side)) return {};
    return side == 0 ? cell - Index<D>::unit(axis) : cell + Index<D>::unit(axis);
  }
  double capacityAt(const Index<D>& cell, const std::optional<Index<D>>& next) const {
    return bodies_.capacity[cell] + (next ? bodies_.capacity[*next] : 0);
  }
  /// Heat from the gas of a cell through its wall at a face, limited so that neither gas nor bodies pass their common
  /// temperature.
  double through(const Index<D>& cell, int axis, int side) const {
    if (space_.isEmpty(cell)) return 0;
    const double wall = space_.faces(cell, axis).wall(side);
    if (!(wall > 0)) return 0;
    const auto next = neighbour(cell, axis, side);
    const double capacity = capacityAt(cell, next);
    if (!(capacity > 0)) return 0;
    double heat = bodies_.capacity[cell] * bodies_.temperature[cell];
    if (next) heat += bodies_.capacity[*next] * bodies_.temperature[*next];
    const euler::DiffusingCell<D> gas = diffusingAt<D>(level_, settings_, cells_, cell);
    const double difference = gas.w[euler::kTemperature] - heat / capacity;
    const double perWidth = level_.inverseSpacing(axis), layer = layerOf(cells_.free[cell]);
    const double flow = dt_ * gas.how.conductivity * wall * perWidth * perWidth / (0.5 * layer);
    const double ofGas = gas.density * layer * gas.specificHeat;
    return std::min(flow, 1 / (1 / ofGas + 2 * D / capacity)) * difference;
  }

  const Level& level_;
  const Settings& settings_;
  const GasInCells<D>& cells_;
  FreeSpace<D> space_;
  const KnownBodyHeat& bodies_;
  double dt_;
};

/// Subtracts from the gas the heat that it conducts to bodies; to be called before small cells are merged.
template <int D>
void conductFromGas(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                    const KnownBodyHeat& bodies, double dt, CellView<double> totalEnergy, CellView<double> heat) {
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  const WallHeat<D> walls(patch.level(), settings, cells, bodies, dt);
  heat.fill(0);
  near.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    heat[cell] = walls.given(cell);
    totalEnergy[cell] -= heat[cell];
  });
}

/// Adds the heat conducted through walls to the particles of the cells on both sides.
template <int D>
void conductToBodies(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                     const GasInCells<D>& cells, const KnownBodyHeat& heat, double dt,
                     const std::vector<ParticleView<double>>& temperatures) {
  const WallHeat<D> walls(patch.level(), settings, cells, heat, dt);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!(heat.capacity[cell] > 0)) return;
    const double taken = walls.taken(cell);
    if (taken == 0) return;
    const double change = taken / heat.capacity[cell];
    for (std::size_t m = 0; m < temperatures.size(); ++m)
      if (warmsGas(settings, m, temperatures.size()))
        for (const int p : temperatures[m].template in<D>(cell)) temperatures[m][p] += change;
  });
}

}  // namespace tushar::mpmice
