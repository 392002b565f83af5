#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm {

/// What sus knows of this component.
simulation::ComponentKind kind();

}  // namespace tushar::mpm
