#pragma once

#include "components/euler/tasks/check_state.hpp"
#include "components/euler/tasks/diffuser.hpp"

namespace tushar::euler {

/// A function that returns the diffusion properties of each cell.
template <int D>
auto diffusingCells(const Level& level, const Gas& gas, const VaryingDiffusion& how,
                    const StateViews<D, const double>& old) {
  return [&level, &gas, &how, old](const Index<D>& cell) {
    const double rho = old.density[cell], energy = internalEnergyIn<D, const double>(old, cell);
    DiffusingCell<D> one;
    one.w[kTemperature] = gas.temperature(rho, energy);
    for (int d = 0; d < D; ++d) one.w[kVelocity(d)] = old.momentum[cell][d] / rho;
    one.how = how.at(level.expandPoint<D>(level.cellCentre<D>(level.wrapped<D>(cell))), one.w[kTemperature]);
    one.density = rho;
    one.specificHeat = gas.specificHeat;
    one.soundSpeed = std::sqrt(gas.soundSpeedSquared(rho, gas.last(rho, energy)));
    return one;
  };
}

/// Adds the changes due to viscosity and heat conduction in a step, like addDiffusion, for varying coefficients.
template <int D>
void addVaryingDiffusion(const Patch& patch, const Gas& gas, const VaryingDiffusion& how, const OldState<D>& old,
                         double time, double dt, CellView<Vec<D>> newMomentum, CellView<double> newTotalEnergy,
                         const DiffusionRims<D>& rims) {
  const GhostRules<D> rules = diffusionRules<D>(patch.level(), gas, time);
  Diffuser<D> diffuser(patch.level(), patch.cells(), rules, how.smagorinsky);
  diffuse<D>(patch, diffuser, dt, diffusingCells<D>(patch.level(), gas, how, old), newMomentum, newTotalEnergy, rims);
}

/// Computes dt as cfl divided by the largest rate at which flow, sound and diffusion together cross a cell.
template <int D>
void limitVaryingDiffusion(const Patch& patch, const Gas& gas, const VaryingDiffusion& how, double cfl,
                           const OldState<D>& old, double time, Minimum& dt) {
  refuseBroken<D, const double>(patch, gas, old, nullptr);
  const GhostRules<D> rules = diffusionRules<D>(patch.level(), gas, time);
  Diffuser<D> diffuser(patch.level(), patch.cells(), rules, how.smagorinsky);
  const double greatest = greatestDiffusionRate<D>(patch, diffuser, 1, diffusingCells<D>(patch.level(), gas, how, old));
  if (greatest > 0) dt.add(cfl / greatest, "diffusion");
}

}  // namespace tushar::euler
