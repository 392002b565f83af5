#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/input/document.hpp"
#include "core/simulation/component.hpp"

// The fields that modules sample where the variables of a gas belong to no material.

namespace tushar::analysis {

/// Whether diagnostics compute a variable of cells that belongs to no material from the state; false where it is of the
/// state, and none if there is no such variable.
std::optional<bool> isDerived(const simulation::Component& component, std::string_view label);

/// The number of materials of a component before its gas, which is the number of the gas in the scene.
int bodiesOf(const simulation::Component& component);

/// Throws InputError for a <material> of a module that is no gas of the component. No <material> is correct, and as in
/// Uintah any name if there is one material.
void checkGas(const std::string& material, const simulation::Component& component, const input::Element& module);

}  // namespace tushar::analysis
