#pragma once

#include "components/mpm/solid/loads/load.hpp"

namespace tushar::mpm::solid {

/// The loads of the `PhysicalBC` section, if the scene has one; those with a load curve only where `usesCurves`.
Loads readLoads(const input::Element& root, bool usesCurves, input::Diagnostics& diagnostics);

/// The manual.
void describeLoads(std::ostream& out);
/// How the section is read.
const input::SchemaBase& loadsForm();

}  // namespace tushar::mpm::solid
