#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid {

/// What sus knows of solids with implicit time steps.
simulation::ComponentKind implicitKind();

}  // namespace tushar::mpm::solid
