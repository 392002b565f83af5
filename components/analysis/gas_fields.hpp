#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/input/document.hpp"
#include "core/simulation/component.hpp"

// The fields that modules sample where the variables of a gas belong to no material.

namespace tushar::analysis {

/// Whether diagnostics compute a cell variable without a material; false if it is part of the state; none if there is
/// no such variable.
std::optional<bool> isDerived(const simulation::Component& component, std::string_view label);

/// The number of materials before the gas, which is also the index of the gas in the scene.
int bodiesOf(const simulation::Component& component);

/// Throws InputError if the <material> of a module is not a gas of the component. A missing <material> is correct, and
/// as in Uintah any name if there is one material.
void checkGas(const std::string& material, const simulation::Component& component, const input::Element& module);

}  // namespace tushar::analysis
