#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/input/document.hpp"
#include "core/simulation/component.hpp"

// The fields that modules sample where the variables of a gas belong to no material.

namespace tushar::analysis {

/// Whether diagnostics compute a cell variable that belongs to no material, rather than the state containing it; none
/// if there is no such variable.
std::optional<bool> isDerived(const simulation::Component& component, std::string_view label);

/// The number of bodies, which is also the index of the gas among the materials of the scene, since bodies come first.
int bodiesOf(const simulation::Component& component);

/// Throws InputError if the <material> of a module is not a gas of the component. The tag may be missing; as in Uintah,
/// it may have any text if the scene has only one material.
void checkGas(const std::string& material, const simulation::Component& component, const input::Element& module);

}  // namespace tushar::analysis
