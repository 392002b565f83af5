#pragma once

#include "components/euler/tasks/diagnose.hpp"
#include "components/ice/labels.hpp"

namespace tushar::ice {

/// Computes the internal energy in the patch [J].
template <int D>
void sumInternalEnergy(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
                       CellView<const double> totalEnergy, Sum& energy) {
  WideSum sum(energy);
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    sum.add(volume * euler::internalEnergyPerVolume<D>(density[cell], momentum[cell], totalEnergy[cell]));
  });
}

/// Computes T [K]: e / c_v for an ideal gas.
template <int D>
void computeTemperature(const Patch& patch, const euler::Gas& gas, CellView<const double> density,
                        CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                        CellView<double> temperature) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double rho = density[cell];
    temperature[cell] = gas.temperature(rho, euler::internalEnergyPerVolume<D>(rho, momentum[cell], totalEnergy[cell]));
  });
}

template <int D>
void computeSoundSpeed(const Patch& patch, const euler::Gas& gas, CellView<const double> density,
                       CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                       CellView<double> soundSpeed) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double rho = density[cell];
    const double last = gas.last(rho, euler::internalEnergyPerVolume<D>(rho, momentum[cell], totalEnergy[cell]));
    soundSpeed[cell] = std::sqrt(gas.soundSpeedSquared(rho, last));
  });
}

template <int D>
void computeSpecificVolume(const Patch& patch, CellView<const double> density, CellView<double> specificVolume) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) { specificVolume[cell] = 1 / density[cell]; });
}

}  // namespace tushar::ice
