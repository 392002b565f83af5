#pragma once

#include <string>
#include <vector>

#include "components/mpm/solid/cohesive/law.hpp"
#include "core/core.hpp"

namespace tushar::mpm::solid {

/// A cohesive zone at the start: a piece of the surface along which two bodies are glued together.
struct CohesiveZone {
  Vec3 position = Vec3::Zero();  ///< position of its centre [m]
  double area = 0;               ///< its area [m^2]
  Vec3 normal = Vec3::Zero();    ///< unit normal, from the bottom body to the top body
  int bottom = 0, top = 0;       ///< indices of the materials of both bodies
  int line = 0;                  ///< line of the file
};

/// The cohesive zones of one tag `cohesive_zone`: a material whose particles are zones instead of pieces of a body.
struct CohesiveZones {
  std::string name;
  CohesiveLaw law;
  std::string file;  ///< name of the file with the zones
  Location where;    ///< location of the tag in the scene
  std::vector<CohesiveZone> zones;
};

/// How a cohesive zone failed, stored as p.czMode.
namespace zoneMode {
inline constexpr int intact = 0;    ///< it has not failed
inline constexpr int opened = 1;    ///< its normal jump exceeded the limit: mode I
inline constexpr int sheared = 2;   ///< its tangential jump did: mode II
inline constexpr int mixed = 3;     ///< both did in the same step
inline constexpr int detached = 4;  ///< one of the two bodies is nowhere near it
}  // namespace zoneMode

/// The number of steps in which the traction of a zone that fails falls to zero, as in Uintah.
inline constexpr int stepsOfFailure = 1000;

}  // namespace tushar::mpm::solid
