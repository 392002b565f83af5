#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::solid::implicit {

/// The component of solids with implicit time steps, for sus.
simulation::ComponentKind implicitKind();

}  // namespace tushar::mpm::solid::implicit
