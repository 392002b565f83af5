#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar {

/// All components and analyses, linked statically, for tests and other programs that do not load modules.
simulation::Catalogue catalogue();

}  // namespace tushar
