#pragma once

#include "components/euler/tasks/diffuser.hpp"
#include "components/mpmice/gas_temperature.hpp"

namespace tushar::mpmice {

/// The diffusing quantities rho, T, v and c of a cell that contains gas, and its coefficients without eddies.
template <int D>
euler::DiffusingCell<D> diffusingAt(const Level& level, const Settings& settings, const GasInCells<D>& cells,
                                    const Index<D>& cell) {
  euler::DiffusingCell<D> one;
  const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
  const euler::State<D> u = cells.conserved(cell), w = euler::primitive<D>(gas, u);
  one.density = u[euler::kDensity];
  for (int d = 0; d < D; ++d) one.w[euler::kVelocity(d)] = w[euler::kVelocity(d)];
  double internal = u[euler::kPressure<D>] - 0.5 * one.density * euler::speedSquared<D>(w);
  one.soundSpeed = std::sqrt(gas.soundSpeedSquared(one.density, w[euler::kPressure<D>]));
  if (settings.gases.empty()) {
    one.specificHeat = gas.specificHeat;
    one.w[euler::kTemperature] = gas.temperature(one.density, internal);
    const Vec3 centre = level.expandPoint<D>(level.cellCentre<D>(level.wrapped<D>(cell)));
    one.how = settings.diffusion.alone.at(centre, one.w[euler::kTemperature]);
    return one;
  }
  double capacity = 0;
  const Parcel<D> held = cells.parcel(cell);
  for (std::size_t k = 0; k < settings.gases.size(); ++k) {
    capacity += held.masses[k] * settings.gases[k].gas.specificHeat;
    internal -= held.shares[k] * settings.gases[k].gas.pInfinity;
    one.how.viscosity += held.shares[k] * settings.diffusion.ofEach[k].viscosity;
    one.how.conductivity += held.shares[k] * settings.diffusion.ofEach[k].conductivity;
  }
  one.specificHeat = capacity / one.density;
  one.w[euler::kTemperature] = areBlended(settings) ? gasTemperature<D>(settings, cells, cell) : internal / capacity;
  return one;
}

/// Viscosity at the walls of a cell with gas [Pa s]. It contains no eddies, because walls damp them.
template <int D>
double viscosityAtWalls(const Level& level, const Settings& settings, const GasInCells<D>& cells,
                        const Index<D>& cell) {
  if (!settings.diffusion.varies()) return settings.diffusion.alone.uniform.viscosity;
  return diffusingAt<D>(level, settings, cells, cell).how.viscosity;
}

}  // namespace tushar::mpmice
