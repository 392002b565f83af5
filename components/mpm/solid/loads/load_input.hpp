#pragma once

#include "components/mpm/solid/loads/load.hpp"

namespace tushar::mpm::solid {

/// Whether a scene uses load curves, and whether it is axisymmetric.
struct LoadSwitches {
  bool usesCurves = false, aroundAxis = false;
};
/// Reads the loads in the section `PhysicalBC`, if the scene has one; loads with a load curve only if the scene uses
/// them.
Loads readLoads(const input::Element& root, const LoadSwitches& switches, input::Diagnostics& diagnostics);

/// Prints the manual of the `PhysicalBC` section.
void describeLoads(std::ostream& out);
/// The schema of the section `PhysicalBC`.
const input::SchemaBase& loadsForm();

}  // namespace tushar::mpm::solid
