#pragma once

#include "components/mpm/mpm.hpp"
#include "components/mpm/solid/problem.hpp"

namespace tushar::mpm::solid {

/// Describes solids with explicit time steps, as a part of the component mpm.
MethodKind kind();

/// Prints the manual of the sections.
void describe(std::ostream& out);

/// Constructs solids in a surrounding medium; if `areRigid`, their stresses exert no force.
using MakeSurrounded = std::function<std::unique_ptr<Solids>(const Level& level, bool areRigid,
                                                             std::shared_ptr<const Surroundings> surroundings)>;
/// The solids of a scene that also has a gas.
struct SurroundedSolids {
  MakeSurrounded make;
  std::vector<Material> materials;
};
/// Reads the solids of a scene that also has a gas; returns an empty function and no materials if there are problems,
/// which are reported to the diagnostics.
SurroundedSolids readSurrounded(const input::Element& root, input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
