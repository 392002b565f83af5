#pragma once

#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas {

/// Returns max_p(|v_p| + c_p), c = sqrt(gamma (gamma - 1) eps) [m/s].
template <int D>
double fastestSignal(const Gas& gas, ParticleView<const Vec<D>> velocity, ParticleView<const double> internalEnergy) {
  constexpr int chunk = 256;
  std::array<double, chunk> speed;
  double greatest = 0;
  for (int first = 0; first < velocity.owned(); first += chunk) {
    const int count = std::min(chunk, velocity.owned() - first);
    for (int k = 0; k < count; ++k)
      speed[k] = length(velocity[first + k]) + std::sqrt(gas.soundSpeedSquared(internalEnergy[first + k]));
    greatest = std::max(greatest, Eigen::Map<const Eigen::ArrayXd>(speed.data(), count).maxCoeff());
  }
  return greatest;
}

}  // namespace tushar::mpm::gas
