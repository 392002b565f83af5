#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Reads a scene of solids; every problem goes to the diagnostics.
simulation::MakeComponent readScene(const input::Element& root, input::Diagnostics& diagnostics);

/// The sections of such a scene, for the schemas of editors.
std::vector<simulation::SectionForm> forms();

/// The manual.
void describe(std::ostream& out);

}  // namespace tushar::mpm::solid
