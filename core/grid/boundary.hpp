#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// One `BCType` of a `Face`: what a variable does at a side of the domain.
struct BoundaryCondition {
  std::string variable;       ///< the `label` attribute: Symmetric, Velocity, Temperature, …
  std::string kind;           ///< the `var` attribute: symmetry, Dirichlet, Neumann
  Vec3 value = Vec3::Zero();  ///< a scalar stands in the first component; the unit is the variable's
  int material = -1;          ///< the number of the one that it holds for; -1: all
};

/// The conditions of the six faces x-, x+, y-, y+, z-, z+ in this order. A face with none is free.
struct BoundaryConditions {
  std::array<std::vector<BoundaryCondition>, 6> faces;

  std::vector<BoundaryCondition>& face(int axis, int side) { return faces[2 * axis + side]; }
  const std::vector<BoundaryCondition>& face(int axis, int side) const { return faces[2 * axis + side]; }
};

}  // namespace tushar::grid
