#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Reads a scene of solids; every problem goes to the diagnostics.
simulation::MakeComponent readScene(const input::Element& root, input::Diagnostics& diagnostics);

/// The manual.
void describe(std::ostream& out);

}  // namespace tushar::mpm::solid
