#pragma once

#include "components/ice/mixture/exchange_heat.hpp"
#include "components/mpm/solid/material.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Views of the masses and temperatures of the particles of a material.
struct WarmBodies {
  ParticleView<const double> mass;
  ParticleView<const mpm::solid::Matrix3> deformation;
  ParticleView<double> temperature;

  /// `mass` reads the masses at the end of the step.
  static WarmBodies from(auto& take, auto mass) {
    return {.mass = take(mass),
            .deformation = take(requiresNew(p::deformationMeasure)),
            .temperature = take(modifies(p::temperature))};
  }
};

/// Views of the variables of the gas that the heat exchange reads and changes after a step: the energy and, for several
/// gases, the volume fractions.
template <int D>
struct HeatedGas {
  CellView<const double> free, density;
  CellView<const Vec<D>> momentum;
  CellView<double> totalEnergy;
  std::vector<CellView<const double>> masses;
  std::vector<CellView<double>> shares;

  static HeatedGas from(auto& take, std::size_t gases) {
    return {.free = take(requiresNew(c::freeVolume)),
            .density = take(requiresNew(c::density)),
            .momentum = take(requiresNew(c::momentum<D>)),
            .totalEnergy = take(modifies(c::totalEnergy)),
            .masses = viewsOfGases(take, gases, [](std::size_t k) { return requiresNew(c::massOfGas[k]); }),
            .shares = viewsOfGases(take, gases, [](std::size_t k) { return modifies(c::shareOfGas[k]); })};
  }
};

/// Largest number of bodies and gases for which the heat exchange needs no heap memory in each cell.
inline constexpr int kFewThings = 8;

/// Exchanges heat between all bodies and gases that share a cell, with Uintah's exchange coefficients; heat is
/// conserved. `Most` is the largest total number of bodies and gases.
template <int D, int Most>
class HeatExchange {
 public:
  HeatExchange(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
               const HeatedGas<D>& gas, const std::vector<WarmBodies>& bodies)
      : patch_(patch), materials_(materials), settings_(settings), gas_(gas), bodies_(bodies) {
    const auto isStiffened = [](const euler::Settings& one) { return one.gas.pInfinity > 0; };
    are_stiffened_together_ =
        !areBlended(settings) && std::any_of(settings.gases.begin(), settings.gases.end(), isStiffened);
  }

  /// Exchanges heat in a cell, and adds heat from outside. Returns the heat that the gas loses to bodies, per cell
  /// volume [J/m³].
  double apply(const Index<D>& cell, double time, double dt) const {
    const std::size_t bodies = bodies_.size(), gases = std::max<std::size_t>(1, settings_.gases.size());
    const auto first = static_cast<Eigen::Index>(bodies);
    ice::WarmThings<Most> things(static_cast<Eigen::Index>(bodies + gases));
    for (std::size_t m = 0; m < bodies; ++m) addBody(m, cell, things);
    const int solid = things.present();
    if (gas_.free[cell] >= leastFreeVolume && gas_.density[cell] > 0) addGas(cell, things);
    ice::giveHeat(things, settings_.heating, time, dt, first);
    gas_.totalEnergy[cell] += things.given.sum();
    const int present = things.present();
    if (present < 2) return 0;
    const auto changes = ice::changesByHeat(things, settings_.heat, dt);
    for (std::size_t m = 0; m < bodies; ++m) {
      if (!(things.capacity[m] > 0)) continue;
      for (const int p : bodies_[m].mass.template in<D>(cell)) bodies_[m].temperature[p] += changes.temperature[m];
    }
    const double given = solid > 0 && present > solid ? heatToBodies(things, changes) : 0;
    gas_.totalEnergy[cell] -= given;
    if (present > solid && !settings_.gases.empty() && !areBlended(settings_))
      ice::changeShares(changes, first, gas_.free[cell],
                        [&](Eigen::Index k) -> double& { return gas_.shares[k][cell]; });
    return given;
  }

