#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar {

/// Everything that sus knows.
simulation::Catalogue catalogue();

}  // namespace tushar
