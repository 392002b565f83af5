#pragma once

#include <vector>

#include "components/reference/piecewise_mean.hpp"

namespace tushar::reference {

/// A place that moves at a constant velocity through a grid that repeats.
struct MovingFrame {
  Vec3 start = Vec3::Zero();     ///< where it is at t = 0, m
  Vec3 velocity = Vec3::Zero();  ///< m/s
  Vec3 periods = Vec3::Zero();   ///< lengths along x, y, z after which it repeats, m; 0 if it does not

  /// The vector from its nearest image at time `t` (s) to `x`, m.
  Vec3 offset(const Vec3& x, double t) const;
  /// The planes across `axis` inside the box [lower, upper] half-way between two images.
  std::vector<Plane> seams(int axis, const Vec3& lower, const Vec3& upper, double t) const;
};

}  // namespace tushar::reference
