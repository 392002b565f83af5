#pragma once

#include <vector>

#include "components/reference/piecewise_mean.hpp"

namespace tushar::reference {

/// A point that moves at a constant velocity through a periodic grid.
struct MovingFrame {
  Vec3 start = Vec3::Zero();     ///< position at t = 0 [m]
  Vec3 velocity = Vec3::Zero();  ///< velocity [m/s]
  Vec3 periods = Vec3::Zero();   ///< lengths along x, y, z after which the grid repeats [m]; 0 if it does not

  /// The vector [m] from the nearest image of the point at time `t` [s] to `x`.
  Vec3 offset(const Vec3& x, double t) const;
  /// The planes half-way between two images along `axis` that cut the box [lower, upper].
  std::vector<Plane> seams(int axis, const Vec3& lower, const Vec3& upper, double t) const;
};

}  // namespace tushar::reference
