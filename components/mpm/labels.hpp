#pragma once

#include "core/core.hpp"

namespace tushar::mpm {

/// Particle variables.
namespace p {
template <int D>
inline constexpr ParticleLabel<Vec<D>> x{"p.x", "m", "position"};
template <int D>
inline constexpr ParticleLabel<Vec<D>> velocity{"p.velocity", "m/s", "velocity"};
inline constexpr ParticleLabel<double> mass{"p.mass", "kg", "mass"};
inline constexpr ParticleLabel<double> volume{"p.volume", "m^3", "volume, mass over density"};
inline constexpr ParticleLabel<double> density{"p.density", "kg/m^3", "mass density", Bound::positive};
inline constexpr ParticleLabel<double> internalEnergy{"p.internalEnergy", "J/kg", "internal energy per mass",
                                                      Bound::nonNegative};
inline constexpr ParticleLabel<double> pressure{"p.pressure", "Pa", "pressure, artificial viscosity included"};
inline constexpr ParticleLabel<double> velocityDivergence{"p.velocityDivergence", "1/s",
                                                          "divergence of the velocity in the cell of the last step"};
}  // namespace p

/// Node variables.
namespace g {
inline constexpr NodeLabel<double> mass{"g.mass", "kg", "mass gathered from particles"};
template <int D>
inline constexpr NodeLabel<Vec<D>> velocity{"g.velocity", "m/s", "velocity before the step"};
template <int D>
inline constexpr NodeLabel<Vec<D>> internalForce{"g.internalforce", "N", "force of the stresses in the cells around"};
template <int D>
inline constexpr NodeLabel<Vec<D>> acceleration{"g.acceleration", "m/s^2",
                                                "by the stresses alone: internal force over mass"};
template <int D>
inline constexpr NodeLabel<Vec<D>> velocityStar{"g.velocity_star", "m/s", "velocity at the end of the step",
                                                Bound::finite};
}  // namespace g

/// Cell variables.
namespace c {
inline constexpr CellLabel<double> density{"c.density", "kg/m^3", "mean density of the particles in the cell"};
}  // namespace c

/// Totals over all particles.
namespace total {
inline constexpr ReductionLabel<Sum> mass{"TotalMass", "kg", "mass of all particles"};
inline constexpr ReductionLabel<VectorSum> momentum{"TotalMomentum", "kg m/s", "momentum of all particles"};
inline constexpr ReductionLabel<Sum> kineticEnergy{"KineticEnergy", "J", "kinetic energy of all particles"};
inline constexpr ReductionLabel<Sum> internalEnergy{"InternalEnergy", "J", "internal energy of all particles"};
inline constexpr ReductionLabel<Sum> energy{"TotalEnergy", "J", "kinetic and internal energy of all particles"};
inline constexpr ReductionLabel<Minimum> leastDensity{"LeastDensity", "kg/m^3", "least density of any particle"};
inline constexpr ReductionLabel<Minimum> leastEnergy{"LeastInternalEnergy", "J/kg",
                                                     "least internal energy of any particle"};
inline constexpr ReductionLabel<Sum> entropy{"TotalEntropy", "kg",
                                             "entropy of all particles over c_v, but for a constant"};
inline constexpr ReductionLabel<VectorSum> centerOfMass{"CenterOfMassPosition", "kg m",
                                                        "sum of mass times position, as in Uintah"};
}  // namespace total

}  // namespace tushar::mpm
