#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/simulation/component.hpp"

// Properties of a component that follow from its task lists.

namespace tushar::scene {

/// The materials of the variables of cells that a component has, by name; empty for one that belongs to none.
std::map<std::string, std::vector<std::string>> cellVariables(const simulation::Component& component);

/// Whether it makes particles.
bool hasParticles(const simulation::Component& component);

/// Whether it marks cells that must be finer itself.
bool estimatesErrors(const simulation::Component& component);

}  // namespace tushar::scene
