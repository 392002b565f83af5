#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::euler {

/// What sus knows of this component.
simulation::ComponentKind kind();

}  // namespace tushar::euler
