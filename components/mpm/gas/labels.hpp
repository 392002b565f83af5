#pragma once

#include "components/mpm/labels.hpp"
#include "components/reference/gas_totals.hpp"

namespace tushar::mpm::gas {

/// Labels of particle variables.
namespace p {
using namespace mpm::p;
inline constexpr ParticleLabel<double> density{"p.density", "kg/m^3", "mass density", Bound::positive};
inline constexpr ParticleLabel<double> internalEnergy{"p.internalEnergy", "J/kg", "internal energy per mass",
                                                      Bound::nonNegative};
inline constexpr ParticleLabel<double> pressure{"p.pressure", "Pa", "pressure, artificial viscosity included"};
inline constexpr ParticleLabel<double> velocityDivergence{
    "p.velocityDivergence", "1/s", "divergence of the velocity in the particle's cell in the latest step"};
}  // namespace p

/// Labels of node variables.
namespace g {
using namespace mpm::g;
template <int D>
inline constexpr NodeLabel<Vec<D>> velocityStar{"g.velocity_star", "m/s", "velocity at the end of the step",
                                                Bound::finite};
}  // namespace g

/// Labels of cell variables.
namespace c {
inline constexpr CellLabel<double> density{"c.density", "kg/m^3", "mean density of the particles in the cell"};
}  // namespace c

/// Labels of totals over all particles.
namespace total {
using namespace mpm::total;
inline constexpr ReductionLabel<Sum> internalEnergy{"InternalEnergy", "J", "internal energy of all particles"};
using namespace reference::total;
using simulation::total::energy;
}  // namespace total

}  // namespace tushar::mpm::gas
