#pragma once

#include "core/input/schema.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// The tag `Solver`: how linear systems are solved.
const input::Schema<LinearSettings>& linearSchema();

}  // namespace tushar::solvers
