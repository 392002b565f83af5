#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"

namespace tushar::scene {

/// What Uintah calls variables of a component and its modules that have another name here, and that name.
simulation::OtherNames otherNames(const simulation::Component& component,
                                  const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);
/// The name here of a variable that a scene may call as Uintah does; any other name as it is.
std::string nameHere(const simulation::OtherNames& names, const std::string& name);

/// Gives the variables that modules sample the names and materials that they have here, and takes out, with a note,
/// what Uintah has and no task computes here. Names materials that there are not, and variables that are neither of
/// cells nor of nodes.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses, input::Diagnostics& diagnostics);

/// The same where it has been said, of the same modules on another grid.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);

}  // namespace tushar::scene
