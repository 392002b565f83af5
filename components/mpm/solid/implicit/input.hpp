#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid::implicit {

/// Describes the component of solids with implicit time steps to sus.
simulation::ComponentKind implicitKind();

}  // namespace tushar::mpm::solid::implicit
