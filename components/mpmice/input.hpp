#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::mpmice {

/// Describes the component for a gas and bodies that interact. If `areRigid`, the gas does not move the bodies.
simulation::ComponentKind kind(bool areRigid);

}  // namespace tushar::mpmice
