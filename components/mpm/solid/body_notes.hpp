#pragma once

#include <vector>

#include "components/mpm/solid/problem.hpp"

namespace tushar::mpm::solid {

/// Notes on the bodies of a scene: those without particles, which are outside the grid or between the points at which
/// particles would start, and those that overlap another body of the same material. Bodies that wait for their
/// insertion may overlap. And notes on loads and masters that move nothing, because the grid has one cell along their
/// axes.
std::vector<InputProblem> notesOnBodies(const Level& level, const Problem& problem);

}  // namespace tushar::mpm::solid
