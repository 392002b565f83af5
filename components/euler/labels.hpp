#pragma once

#include "core/core.hpp"

namespace tushar::euler {

/// Cell variables. The first three are the state; the others are derived if a scene saves them.
namespace c {
inline constexpr CellLabel<double> density{"c.density", "kg/m^3", "mass density"};
template <int D>
inline constexpr CellLabel<Vec<D>> momentum{"c.momentum", "kg/(m^2 s)", "momentum per volume"};
inline constexpr CellLabel<double> totalEnergy{"c.totalEnergy", "J/m^3", "internal and kinetic energy per volume"};
inline constexpr CellLabel<double> pressure{"c.pressure", "Pa", "pressure"};
template <int D>
inline constexpr CellLabel<Vec<D>> velocity{"c.velocity", "m/s", "velocity"};
template <int D>
inline constexpr CellLabel<Vec<D>> mach{"c.mach", "1", "velocity over the speed of sound"};
inline constexpr CellLabel<double> internalEnergy{"c.internalEnergy", "J/kg", "internal energy per mass"};
/// The state of each of several gases.
inline constexpr CellLabel<double> gasMass{"c.gasMass", "kg/m^3", "mass of a gas per volume of the cell"};
inline constexpr CellLabel<double> gasShare{"c.gasShare", "1", "share of a gas in the volume of the cell"};
}  // namespace c

/// The state of gas that flows in through a side of the grid.
namespace boundary {
inline constexpr BoundaryLabel<double> density{"Density"};
inline constexpr BoundaryLabel<Vec3> velocity{"Velocity"};
inline constexpr BoundaryLabel<double> pressure{"Pressure"};
inline constexpr BoundaryLabel<double> temperature{"Temperature"};
/// Lets waves out: the pressure far away [Pa], sigma and 0.
inline constexpr BoundaryLabel<Vec3> waves{"LODI"};
}  // namespace boundary

/// Totals over all cells.
namespace total {
inline constexpr ReductionLabel<Sum> mass{"TotalMass", "kg", "mass in all cells"};
inline constexpr ReductionLabel<VectorSum> momentum{"TotalMomentum", "kg m/s", "momentum in all cells"};
inline constexpr ReductionLabel<Sum> energy{"TotalEnergy", "J", "internal and kinetic energy in all cells"};
inline constexpr ReductionLabel<Sum> kineticEnergy{"KineticEnergy", "J", "kinetic energy of all cells"};
inline constexpr ReductionLabel<Minimum> leastDensity{"LeastDensity", "kg/m^3", "least density of any cell"};
inline constexpr ReductionLabel<Minimum> leastEnergy{"LeastInternalEnergy", "J/kg",
                                                     "least internal energy of any cell"};
inline constexpr ReductionLabel<Sum> entropy{"TotalEntropy", "kg", "entropy of all cells over c_v, up to a constant"};
}  // namespace total

}  // namespace tushar::euler
