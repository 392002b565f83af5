#pragma once

#include "components/euler/face_masses.hpp"
#include "components/euler/settings.hpp"
#include "components/euler/state_views.hpp"

namespace tushar::euler {

/// The fluxes of one of several gases through the rim of the level: of its mass [kg/(m² s)] and of its volume fraction
/// [m/s].
struct GasRims {
  RimFlux<double> mass, share;

  static GasRims from(auto& take) {
    return {.mass = take(keepsFlux(c::gasMass)), .share = take(keepsFlux(c::gasShare))};
  }
};

/// The fluxes of the state through the rim of the level [kg/(m² s), Pa, W/m²], and the mass fluxes through all faces.
template <int D>
struct RimFluxes {
  RimFlux<double> mass;
  RimFlux<Vec<D>> momentum;
  RimFlux<double> energy;
  FaceMasses<D> masses = {};
  std::vector<GasRims> gases = {};

  static RimFluxes from(auto& take, bool keepsMasses) {
    return {.mass = take(keepsFlux(c::density)),
            .momentum = take(keepsFlux(c::momentum<D>)),
            .energy = take(keepsFlux(c::totalEnergy)),
            .masses = FaceMasses<D>::from(take, keepsMasses)};
  }
};

/// The body of the task that performs one step on a patch. Its parameters are the gas, the old state [kg/m³, kg/(m² s),
/// J/m³] and its time, the time step [s], the new state, and the fluxes through the rim of the level.
///
/// U' = U - dt sum_d (F_{d,i+1/2} - F_{d,i-1/2}) / h_d, for all axes together (unsplit). First order: F follows from
/// the cells on both sides of a face. MUSCL-Hancock: limited slopes of rho, v, p along each axis give values at the
/// faces; the fluxes of these values advance them by half a step; F follows from the advanced values on both sides of a
/// face. A cell with a face value whose density or p + p_inf would not be positive is treated as constant in this step.
/// Sources: B. van Leer, SIAM J. Sci. Stat. Comput. 5 (1984) 1; Toro, sections 6.3, 14.4 and 16.5.
template <int D>
using Advance = void (*)(const Patch& patch, const Gas& gas, const OldState<D>& old, double time, double dt,
                         const NewState<D>& fresh, const RimFluxes<D>& rims);

/// The body of the task for a method and the law of a gas. Each combination is compiled separately, so that no loop
/// over cells branches on them. For a gas with its own law, the flux is HLLC's, and the slopes are van Leer's or none.
template <int D>
Advance<D> chooseAdvance(const Method& method, const Gas& gas = {});

/// The number of ghost layers that a step reads.
inline int reach(const Method& method) { return method.reconstruction == Reconstruction::firstOrder ? 1 : 2; }

}  // namespace tushar::euler
