#pragma once

#include "components/euler/diffusion.hpp"
#include "components/euler/rows.hpp"
#include "components/euler/state_views.hpp"

namespace tushar::euler {

/// The diffusive fluxes of momentum [Pa] and energy [W/m²] through the rim of the level.
template <int D>
struct DiffusionRims {
  RimFlux<Vec<D>> momentum;
  RimFlux<double> energy;

  static DiffusionRims from(auto& take) {
    return {.momentum = take(keepsFlux(c::momentum<D>)), .energy = take(keepsFlux(c::totalEnergy))};
  }
};

/// Computes T [K], which takes the place of the density, and v for the cells of `rows` that are on the grid or are
/// periodic images of such cells.
template <int D>
void findTemperature(const Gas& gas, const Level& level, const StateViews<D, const double>& old, Rows<D>& rows);

/// Computes the diffusive fluxes along an axis through the lower faces of the cells of `faces` [Pa and W/m²], from T
/// and v around them.
template <int D>
void computeDiffusiveFluxes(const Diffusion& diffusion, const Level& level, const Box& faces, int axis, Rows<D>& w,
                            Rows<D>& flux);

/// Adds to the cells of a block the net inflow along an axis; `ratio` is dt / h [s/m].
template <int D>
void addDiffused(double ratio, const Box& block, int axis, Rows<D>& flux, CellView<Vec<D>> momentum,
                 CellView<double> energy);

/// Adds the changes due to viscosity and heat conduction in a step, given the state [kg/m³, kg/(m² s), J/m³] and the
/// time at the start of the step.
///
/// The fluxes through a face normal to d are -tau_d for momentum and -(tau_d . v + k dT/dx_d) for energy, where tau =
/// mu (grad v + (grad v)^T - 2/3 div v I). These are Newton's and Fourier's laws, by centred differences. They conserve
/// mass, momentum and energy. The step is one of Euler's method, of first order in time. Along a symmetry plane there
/// is no stress, and no heat passes through it. The gas sticks to a wall with a `Velocity`; a `Temperature` is that of
/// the wall, and a wall without it is adiabatic. There is no diffusion through an open side.
template <int D>
void addDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, const OldState<D>& old, double time,
                  double dt, CellView<Vec<D>> newMomentum, CellView<double> newTotalEnergy,
                  const DiffusionRims<D>& rims);

/// Computes dt = cfl / max(sum_d (|v_d| + c) / h_d + 2 nu / h_d²), where nu is the largest diffusivity.
template <int D>
void limitDiffusion(const Patch& patch, const Gas& gas, const Diffusion& diffusion, double cfl,
                    CellView<const double> density, CellView<const Vec<D>> momentum, CellView<const double> totalEnergy,
                    Minimum& dt);

}  // namespace tushar::euler
