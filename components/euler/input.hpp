#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::euler {

/// The entry of this component in the table of sus.
simulation::ComponentKind kind();

}  // namespace tushar::euler
