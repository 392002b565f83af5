#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::euler {

/// Describes this component to sus.
simulation::ComponentKind kind();

}  // namespace tushar::euler
