#pragma once

#include "components/mpm/conserving/labels.hpp"
#include "components/mpm/conserving/scheme.hpp"
#include "components/mpm/materials/gas.hpp"

namespace tushar::mpm::conserving {

/// dt <= 0.4 over the rates at which cells are compressed, -div v, cool by expansion, (gamma - 1) div v, and are stretched
/// along an axis, |dv_d/dx_d|: no box doubles, no cell loses half its volume or energy.
template <int D>
void limitDeformation(const Patch& patch, const Gas& gas, CellView<const Tensor<D>> gradient, Minimum& dt) {
  double fastest = 0;
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    const double divergence = gradient[cell].trace();
    fastest = std::max({fastest, -divergence, (gas.gamma - 1) * divergence, gradient[cell].diagonal().cwiseAbs().maxCoeff()});
  });
  if (fastest > 0) dt.add(0.4 / fastest, "deformation");
}

/// dt = min(cfl h / max c, advectiveCfl h / max |v_d|) over the particles, and limitDeformation.
template <int D>
void computeStableTimeStep(const Patch& patch, const Gas& gas, const ConservingGasDynamics& method,
                           ParticleView<const Vec<D>> velocity, ParticleView<const double> internalEnergy,
                           CellView<const Tensor<D>> gradient, Minimum& dt) {
  double fastest = 0, hottest = 0;
  for (int p = 0; p < velocity.owned(); ++p) {
    fastest = std::max(fastest, velocity[p].cwiseAbs().maxCoeff());
    hottest = std::max(hottest, internalEnergy[p]);
  }
  const double h = patch.level().minSpacing();
  if (hottest > 0) dt.add(method.cfl * h / std::sqrt(gas.soundSpeedSquared(hottest)), "CFL");
  if (fastest > 0) dt.add(method.advectiveCfl * h / fastest, "advection");
  limitDeformation<D>(patch, gas, gradient, dt);
}

/// dt = cfl h / max(|v| + c) over the particles, and limitDeformation.
template <int D>
void computeAcousticTimeStep(const Patch& patch, const Gas& gas, const ConservingGasDynamics& method,
                             ParticleView<const Vec<D>> velocity, ParticleView<const double> internalEnergy,
                             CellView<const Tensor<D>> gradient, Minimum& dt) {
  mpm::computeStableTimeStep<D>(patch, gas, method.cfl, velocity, internalEnergy, dt);
  limitDeformation<D>(patch, gas, gradient, dt);
}

}  // namespace tushar::mpm::conserving
