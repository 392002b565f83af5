#pragma once

#include <string>
#include <vector>

#include "core/core.hpp"
#include "core/input/diagnostics.hpp"

namespace tushar::mpm::solid {

/// An event at one time: the particles of one color move by a distance and get a new velocity.
struct Insertion {
  double time = 0;  ///< time [s]
  double color = 0;
  Vec3 shift = Vec3::Zero();     ///< shift [m]
  Vec3 velocity = Vec3::Zero();  ///< velocity [m/s]

  /// Whether the insertion happens in the step of length `dt` [s] that begins at `start` [s].
  bool isIn(double start, double dt) const { return start <= time && time < start + dt; }
};

/// Reads insertions, each with 8 numbers: time [s], color, the components of the shift [m] and of the new velocity
/// [m/s]. Reports problems to the diagnostics with file and line, and problems of the whole file at the tag that names
/// the file.
std::vector<Insertion> readInsertions(const std::string& path, const Location& named, input::Diagnostics& diagnostics);
/// Throws InputError at the location of <MPM> if particles would move along an axis that the grid does not use.
void refuseShifts(const Level& level, const std::vector<Insertion>& insertions, const Location& where);

}  // namespace tushar::mpm::solid
