#pragma once

#include "components/mpm/solid/loads/load.hpp"

namespace tushar::mpm::solid {

/// Reads the loads in the section `PhysicalBC`, if the scene has one; loads with a load curve only if `usesCurves`.
Loads readLoads(const input::Element& root, bool usesCurves, input::Diagnostics& diagnostics);

/// Prints the manual of the `PhysicalBC` section.
void describeLoads(std::ostream& out);
/// The schema of the section `PhysicalBC`.
const input::SchemaBase& loadsForm();

}  // namespace tushar::mpm::solid
