#pragma once

#include <optional>

#include "components/euler/labels.hpp"
#include "components/euler/rows.hpp"

namespace tushar::euler {

/// The state beyond a side of the grid: W = factor * (the mirrored or the nearest cell) + value.
template <int D>
struct GhostRule {
  bool mirrored = false;
  State<D> factor, value;
  double densityOfPressure = 0;  ///< where above 0, rho is that times p, kg/(m³ Pa)
};

/// The rules of both sides of each axis.
template <int D>
using GhostRules = std::array<std::array<GhostRule<D>, 2>, D>;

/// The value that a scene gives for a variable of a gas at a side, if it does.
template <class T>
std::optional<T> givenAt(const Level& level, const Gas& gas, int axis, int side, const BoundaryLabel<T>& label) {
  const auto condition = level.boundary(axis, side, label, gas.material);
  return condition && condition->isDirichlet() ? std::optional(condition->value) : std::nullopt;
}
/// The pressure that a scene gives there. All materials share it: Uintah's scenes give it for material 0.
std::optional<double> pressureAt(const Level& level, const Gas& gas, int axis, int side);

/// Whether a side is a wall: Symmetric, or with a Velocity alone that lies in the side.
template <int D>
bool isWall(const Level& level, const Gas& gas, int axis, int side);

/// From the scene's conditions: a wall mirrors the gas. Where Density, Velocity or Pressure is given, gas of these
/// values flows in; a Temperature makes the third of it, density and pressure. Whatever is not given continues with no
/// gradient, so that a side without conditions is an outflow.
template <int D>
GhostRules<D> ghostRules(const Level& level, const Gas& gas);

/// Ghost rules for diffusion: for differences across the sides of velocities and of temperatures, which replace
/// densities. A given value holds at the side itself; the other values are mirrored.
template <int D>
GhostRules<D> diffusionRules(const Level& level, const Gas& gas);

/// Fills the cells of `rows` that lie beyond the grid; those on the grid must be known.
template <int D>
void fillBeyondGrid(const Level& level, const GhostRules<D>& rules, Rows<D>& rows);

}  // namespace tushar::euler
