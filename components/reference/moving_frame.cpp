#include "components/reference/moving_frame.hpp"

#include <cmath>

namespace tushar::reference {

Vec3 MovingFrame::offset(const Vec3& x, double t) const {
  Vec3 away = x - start - t * velocity;
  for (int d = 0; d < 3; ++d)
    if (periods[d] > 0) away[d] -= periods[d] * std::nearbyint(away[d] / periods[d]);
  return away;
}

std::vector<Plane> MovingFrame::seams(int axis, const Vec3& lower, const Vec3& upper, double t) const {
  std::vector<Plane> planes;
  const double period = periods[axis];
  if (!(period > 0)) return planes;
  const double first = start[axis] + t * velocity[axis] + 0.5 * period;
  for (double k = std::ceil((lower[axis] - first) / period); first + k * period < upper[axis]; ++k)
    planes.push_back({Vec3::Unit(axis), first + k * period});
  return planes;
}

}  // namespace tushar::reference
