#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/labels.hpp"

namespace tushar::euler {

/// The diffusive fluxes through the rim of the level, Pa and W/m².
template <int D>
struct DiffusionRims {
  RimFlux<Vec<D>> momentum;
  RimFlux<double> energy;

  static DiffusionRims from(auto& take) {
    return {.momentum = take(keepsFlux(c::momentum<D>)), .energy = take(keepsFlux(c::totalEnergy))};
  }
};

/// Adds the change by viscosity and heat conduction in a step, from the state at its start [kg/m³, kg/(m² s), J/m³].
///
/// Through a face across d flow -tau_d of momentum and -(tau_d . v + k dT/dx_d) of energy, tau = mu (grad v +
/// (grad v)^T - 2/3 div v I): Newton's and Fourier's laws, by centred differences. What leaves a cell enters its
/// neighbour, so mass, momentum and energy are kept. One step of Euler's method: of first order in time.
/// Sides: no stress along a plane of symmetry, and no heat through it. The gas sticks to a wall with a `Velocity`; a
/// `Temperature` is that of the wall, without one it is adiabatic. Nothing diffuses through an open side.
template <int D>
void addDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, CellView<const double> density,
                  CellView<const Vec<D>> momentum, CellView<const double> totalEnergy, double dt,
                  CellView<Vec<D>> newMomentum, CellView<double> newTotalEnergy, const DiffusionRims<D>& rims);

/// dt = cfl / max(sum_d (|v_d| + c) / h_d + 2 nu / h_d²), nu the greatest diffusivity.
template <int D>
void limitDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, double cfl,
                    CellView<const double> density, CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                    Minimum& dt);

}  // namespace tushar::euler
