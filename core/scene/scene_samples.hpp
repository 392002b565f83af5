#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"

namespace tushar::scene {

/// Variables of a component and its modules that have another name in Uintah: pairs of Uintah's and Tushar's name.
simulation::OtherNames otherNames(const simulation::Component& component,
                                  const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);
/// The name in Tushar of a variable that a scene may call by Uintah's name; other names are returned unchanged.
std::string nameHere(const simulation::OtherNames& names, const std::string& name);

/// Replaces the names and materials of sampled variables by those of Tushar, and removes, with a note, variables of
/// Uintah that no task computes. Reports materials that do not exist, and variables that are neither on cells nor on
/// nodes.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses, input::Diagnostics& diagnostics);

/// Like the function above, but without notes, for the same modules on another grid.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);

}  // namespace tushar::scene
