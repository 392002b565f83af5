#pragma once

#include "components/euler/tasks/diffuser.hpp"
#include "components/ice/mixture/tasks.hpp"

namespace tushar::ice {

/// Diffusion of several gases, each with its own viscosity and conductivity. A cell has their mean, weighted by volume
/// fractions or, with BinaryProperties, by masses.
struct MixtureDiffusion {
  std::vector<euler::Diffusion> of;  ///< diffusion of each gas
  double smagorinsky = 0;            ///< constant C for eddies smaller than cells
  bool byMasses = false;

  bool acts() const {
    return smagorinsky > 0 || std::any_of(of.begin(), of.end(), [](const euler::Diffusion& one) { return one.acts(); });
  }
};

/// A function that returns the diffusion properties of each cell.
template <int D>
auto diffusingMixture(const Gases& gases, const MixtureDiffusion& how, const euler::OldState<D>& state,
                      const std::vector<euler::OldGas>& held) {
  return [&, state](const Index<D>& cell) {
    const MixedCell mixed = MixedCell::of<D>(gases, state, held, cell);
    euler::DiffusingCell<D> one;
    double capacity = 0;
    for (std::size_t k = 0; k < gases.size(); ++k) {
      capacity += held[k].mass[cell] * gases[k].gas.specificHeat;
      const double weight = how.byMasses ? held[k].mass[cell] / mixed.density : held[k].share[cell];
      one.how.viscosity += weight * how.of[k].viscosity;
      one.how.conductivity += weight * how.of[k].conductivity;
    }
    one.w[euler::kTemperature] = temperatureAt<D>(gases, state, held, cell);
    for (int d = 0; d < D; ++d) one.w[euler::kVelocity(d)] = state.momentum[cell][d] / mixed.density;
    one.density = mixed.density;
    one.specificHeat = capacity / mixed.density;
    one.soundSpeed = mixed.soundSpeed();
    return one;
  };
}

/// Adds the changes due to viscosity and conduction in a step for several gases, like euler::addDiffusion for one. The
/// conditions at walls are the same for all gases.
template <int D>
void addMixtureDiffusion(const Patch& patch, const Gases& gases, const MixtureDiffusion& how,
                         const euler::OldState<D>& state, const std::vector<euler::OldGas>& held, double time,
                         double dt, CellView<Vec<D>> momentum, CellView<double> totalEnergy,
                         const euler::DiffusionRims<D>& rims) {
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(patch.level(), gases.front().gas, time);
  euler::Diffuser<D> diffuser(patch.level(), patch.cells(), rules, how.smagorinsky);
  euler::diffuse<D>(patch, diffuser, dt, diffusingMixture<D>(gases, how, state, held), momentum, totalEnergy, rims);
}

/// Computes dt as cfl divided by the largest rate at which flow and diffusion together cross a cell. The flow includes
/// a fraction of the speed of sound.
template <int D>
void limitMixtureDiffusion(const Patch& patch, const Gases& gases, const MixtureDiffusion& how, double cfl,
                           double soundSpeedKnob, const euler::OldState<D>& state,
                           const std::vector<euler::OldGas>& held, double time, Minimum& dt) {
  const euler::GhostRules<D> rules = euler::diffusionRules<D>(patch.level(), gases.front().gas, time);
  euler::Diffuser<D> diffuser(patch.level(), patch.cells(), rules, how.smagorinsky);
  const double greatest =
      euler::greatestDiffusionRate<D>(patch, diffuser, soundSpeedKnob, diffusingMixture<D>(gases, how, state, held));
  if (greatest > 0) dt.add(cfl / greatest, "diffusion");
}

}  // namespace tushar::ice
