#pragma once

#include "components/euler/tasks/diagnose.hpp"
#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Views of the gases of cells, per cell volume, that a reaction changes.
template <int D>
struct ReactingGas {
  CellView<const double> free, density;
  CellView<const Vec<D>> momentum;
  CellView<double> totalEnergy;
  std::vector<CellView<double>> masses, shares;  ///< shares are volume fractions of the gas

  static ReactingGas from(auto& take, std::size_t gases) {
    return {.free = take(requiresNew(c::freeVolume)),
            .density = take(requiresNew(c::density)),
            .momentum = take(requiresNew(c::momentum<D>)),
            .totalEnergy = take(modifies(c::totalEnergy)),
            .masses = viewsOfGases(take, gases, [](std::size_t k) { return modifies(c::massOfGas[k]); }),
            .shares = viewsOfGases(take, gases, [](std::size_t k) { return modifies(c::shareOfGas[k]); })};
  }
  bool isEmpty(const Index<D>& cell) const { return free[cell] < leastFreeVolume || !(density[cell] > 0); }
  /// Internal energy per volume of the gas [J/m³].
  double energy(const Index<D>& cell) const {
    return euler::internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]) / free[cell];
  }
  /// The masses of each gas per volume of the gas [kg/m³].
  std::array<double, euler::kMostGases> own(const Index<D>& cell) const {
    std::array<double, euler::kMostGases> own{};
    for (std::size_t k = 0; k < masses.size(); ++k) own[k] = masses[k][cell] / free[cell];
    return own;
  }
  /// The equilibrium of gases with laws of their own.
  euler::Blend blend(const Settings& settings, const Index<D>& cell) const {
    std::array<double, euler::kMostGases> guess{};
    for (std::size_t k = 0; k < shares.size(); ++k) guess[k] = shares[k][cell];
    return settings.gases.front().blend->at(own(cell).data(), energy(cell), guess.data());
  }
  /// What a reaction finds in a cell that contains gas: its masses and volume fraction, and the pressure.
  std::pair<ice::Reactants, double> reactants(const Settings& settings, const ice::Reaction& one,
                                              const Index<D>& cell) const {
    ice::Reactants there{masses[one.from][cell] / free[cell], masses[one.to][cell] / free[cell],
                         shares[one.from][cell]};
    if (areBlended(settings)) {
      const euler::Blend all = blend(settings, cell);
      there.share = all.shares[one.from];
      return {there, all.pressure};
    }
    euler::MixedGas mixed;
    for (std::size_t k = 0; k < shares.size(); ++k)
      mixed.add(shares[k][cell], settings.gases[k].gas.gamma, settings.gases[k].gas.pInfinity);
    return {there, mixed.pressure(density[cell] / free[cell], energy(cell))};
  }
};

/// Converts a gas of a cell into another one, like ice::reactGas.
template <int D>
void reactAt(const Settings& settings, const ice::Reaction& one, double dt, const ReactingGas<D>& gas,
             const Index<D>& cell) {
  double &from = gas.masses[one.from][cell], &to = gas.masses[one.to][cell];
  if (gas.isEmpty(cell) || !(from > 0)) return;
  const auto [there, pressure] = gas.reactants(settings, one, cell);
  const double part = there.converted(one.burn, pressure, dt), burned = part * from;
  if (!(part > 0)) return;
  from = part < 1 ? from - burned : 0;
  to += burned;
  gas.shares[one.to][cell] += part * there.share;
  gas.shares[one.from][cell] = part < 1 ? there.share - part * there.share : 0;
  gas.totalEnergy[cell] += burned * one.burn.heat;
}

/// Converts gases into others at rates that depend on the pressure, and adds the heat of the reactions.
template <int D>
void reactGases(const Patch& patch, const Settings& settings, double dt, const ReactingGas<D>& gas) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    for (const ice::Reaction& one : settings.reactions) reactAt<D>(settings, one, dt, gas, cell);
  });
}

/// Sets the volume fractions of gases with laws of their own to those in equilibrium, in cells that contain gas. Throws
/// NumericalError for the first cell with an impossible state, if there is one.
template <int D>
void closeGases(const Patch& patch, const Settings& settings, const ReactingGas<D>& gas) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (gas.isEmpty(cell)) return;
    const euler::Blend blend = gas.blend(settings, cell);
    if (!blend.isPossible)
      euler::refuseBlend<D>(*settings.gases.front().blend, patch.level(), cell, gas.own(cell), gas.energy(cell));
    for (std::size_t k = 0; k < gas.shares.size(); ++k) gas.shares[k][cell] = blend.shares[k];
  });
}

}  // namespace tushar::mpmice
