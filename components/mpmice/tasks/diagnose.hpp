#pragma once

#include "components/euler/tasks/diagnose.hpp"
#include "components/mpmice/gas_temperature.hpp"

namespace tushar::mpmice {

/// Calls `show(cell, hasGas)` for each cell of the patch.
template <int D, class Show>
void showGas(const Patch& patch, const GasInCells<D>& cells, Show&& show) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { show(cell, !cells.isEmpty(cell)); });
}

template <int D>
void computePressure(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                     CellView<double> pressure) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = hasGas ? cells.primitive(gas, cell) : euler::State<D>{};
    pressure[cell] = hasGas ? gas.pressureOf(w[euler::kDensity], w[euler::kPressure<D>]) : 0;
  });
}

template <int D>
void computeVelocity(const Patch& patch, const GasInCells<D>& cells, CellView<Vec<D>> velocity) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    velocity[cell] = hasGas ? Vec<D>(cells.held.momentum[cell] / cells.held.density[cell]) : Vec<D>(Vec<D>::Zero());
  });
}

template <int D>
void computeMach(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, CellView<Vec<D>> mach) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    mach[cell] = Vec<D>::Zero();
    if (!hasGas) return;
    const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = cells.primitive(gas, cell);
    const double c2 = gas.soundSpeedSquared(w[euler::kDensity], w[euler::kPressure<D>]);
    for (int d = 0; d < D; ++d) mach[cell][d] = w[euler::kVelocity(d)] / std::sqrt(c2);
  });
}

template <int D>
void computeGasDensity(const Patch& patch, const GasInCells<D>& cells, CellView<double> density) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    density[cell] = hasGas ? cells.held.density[cell] / cells.free[cell] : 0;
  });
}

/// Computes T [K] of the gas; 0 in cells without gas.
template <int D>
void computeTemperature(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                        CellView<double> temperature) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    temperature[cell] = hasGas ? gasTemperature<D>(settings, cells, cell) : 0;
  });
}

template <int D>
void computeSoundSpeed(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                       CellView<double> speed) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    speed[cell] = 0;
    if (!hasGas) return;
    const euler::Gas gas = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    const euler::State<D> w = cells.primitive(gas, cell);
    speed[cell] = std::sqrt(gas.soundSpeedSquared(w[euler::kDensity], w[euler::kPressure<D>]));
  });
}

template <int D>
void computeSpecificVolume(const Patch& patch, const GasInCells<D>& cells, CellView<double> volume) {
  showGas<D>(patch, cells, [&](const Index<D>& cell, bool hasGas) {
    volume[cell] = hasGas ? cells.free[cell] / cells.held.density[cell] : 0;
  });
}

/// Computes the internal energy of the gas [J].
template <int D>
void sumInternalEnergy(const Patch& patch, const GasInCells<D>& cells, Sum& energy) {
  WideSum sum(energy);
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (cells.isEmpty(cell)) return;
    const double kinetic = 0.5 * cells.held.momentum[cell].squaredNorm() / cells.held.density[cell];
    sum.add(volume * (cells.held.totalEnergy[cell] - kinetic));
  });
}

// Each of the following sums is added to a total of the gas, and to one of gas and bodies.

/// Computes the mass of the gas [kg].
template <int D>
void sumMass(const Patch& patch, CellView<const double> density, Sum& ofGas, Sum& ofAll) {
  Sum sum;
  euler::sumMass<D>(patch, density, sum);
  ofGas.merge(sum);
  ofAll.merge(sum);
}

/// Computes the momentum of the gas [kg m/s].
template <int D>
void sumMomentum(const Patch& patch, CellView<const Vec<D>> momentum, VectorSum& ofGas, VectorSum& ofAll) {
  VectorSum sum;
  euler::sumMomentum<D>(patch, momentum, sum);
  ofGas.merge(sum);
  ofAll.merge(sum);
}

/// Computes the kinetic energy of the gas [J].
template <int D>
void sumKineticEnergy(const Patch& patch, const GasInCells<D>& cells, Sum& ofGas, Sum& ofAll) {
  Sum sum;
  {
    WideSum wide(sum);
    const double half = 0.5 * patch.level().cellVolume();
    forEachRow<D>(patch.cells(), [&](const Index<D>& first, int count) {
      const double *m = cells.held.momentum[first].data(), *mass = &cells.held.density[first];
      const double* free = &cells.free[first];
      wide.addAll(count, [&](int k) {
        const double energy = half * euler::squaredNormAt<D>(m, k) / mass[k], open = mass[k] > 0 ? energy : 0.0;
        return free[k] < leastFreeVolume ? 0.0 : open;
      });
    });
  }
  ofGas.merge(sum);
  ofAll.merge(sum);
}

/// Computes the smallest mass in any cell (for several gases, of any of them), and the smallest internal energy in any
/// cell, less the part that p_inf contributes. Closed holes, which only keep their content, are included.
template <int D>
void findLeastContent(const Patch& patch, const Settings& settings, const GasInCells<D>& cells, Minimum& mass,
                      Minimum& heat) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    mass.add(cells.held.density[cell]);
    for (const auto& ofGas : cells.held.masses) mass.add(ofGas[cell]);
    if (cells.held.density[cell] == 0) return;
    const double energy = euler::internalEnergyIn<D, const double>(cells.held, cell);
    heat.add(energy - cells.free[cell] * lawAt<D>(settings, cells.held, cells.free[cell], cell).pInfinity);
  });
}

}  // namespace tushar::mpmice
