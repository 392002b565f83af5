#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/core.hpp"
#include "core/input/document.hpp"
#include "core/simulation/component.hpp"

// The fields that modules sample if the variables of a gas belong to no material.

namespace tushar::analysis {

/// Whether a cell variable that belongs to no material is computed by diagnostics (otherwise it is part of the state);
/// none if there is no such variable.
std::optional<bool> isDerived(const simulation::Component& component, std::string_view label);

/// Whether diagnostics compute a total of this name.
bool computesTotal(const simulation::Component& component, std::string_view label);

/// The velocity along an axis at a side of a cell that is also a side of the grid: the velocity given there or, if none
/// is given, that of the gas inside [m/s].
template <int D>
double velocityAtEnd(const Level& level, int axis, int side, int material, const Vec<D>& inside,
                     int part = grid::restOfSide) {
  constexpr BoundaryLabel<Vec3> velocity{"Velocity"};
  if (level.isSymmetry(axis, side, material, part)) return 0;
  const auto given = level.boundary(axis, side, velocity, material, part);
  const bool isNumber = given && given->isDirichlet() && !given->formula;
  return isNumber ? given->value[level.axis(axis)] : inside[axis];
}

/// The number of bodies, which is also the index of the gas among the materials of the scene, since bodies come first.
int bodiesOf(const simulation::Component& component);

/// Throws InputError if the <material> of a module is not a gas of the component. The tag may be missing; as in Uintah,
/// it may have any text if the scene has only one material.
void checkGas(const std::string& material, const simulation::Component& component, const input::Element& module);

}  // namespace tushar::analysis