 private:
  /// The heat that bodies receive from gases [J/m³]. It is better known from what the gases gain, because the round-off
  /// of the heat of bodies may exceed all heat of a trace of gas. Stiffened gases that share a cell are the exception:
  /// they gain p_inf dV in addition to m c_v dT.
  double heatToBodies(const ice::WarmThings<Most>& things, const ice::HeatChanges<Most>& changes) const {
    const auto gained = [&](Eigen::Index from, Eigen::Index end) {
      double sum = 0;
      for (Eigen::Index k = from; k < end; ++k)
        if (things.capacity[k] > 0) sum += things.capacity[k] * changes.temperature[k];
      return sum;
    };
    const auto bodies = static_cast<Eigen::Index>(bodies_.size());
    return are_stiffened_together_ ? gained(0, bodies) : things.given.sum() - gained(bodies, things.capacity.size());
  }
  void addBody(std::size_t m, const Index<D>& cell, ice::WarmThings<Most>& things) const {
    const double inverse = 1 / patch_.level().cellVolume();
    double heat = 0;
    for (const int p : bodies_[m].mass.template in<D>(cell)) {
      const double capacity = bodies_[m].mass[p] * materials_[m].specificHeat * inverse;
      things.mass[m] += bodies_[m].mass[p] * inverse;
      things.capacity[m] += capacity;
      heat += capacity * bodies_[m].temperature[p];
      things.volume[m] +=
          bodies_[m].mass[p] / materials_[m].undeformedDensity() * bodies_[m].deformation[p].determinant() * inverse;
    }
    if (things.capacity[m] > 0) things.temperature[m] = heat / things.capacity[m];
  }
  void addGas(const Index<D>& cell, ice::WarmThings<Most>& things) const {
    const auto first = static_cast<Eigen::Index>(bodies_.size());
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
          things.setGas(first + static_cast<Eigen::Index>(k), settings_.gases[k].gas, gas_.masses[k][cell],
                        free * gas_.shares[k][cell], pressure);
      return;
    }
    const euler::Gas& gas = settings_.gas.gas;
    things.mass[first] = mass;
    things.capacity[first] = mass * gas.specificHeat;
    things.temperature[first] = internal / (mass * gas.specificHeat);
    if (gas.law || gas.pInfinity > 0) things.temperature[first] = gas.temperature(mass / free, internal / free);
    things.volume[first] = free;
  }

  /// Adds gases with laws of their own, which have one temperature; their volumes do not change here.
  void addBlend(const Index<D>& cell, double internal, ice::WarmThings<Most>& things) const {
    const auto first = static_cast<Eigen::Index>(bodies_.size());
    const double free = gas_.free[cell];
    std::array<double, euler::kMostGases> masses{}, shares{};
    for (std::size_t k = 0; k < gas_.masses.size(); ++k) {
      masses[k] = gas_.masses[k][cell] / free;
      shares[k] = gas_.shares[k][cell];
    }
    const euler::Blend blend = settings_.gases.front().blend->at(masses.data(), internal / free, shares.data());
    for (std::size_t k = 0; k < gas_.masses.size(); ++k) {
      if (!blend.isPossible || !(gas_.masses[k][cell] > ice::leastPartOfMass * gas_.density[cell])) continue;
      const auto at = first + static_cast<Eigen::Index>(k);
      things.mass[at] = gas_.masses[k][cell];
      things.capacity[at] = things.mass[at] * settings_.gases[k].gas.specificHeat;
      things.temperature[at] = blend.temperature;
      things.volume[at] = free * blend.shares[k];
    }
  }

  const Patch& patch_;
  const std::vector<mpm::solid::Material>& materials_;
  const Settings& settings_;
  const HeatedGas<D>& gas_;
  const std::vector<WarmBodies>& bodies_;
  bool are_stiffened_together_;  ///< whether several gases share cells, one of which is stiffened
};

/// Exchanges heat between bodies and gases. Particles belong to the cell in which they started the step.
template <int D, int Most>
void exchangeHeat(const Patch& patch, const std::vector<mpm::solid::Material>& materials, const Settings& settings,
                  double time, double dt, const HeatedGas<D>& gas, const std::vector<WarmBodies>& bodies,
                  const std::optional<CellView<double>>& heat) {
  if (heat) heat->fill(0);
  const HeatExchange<D, Most> exchange(patch, materials, settings, gas, bodies);
  const bool hasGasAlone = (!settings.gases.empty() && !areBlended(settings)) || settings.heating.acts();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const bool hasBody = std::any_of(bodies.begin(), bodies.end(),
                                     [&](const WarmBodies& body) { return body.mass.template in<D>(cell).size() > 0; });
    if (!hasBody && !hasGasAlone) return;
    const double given = exchange.apply(cell, time, dt);
    if (heat) (*heat)[cell] = given;
  });
}

/// Exchanges heat between several gases that exchange no heat with bodies.
template <int D>
void heatGases(const Patch& patch, const Settings& settings, double time, double dt, const HeatedGas<D>& gas) {
  const std::vector<WarmBodies> none;
  const std::vector<mpm::solid::Material> noMaterials;
  const HeatExchange<D, euler::kMostGases> exchange(patch, noMaterials, settings, gas, none);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { exchange.apply(cell, time, dt); });
}

}  // namespace tushar::mpmice
