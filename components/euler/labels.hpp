#pragma once

#include "components/reference/gas_totals.hpp"

namespace tushar::euler {

/// Labels of the state of a gas.
template <int D>
struct StateLabels {
  CellLabel<double> density;
  CellLabel<Vec<D>> momentum;
  CellLabel<double> totalEnergy;
};

/// Labels of cell variables. The first three are the state; the others are derived if a scene saves them.
namespace c {
inline constexpr CellLabel<double> density{"c.density", "kg/m^3", "mass density"};
template <int D>
inline constexpr CellLabel<Vec<D>> momentum{"c.momentum", "kg/(m^2 s)", "momentum per volume"};
inline constexpr CellLabel<double> totalEnergy{"c.totalEnergy", "J/m^3", "internal and kinetic energy per volume"};
inline constexpr CellLabel<double> pressure{"c.pressure", "Pa", "pressure"};
template <int D>
inline constexpr CellLabel<Vec<D>> velocity{"c.velocity", "m/s", "velocity"};
template <int D>
inline constexpr CellLabel<Vec<D>> mach{"c.mach", "1", "Mach number: speed divided by the speed of sound"};
inline constexpr CellLabel<double> internalEnergy{"c.internalEnergy", "J/kg", "internal energy per mass"};
/// State variables of each gas, if there are several.
inline constexpr CellLabel<double> gasMass{"c.gasMass", "kg/m^3", "mass of one of several gases, per cell volume"};
inline constexpr CellLabel<double> gasShare{"c.gasShare", "1", "fraction of the cell that one of several gases fills"};
}  // namespace c

/// Labels of the state of gas that flows in through a side of the grid.
namespace boundary {
inline constexpr BoundaryLabel<double> density{"Density"};
inline constexpr BoundaryLabel<Vec3> velocity{"Velocity"};
inline constexpr BoundaryLabel<double> pressure{"Pressure"};
inline constexpr BoundaryLabel<double> temperature{"Temperature"};
/// The non-reflecting condition, which lets waves out. Its three components are the far-field pressure [Pa], sigma, and
/// 0.
inline constexpr BoundaryLabel<Vec3> waves{"LODI"};
}  // namespace boundary

/// Labels of totals over all cells.
namespace total {
using namespace simulation::total;
using namespace reference::total;
}  // namespace total

}  // namespace tushar::euler
