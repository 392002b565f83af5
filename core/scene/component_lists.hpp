#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/simulation/component.hpp"

// Properties of a component that follow from its task lists.

namespace tushar::scene {

/// The cell variables of a component by name, each with its materials; the list is empty if it belongs to none.
std::map<std::string, std::vector<std::string>> cellVariables(const simulation::Component& component);

/// Whether the component has particles.
bool hasParticles(const simulation::Component& component);

/// Whether the component itself marks cells for refinement.
bool estimatesErrors(const simulation::Component& component);

}  // namespace tushar::scene
