#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpm::gas {

/// The gas methods, as a part of the component mpm.
simulation::ComponentKind kind();

}  // namespace tushar::mpm::gas
