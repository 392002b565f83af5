#pragma once

#include "components/mpm/gas/conserving/labels.hpp"
#include "components/mpm/gas/conserving/rows.hpp"
#include "components/mpm/gas/conserving/scheme.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/tasks/fastest_signal.hpp"

namespace tushar::mpm::gas::conserving {

/// Limits dt to 0.4 divided by each of three rates of every cell: of compression, -div v; of cooling by expansion,
/// (gamma - 1) div v; and of stretching along an axis, |dv_d/dx_d|. So no box doubles its length, and no cell loses
/// half its volume or energy. In cells without gas the rates count half: a front moves by at most .8 of the width of an
/// empty cell.
template <int D>
void limitDeformation(const Patch& patch, const Gas& gas, CellView<const double> mass,
                      CellView<const Tensor<D>> gradient, Minimum& dt) {
  Lanes most = 0;
  forEachRowPart<D>(patch.cells(), [&](const RowPart<D>& cells) {
    const LanesTensor<D> g = load(gradient, cells);
    const Lanes divergence = g.trace();
    Lanes rate = max(-divergence, (gas.gamma - 1) * divergence);
    for (int d = 0; d < D; ++d) rate = max(rate, abs(g(d, d)));
    most = max(most, select(load(mass, cells) > 0, rate, 0.5 * rate));
  });
  if (const double fastest = greatest(most); fastest > 0) dt.add(0.4 / fastest, "deformation");
}

/// Computes dt = min(cfl h / max c, advectiveCfl h / max |v_d|) over the particles, and applies limitDeformation.
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

/// The largest speed of signals in cells relative to the gas [m/s], 1.25 (q + sqrt(q² + c²)) with q = 1.4 |Delta|,
/// where Delta is the velocity difference across the cell: shocks are faster than sound. The form is that of D. J.
/// Benson, Comput. Methods Appl. Mech. Eng. 99 (1992) 235. With these factors, the error for a moving gas is hardly
/// larger than for a gas at rest. For a gas at rest, the error is the same as with |v| + c.
inline Lanes signalInCells(const Level& level, Lanes divergence, Lanes soundSpeedSquared) {
  const Lanes q = 1.4 * level.minSpacing() * abs(divergence);
  return 1.25 * (q + sqrt(q * q + soundSpeedSquared));
}

/// Computes the largest speeds of signals [m/s]: relative to the grid, |v| + c over the particles; and relative to the
/// gas, signalInCells over the cells.
template <int D>
void measureSignals(const Patch& patch, const Gas& gas, ParticleView<const Vec<D>> velocity,
                    ParticleView<const double> internalEnergy, CellView<const double> mass,
                    CellView<const double> cellInternalEnergy, CellView<const Tensor<D>> gradient, Maximum& pastGrid,
                    Maximum& pastGas) {
  pastGrid.add(fastestSignal<D>(gas, velocity, internalEnergy));
  const double perEnergy = gas.soundSpeedSquared(1);
  Lanes fastest = 0;
  forEachRowPart<D>(patch.cells(), [&](const RowPart<D>& cells) {
    const Lanes m = load(mass, cells), cSquared = perEnergy * (load(cellInternalEnergy, cells) / m);
    const Lanes signal = signalInCells(patch.level(), load(gradient, cells).trace(), cSquared);
    fastest = max(fastest, select(m > 0, signal, 0));
  });
  pastGas.add(greatest(fastest));
}

/// Computes dt = cfl h over the smaller of the two speeds of measureSignals, and applies limitDeformation. Boxes move
/// with the gas, so only signals relative to the gas need a limit; where the gas is slow, |v| + c is the sharper bound.
template <int D>
void computeAcousticTimeStep(const Patch& patch, const Gas& gas, const ConservingGasDynamics& method,
                             CellView<const double> mass, CellView<const Tensor<D>> gradient, double pastGrid,
                             double pastGas, Minimum& dt) {
  const double fastest = std::min(pastGrid, pastGas);
  if (fastest > 0) dt.add(method.cfl * patch.level().minSpacing() / fastest, "CFL");
  limitDeformation<D>(patch, gas, mass, gradient, dt);
}

}  // namespace tushar::mpm::gas::conserving
