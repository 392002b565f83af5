#pragma once

#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/tasks/fastest_signal.hpp"

namespace tushar::mpm::gas::conserving {

/// dt <= 0.4 divided by the rates at which cells are compressed, -div v, cool by expansion, (gamma - 1) div v, and are
/// stretched along an axis, |dv_d/dx_d|: no box doubles its length, no cell loses half its volume or energy. In cells
/// without gas the rates count half: a front moves by at most .8 of the width of an empty cell.
template <int D>
void limitDeformation(const Patch& patch, const Gas& gas, CellView<const double> mass,
                      CellView<const Tensor<D>> gradient, Minimum& dt) {
  double fastest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double divergence = gradient[cell].trace(), stretch = gradient[cell].diagonal().cwiseAbs().maxCoeff();
    const double rate = std::max({-divergence, (gas.gamma - 1) * divergence, stretch});
    fastest = std::max(fastest, mass[cell] > 0 ? rate : 0.5 * rate);
  });
  if (fastest > 0) dt.add(0.4 / fastest, "deformation");
}

/// dt = min(cfl h / max c, advectiveCfl h / max |v_d|) over the particles, and limitDeformation.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, const ConservingGasDynamics& method,
                           ParticleView<const Vec<D>> velocity, ParticleView<const double> internalEnergy,
                           CellView<const double> mass, CellView<const Tensor<D>> gradient, Minimum& dt) {
  double fastest = 0, hottest = 0;
  for (int p = 0; p < velocity.owned(); ++p) {
    fastest = std::max(fastest, velocity[p].cwiseAbs().maxCoeff());
    hottest = std::max(hottest, internalEnergy[p]);
  }
  const double h = patch.level().minSpacing();
  if (hottest > 0) dt.add(method.cfl * h / std::sqrt(gas.soundSpeedSquared(hottest)), "CFL");
  if (fastest > 0) dt.add(method.advectiveCfl * h / fastest, "advection");
  limitDeformation<D>(patch, gas, mass, gradient, dt);
}

/// The largest speed of signals in a cell relative to its gas [m/s], 1.25 (q + sqrt(q² + c²)) with q = 1.4 |Delta|,
/// where Delta is the velocity difference across the cell, since shocks are faster than sound. The form is that of D.
/// J. Benson, Comput. Methods Appl. Mech. Eng. 99 (1992) 235; with these factors a moving gas has hardly a greater
/// error than one at rest, and one at rest has that of |v| + c alone.
template <int D>
double signalInCell(const Level& level, const Tensor<D>& gradient, double soundSpeedSquared) {
  const double q = 1.4 * level.minSpacing() * std::abs(gradient.trace());
  return 1.25 * (q + std::sqrt(q * q + soundSpeedSquared));
}

/// The largest speeds of signals [m/s]: of particles relative to the grid, |v| + c; and signalInCell.
template <int D>
void measureSignals(const Patch& patch, const Gas& gas, ParticleView<const Vec<D>> velocity,
                    ParticleView<const double> internalEnergy, CellView<const double> mass,
                    CellView<const double> cellInternalEnergy, CellView<const Tensor<D>> gradient, Maximum& pastGrid,
                    Maximum& pastGas) {
  pastGrid.add(fastestSignal<D>(gas, velocity, internalEnergy));
  double fastest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (!(mass[cell] > 0)) return;
    const double cSquared = gas.soundSpeedSquared(cellInternalEnergy[cell] / mass[cell]);
    fastest = std::max(fastest, signalInCell<D>(patch.level(), gradient[cell], cSquared));
  });
  pastGas.add(fastest);
}

/// dt = cfl h over the smaller of the two speeds of measureSignals; and limitDeformation. Boxes move with the gas, so
/// only signals relative to the gas need a limit; where the gas is slow, |v| + c is the sharper bound.
template <int D>
void computeAcousticTimeStep(const Patch& patch, const Gas& gas, const ConservingGasDynamics& method,
                             CellView<const double> mass, CellView<const Tensor<D>> gradient, double pastGrid,
                             double pastGas, Minimum& dt) {
  const double fastest = std::min(pastGrid, pastGas);
  if (fastest > 0) dt.add(method.cfl * patch.level().minSpacing() / fastest, "CFL");
  limitDeformation<D>(patch, gas, mass, gradient, dt);
}

}  // namespace tushar::mpm::gas::conserving
