#pragma once

#include "core/input/schema.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// The tag `Solver`: how linear systems are solved. The defaults are for symmetric ones.
const input::Schema<LinearSettings>& linearSchema();
/// The tags of the linear solves of Newton's method, whose tangents need not be symmetric.
const input::Schema<LinearSettings>& tangentSchema();

}  // namespace tushar::solvers
