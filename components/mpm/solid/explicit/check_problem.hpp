#pragma once

#include "components/mpm/solid/problem.hpp"
#include "core/input/element.hpp"

namespace tushar::mpm::solid {

/// Refuses loads, contacts and settings of the method that conflict with each other. Reports problems to the
/// diagnostics.
void checkProblem(const Problem& problem, const input::Element& root, input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
