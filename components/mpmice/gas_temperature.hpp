#pragma once

#include "components/mpmice/gas_in_cells.hpp"

namespace tushar::mpmice {

/// Temperature of a gas [K], from its density and the last component of its primitive state: (p + p_inf) / (R rho), or
/// by its own equation of state.
inline double temperatureOf(const euler::Gas& gas, double density, double last) {
  if (gas.law) return gas.temperature(density, gas.energyOf(density, last));
  return (last + gas.pInfinity) / (gas.gasConstant() * density);
}

/// The temperature [K] of the gas in a cell that contains gas. Several gases have one temperature, from rho e = sum of
/// m_k c_v,k T + z_k p_inf,k.
template <int D>
double gasTemperature(const Settings& settings, const GasInCells<D>& cells, const Index<D>& cell) {
  if (settings.gases.empty()) {
    const euler::State<D> w = cells.primitive(settings.gas.gas, cell);
    return temperatureOf(settings.gas.gas, w[euler::kDensity], w[euler::kPressure<D>]);
  }
  if (areBlended(settings)) return blendAt<D, const double>(settings, cells.held, cells.free[cell], cell).temperature;
  double heat = euler::internalEnergyIn<D, const double>(cells.held, cell), capacity = 0;
  for (std::size_t k = 0; k < settings.gases.size(); ++k) {
    heat -= cells.free[cell] * cells.held.shares[k][cell] * settings.gases[k].gas.pInfinity;
    capacity += cells.held.masses[k][cell] * settings.gases[k].gas.specificHeat;
  }
  return heat / capacity;
}

}  // namespace tushar::mpmice
