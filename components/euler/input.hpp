#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::euler {

/// The description of this component for sus.
simulation::ComponentKind kind();

}  // namespace tushar::euler
