#include "components/reference/piecewise_mean.hpp"

#include <cmath>

namespace tushar::reference {

bool Plane::cuts(const Vec3& lower, const Vec3& upper) const {
  const double middle = 0.5 * normal.dot(lower + upper) - distance;
  return std::abs(middle) < 0.5 * normal.cwiseAbs().dot(upper - lower);
}

void Plane::addBreaks(int axis, const Vec3& lower, const Vec3& upper, const Vec3& x,
                      std::vector<double>& breaks) const {
  if (normal[axis] == 0) return;
  double rest = distance;
  for (int d = 0; d < axis; ++d) rest -= normal[d] * x[d];
  const int later = 2 - axis;
  for (int corner = 0; corner < 1 << later; ++corner) {
    double along = rest;
    for (int k = 0; k < later; ++k) {
      const int d = axis + 1 + k;
      along -= normal[d] * (corner >> k & 1 ? upper[d] : lower[d]);
    }
    breaks.push_back(along / normal[axis]);
  }
}

bool Sphere::cuts(const Vec3& lower, const Vec3& upper) const {
  double nearest = 0, farthest = 0;
  for (int d = 0; d < 3; ++d) {
    const double near = std::clamp(centre[d], lower[d], upper[d]) - centre[d];
    const double far = std::max(std::abs(lower[d] - centre[d]), std::abs(upper[d] - centre[d]));
    nearest += round[d] * near * near;
    farthest += round[d] * far * far;
  }
  return nearest < radius * radius && radius * radius < farthest;
}

void Sphere::addBreaks(int axis, const Vec3& lower, const Vec3& upper, const Vec3& x,
                       std::vector<double>& breaks) const {
  if (round[axis] == 0) return;
  double rest = radius * radius;
  for (int d = 0; d < axis; ++d) rest -= round[d] * (x[d] - centre[d]) * (x[d] - centre[d]);
  // Along each later axis, the sphere may meet an end of the box, or have its extreme point within the box.
  for (int choice = 0; choice < std::array{9, 3, 1}[axis]; ++choice) {
    double square = rest;
    for (int d = axis + 1, picks = choice; d < 3; ++d, picks /= 3) {
      const Vec3 places(lower[d], upper[d], std::clamp(centre[d], lower[d], upper[d]));
      const double away = places[picks % 3] - centre[d];
      square -= round[d] * away * away;
    }
    if (square < 0) continue;
    breaks.push_back(centre[axis] - std::sqrt(square));
    breaks.push_back(centre[axis] + std::sqrt(square));
  }
}

}  // namespace tushar::reference
