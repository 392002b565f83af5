#pragma once

#include <string>
#include <vector>

#include "components/euler/settings.hpp"
#include "core/core.hpp"
#include "core/input/expression.hpp"

namespace tushar::input {
class Element;
}

namespace tushar::euler {

/// A vector of a scene, and the path of its tag.
struct GivenVector {
  Location where;  ///< in the scene
  std::string path;
  input::VectorExpression value;
};

/// The velocities that a scene gives at sides of the grid.
std::vector<GivenVector> velocitiesAtSides(const input::Element& root);
/// The velocities of the gas at the start; `path` is that of its geom_object.
std::vector<GivenVector> velocitiesAtStart(const Settings& gas, const std::string& path);

/// Throws InputError if a vector has a component along a periodic axis with one cell: a flow along such an axis has no
/// walls and no planes of symmetry that stop it, but velocities have no component along an axis with one cell.
void refuseAlongFlatAxes(const Level& level, const std::vector<GivenVector>& vectors);

}  // namespace tushar::euler
