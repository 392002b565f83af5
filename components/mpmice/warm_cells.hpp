#pragma once

#include "components/ice/mixture/exchange_heat.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Views of a body in cells: of its particles, each cell has the parts of their boxes that are in it.
struct WarmBody {
  CellView<const double> capacity, temperature, volume;

  static WarmBody from(auto& take, int ghost) {
    return {.capacity = take(requiresNew(c::capacityOfBody, ghost)),
            .temperature = take(requiresNew(c::temperatureOfBody, ghost)),
            .volume = take(requiresNew(c::volumeOfBody, ghost))};
  }
};

/// Views of the gas after a step: of its energy and, for several gases, of their volume fractions, which are const for
/// tasks that only read them.
template <int D, class T = double>
struct WarmGas {
  CellView<const double> free, density;
  CellView<const Vec<D>> momentum;
  CellView<T> totalEnergy;
  std::vector<CellView<const double>> masses;
  std::vector<CellView<T>> shares;

  /// `ghost` is 0 unless T is const; `room` is the number of ghost cells of the free volume, if that is more.
  static WarmGas from(auto& take, std::size_t gases, int ghost = 0, int room = 0) {
    const auto changed = [&](const auto& label) {
      if constexpr (std::is_const_v<T>)
        return requiresNew(label, ghost);
      else
        return modifies(label);
    };
    return {.free = take(requiresNew(c::freeVolume, std::max(ghost, room))),
            .density = take(requiresNew(c::density, ghost)),
            .momentum = take(requiresNew(c::momentum<D>, ghost)),
            .totalEnergy = take(changed(c::totalEnergy)),
            .masses = viewsOfGases(take, gases, [&](std::size_t k) { return requiresNew(c::massOfGas[k], ghost); }),
            .shares = viewsOfGases(take, gases, [&](std::size_t k) { return changed(c::shareOfGas[k]); })};
  }
};

/// What takes part in the heat exchange in cells: first the bodies in their order, then the gases. `Most` is the
/// largest total number of bodies and gases, `Gas` the views of the gas.
template <int D, int Most, class Gas>
class WarmCells {
 public:
  WarmCells(const std::vector<mpm::solid::Material>& materials, const Settings& settings, const Gas& gas,
            const std::vector<WarmBody>& bodies)
      : materials_(materials), settings_(settings), gas_(gas), bodies_(bodies) {}

  /// The bodies and gases of a cell.
  ice::WarmThings<Most> at(const Index<D>& cell) const {
    ice::WarmThings<Most> things(static_cast<Eigen::Index>(bodies_.size() + gases()));
    addBodies(cell, things);
    if (gas_.free[cell] >= leastFreeVolume && gas_.density[cell] > 0) addGas(cell, things);
    return things;
  }
  Eigen::Index bodies() const { return static_cast<Eigen::Index>(bodies_.size()); }
  std::size_t gases() const { return std::max<std::size_t>(1, settings_.gases.size()); }
  /// The body that fills more than half of a cell, if there is one; otherwise -1.
  Eigen::Index bodyThatFills(const Index<D>& cell) const {
    double filled = 0;
    for (const WarmBody& body : bodies_) filled += body.volume[cell];
    for (std::size_t m = 0; m < bodies_.size(); ++m)
      if ((1 - gas_.free[cell]) * (bodies_[m].volume[cell] / filled) > 0.5) return static_cast<Eigen::Index>(m);
    return -1;
  }
  bool hasBody(const Index<D>& cell) const {
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const WarmBody& body) { return body.capacity[cell] > 0; });
  }

 private:
  /// Bodies share what the gas leaves of the cell in proportion to what their boxes fill.
  void addBodies(const Index<D>& cell, ice::WarmThings<Most>& things) const {
    double filled = 0;
    for (const WarmBody& body : bodies_) filled += body.volume[cell];
    for (std::size_t m = 0; m < bodies_.size(); ++m) {
      if (!(bodies_[m].capacity[cell] > 0)) continue;
      things.capacity[m] = bodies_[m].capacity[cell];
      things.mass[m] = things.capacity[m] / materials_[m].specificHeat;
      things.temperature[m] = bodies_[m].temperature[cell];
      if (filled > 0) things.volume[m] = (1 - gas_.free[cell]) * (bodies_[m].volume[cell] / filled);
    }
  }
  void addGas(const Index<D>& cell, ice::WarmThings<Most>& things) const {
    const double free = gas_.free[cell], mass = gas_.density[cell];
    const double internal = gas_.totalEnergy[cell] - 0.5 * gas_.momentum[cell].squaredNorm() / mass;
    if (areBlended(settings_)) return addBlend(cell, internal, things);
    if (!settings_.gases.empty()) {
      euler::MixedGas mixed;
      for (std::size_t k = 0; k < settings_.gases.size(); ++k)
        mixed.add(gas_.shares[k][cell], settings_.gases[k].gas.gamma, settings_.gases[k].gas.pInfinity);
      const double pressure = mixed.pressure(mass / free, internal / free);
      for (std::size_t k = 0; k < settings_.gases.size(); ++k)
        if (gas_.masses[k][cell] > ice::leastPartOfMass * mass)
          things.setGas(bodies() + static_cast<Eigen::Index>(k), settings_.gases[k].gas, gas_.masses[k][cell],
                        free * gas_.shares[k][cell], pressure);
      return;
    }
    const euler::Gas& gas = settings_.gas.gas;
    const Eigen::Index at = bodies();
    things.mass[at] = mass;
    things.capacity[at] = mass * gas.specificHeat;
    things.temperature[at] = internal / (mass * gas.specificHeat);
    if (gas.law || gas.pInfinity > 0) things.temperature[at] = gas.temperature(mass / free, internal / free);
    things.volume[at] = free;
  }

  /// Adds gases with laws of their own, which have one temperature; their volumes do not change here.
  void addBlend(const Index<D>& cell, double internal, ice::WarmThings<Most>& things) const {
    const double free = gas_.free[cell];
    std::array<double, euler::kMostGases> masses{}, shares{};
    for (std::size_t k = 0; k < gas_.masses.size(); ++k) {
      masses[k] = gas_.masses[k][cell] / free;
      shares[k] = gas_.shares[k][cell];
    }
    const euler::Blend blend = settings_.gases.front().blend->at(masses.data(), internal / free, shares.data());
    for (std::size_t k = 0; k < gas_.masses.size(); ++k) {
      if (!blend.isPossible || !(gas_.masses[k][cell] > ice::leastPartOfMass * gas_.density[cell])) continue;
      const auto at = bodies() + static_cast<Eigen::Index>(k);
      things.mass[at] = gas_.masses[k][cell];
      things.capacity[at] = things.mass[at] * settings_.gases[k].gas.specificHeat;
      things.temperature[at] = blend.temperature;
      things.volume[at] = free * blend.shares[k];
    }
  }

  const std::vector<mpm::solid::Material>& materials_;
  const Settings& settings_;
  const Gas& gas_;
  const std::vector<WarmBody>& bodies_;
};

}  // namespace tushar::mpmice
