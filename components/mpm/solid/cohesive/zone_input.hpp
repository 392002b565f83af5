#pragma once

#include <optional>
#include <string>
#include <vector>

#include "components/mpm/solid/cohesive/zones.hpp"
#include "core/input/schema.hpp"

namespace tushar::mpm::solid {

struct Problem;

/// The content of a tag `cohesive_zone`.
struct ZonesTag {
  std::string name, file;
  Location where;
  double normalLength = 1, tangentialLength = 1, normalStrength = 0, tangentialStrength = 0;
  std::optional<double> normalFailureLength, tangentialFailureLength;
};
const input::Schema<ZonesTag>& zonesSchema();
/// Whether a scene has cohesive zones; whether it also has a gas, or is axisymmetric.
struct ZoneSwitches {
  bool usesZones = false, besideGas = false, isAxisymmetric = false;
};
/// Gives the problem the cohesive zones of the tags of a scene, with the zones of their files, if the scene uses them;
/// otherwise notes that the tags have no effect. Called after the materials have their names.
void settleZones(Problem& problem, const std::vector<ZonesTag>& tags, const ZoneSwitches& switches,
                 const input::Element& root, input::Diagnostics& diagnostics);
/// Removes zones outside the grid, and exchanges the bodies of zones whose normals point the wrong way; notes both.
/// Throws InputError for normals along an axis that the grid does not use.
void placeZones(const Level& level, Problem& problem);

}  // namespace tushar::mpm::solid
