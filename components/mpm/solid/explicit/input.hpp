#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// Solids with explicit time steps, as a part of the component mpm.
simulation::ComponentKind kind();

}  // namespace tushar::mpm::solid
