#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"

namespace tushar::mpm::gas {

/// Computes e' = e_0 + (e - e_0) exp(-k dt): the exact solution of de/dt = -k (e - e_0), stable for any k dt.
inline void relaxEnergy(const Patch&, const Gas& gas, double dt, ParticleView<double> internalEnergy) {
  if (!gas.relaxation) return;
  const double share = -std::expm1(-gas.relaxation->rate * dt), goal = gas.relaxation->internalEnergy;
  for (int p = 0; p < internalEnergy.owned(); ++p) internalEnergy[p] += share * (goal - internalEnergy[p]);
}

/// Adds relaxEnergy to a list, after the update of the particles, if any gas has a heat source.
inline void scheduleRelaxEnergy(TaskList& tasks, const std::vector<Gas>& materials) {
  const auto relaxes = [](const Gas& gas) { return gas.relaxation.has_value(); };
  if (std::none_of(materials.begin(), materials.end(), relaxes)) return;
  tasks.perMaterial("mpm::relaxEnergy", relaxEnergy, materials, requiresOld(delT), modifies(p::internalEnergy));
}

}  // namespace tushar::mpm::gas
