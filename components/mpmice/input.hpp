#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpmice {

/// Bodies and a gas that act on each other; where `areRigid`, bodies that the gas cannot move.
simulation::ComponentKind kind(bool areRigid);

}  // namespace tushar::mpmice
