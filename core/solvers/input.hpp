#pragma once

#include "core/input/schema.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// The schema of the tag `Solver`, with settings for linear systems. The defaults suit symmetric systems.
const input::Schema<LinearSettings>& linearSchema();
/// The schema of the tags for the linear systems in Newton's method, whose tangents need not be symmetric.
const input::Schema<LinearSettings>& tangentSchema();

}  // namespace tushar::solvers
