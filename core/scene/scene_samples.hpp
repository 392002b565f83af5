#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/input/diagnostics.hpp"
#include "core/simulation/analysis.hpp"
#include "core/simulation/component.hpp"

namespace tushar::scene {

/// Uintah's names of variables of a component and its modules whose names differ in Tushar, with the names in Tushar.
simulation::OtherNames otherNames(const simulation::Component& component,
                                  const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);
/// The name in Tushar of a variable for which a scene may use Uintah's name; other names stay as they are.
std::string nameHere(const simulation::OtherNames& names, const std::string& name);

/// Replaces the names and materials of sampled variables by those used here, and removes, with a note, variables of
/// Uintah that no task computes here. Reports materials that do not exist, and variables that are neither of cells nor
/// of nodes.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses, input::Diagnostics& diagnostics);

/// As above without notes, for the same modules on another grid.
void settleSamples(const simulation::Component& component,
                   const std::vector<std::unique_ptr<simulation::Analysis>>& analyses);

}  // namespace tushar::scene
