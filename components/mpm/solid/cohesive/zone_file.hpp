#pragma once

#include <string>
#include <vector>

#include "components/mpm/solid/cohesive/zones.hpp"
#include "core/input/diagnostics.hpp"

namespace tushar::mpm::solid {

/// Reads a file with a cohesive zone per line, 12 numbers: x y z, area, the normal, a tangent, and the indices of the
/// bottom and of the top material, of which there are `materials`. The location `named` is where the scene names the
/// file. Reports all problems.
std::vector<CohesiveZone> readZones(const std::string& path, const Location& named, int materials,
                                    input::Diagnostics& diagnostics);

}  // namespace tushar::mpm::solid
