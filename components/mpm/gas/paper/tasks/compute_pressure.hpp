#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/tasks/fastest_signal.hpp"
#include "components/mpm/gas/viscosity.hpp"

namespace tushar::mpm::gas::paper {

/// p = (gamma - 1) rho eps + a_v                                 (16) of Tran, Kim & Berzins
///
/// with a_v = rho (C_q h² d² - C_l h c d) in compression (d < 0), else 0 [Pa]. h is the smallest cell width, c the
/// speed of sound, d the divergence of (14)-(15) in the step just computed.
template <int D>
void computePressure(const Patch& patch, const Gas& gas, const Viscosity& viscosity, ParticleView<const double> density,
                     ParticleView<const double> internalEnergy, ParticleView<const double> divergence,
                     ParticleView<double> pressure) {
  const double h = patch.level().minSpacing();
  const auto press = [&](const auto& heat) {
    for (int p = 0; p < density.owned(); ++p) {
      const double d = std::min(divergence[p], 0.0) * h;
      const double c = std::sqrt(gas.soundSpeedSquared(internalEnergy[p]));
      pressure[p] = gas.pressureOf(density[p], heat(density[p], internalEnergy[p])) +
                    density[p] * (viscosity.quadratic * d * d - viscosity.linear * c * d);
    }
  };
  if (gas.carried == 0)
    press([](double, double energy) { return energy; });  // what heat() gives then, without its division
  else
    press([&](double rho, double energy) { return gas.heat(rho, energy); });
}

/// Computes p = (gamma - 1) rho eps, (3), which is (16) without viscosity: at the start of a run there is no
/// compression.
template <int D>
void computeInitialPressure(const Patch&, const Gas& gas, ParticleView<const double> density,
                            ParticleView<const double> internalEnergy, ParticleView<double> pressure) {
  for (int p = 0; p < density.owned(); ++p) pressure[p] = gas.pressure(density[p], internalEnergy[p]);
}

/// m_p = rho_p V_p                                               (4)
/// V_p = V_c / N_c                                               (5) of Tran, Kim & Berzins
///
/// The N_c particles of a cell share its volume V_c equally. Mass is not conserved: it changes when a particle crosses
/// a face.
template <int D>
void shareCellVolume(const Patch& patch, const Gas&, ParticleView<const double> density, ParticleView<double> mass) {
  const double volume = patch.level().cellVolume();
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const data::ParticleRange particles = density.in(cell);
    const double share = volume / std::max(particles.size(), 1);
    for (const int p : particles) mass[p] = density[p] * share;
  });
}

/// Computes dt = cfl h / max_p(|v_p| + c_p), where h is the smallest cell width. This keeps dt dv/dx small, as (17) of
/// Tran, Kim & Berzins requires.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, double cfl, ParticleView<const Vec<D>> velocity,
                           ParticleView<const double> internalEnergy, Minimum& dt) {
  const double greatest = fastestSignal<D>(gas, velocity, internalEnergy);
  if (greatest > 0) dt.add(cfl * patch.level().minSpacing() / greatest, "CFL");
}

}  // namespace tushar::mpm::gas::paper
