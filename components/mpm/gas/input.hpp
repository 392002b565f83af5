#pragma once

#include <ostream>

#include "core/input/document.hpp"
#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::gas {

/// Whether a scene has a gas method.
bool isGas(const input::Element& root);

/// Reads a scene of gases; every problem goes to the diagnostics.
simulation::MakeComponent readScene(const input::Element& root, input::Diagnostics& diagnostics);

/// The sections of such a scene, for the schemas of editors: a list for each method.
std::vector<std::vector<simulation::SectionForm>> forms();

/// Prints the reference of all tags.
void describe(std::ostream& out);

}  // namespace tushar::mpm::gas
