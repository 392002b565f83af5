#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/simulation/component.hpp"

// Properties of a component that follow from its task lists.

namespace tushar::scene {

/// The cell variables of a component by name, each with a list of its materials, which is empty for a variable that
/// belongs to no material.
std::map<std::string, std::vector<std::string>> cellVariables(const simulation::Component& component);

/// Whether the component has particles.
bool hasParticles(const simulation::Component& component);

/// Whether the component itself marks cells for refinement.
bool estimatesErrors(const simulation::Component& component);

}  // namespace tushar::scene
