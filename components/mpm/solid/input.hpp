#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Reads a scene of solids; every problem goes to the diagnostics.
simulation::MakeComponent readScene(const input::Element& root, input::Diagnostics& diagnostics);

/// Layers of nodes that the scene's interpolator needs beyond the sides of the grid.
int nodesBeyond(const input::Element& root);

/// The manual.
void describe(std::ostream& out);

}  // namespace tushar::mpm::solid
