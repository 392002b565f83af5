#pragma once

#include "core/core.hpp"
#include "core/simulation/conserved.hpp"

// Variables of all methods; gas/labels.hpp and solid/labels.hpp add their own.

namespace tushar::mpm {

/// Labels of particle variables.
namespace p {
template <int D>
inline constexpr ParticleLabel<Vec<D>> x{"p.x", "m", "position"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> velocity{"p.velocity", "m/s", "velocity"};
inline constexpr ParticleLabel<double> mass{"p.mass", "kg", "mass"};
inline constexpr ParticleLabel<double> volume{"p.volume", "m^3", "volume: mass divided by density"};
}  // namespace p

/// Labels of node variables.
namespace g {
inline constexpr NodeLabel<double> mass{"g.mass", "kg", "mass gathered from particles"};
template <int D>
inline constexpr NodeLabel<Vec<D>> velocity{"g.velocity", "m/s", "velocity before the step"};
template <int D>
inline constexpr NodeLabel<Vec<D>> internalForce{"g.internalforce", "N", "force due to the stresses around the node"};
template <int D>
inline constexpr NodeLabel<Vec<D>> acceleration{
    "g.acceleration", "m/s^2", "acceleration due to the stresses alone: internal force divided by mass"};
}  // namespace g

/// Labels of totals over all particles.
namespace total {
using simulation::total::kineticEnergy;
using simulation::total::mass;
using simulation::total::momentum;
inline constexpr ReductionLabel<VectorSum> centerOfMass{"CenterOfMassPosition", "kg m",
                                                        "sum of mass times position, as in Uintah"};
}  // namespace total

}  // namespace tushar::mpm
