#pragma once

#include "components/mpm/solid/loads/load.hpp"

namespace tushar::mpm::solid {

/// The loads of the `PhysicalBC` section, if the scene has one.
std::vector<PressureLoad> readLoads(const input::Element& root, input::Diagnostics& diagnostics);

/// The manual.
void describeLoads(std::ostream& out);

}  // namespace tushar::mpm::solid
