#include "core/grid/side_part.hpp"

#include <cmath>

namespace tushar::grid {

namespace {

constexpr double slackOfSize = 1e-9;

}  // namespace

SidePart SidePart::circle(int axis, const Vec3& origin, double radius) {
  SidePart part;
  part.axis_ = axis;
  part.oval_ = Oval{origin, origin, 2 * radius};
  part.outer_ = {origin.array() - radius, origin.array() + radius};
  return part;
}

SidePart SidePart::annulus(int axis, const Vec3& origin, double inner, double outer) {
  SidePart part = circle(axis, origin, outer);
  part.ovalHole_ = Oval{origin, origin, 2 * inner};
  return part;
}

SidePart SidePart::ellipse(int axis, int side, const Vec3& origin, double shorter, double longer, double degrees) {
  const double angle = degrees * M_PI / 180, focus = std::sqrt((longer - shorter) * (longer + shorter));
  Vec3 along = Vec3::Zero();
  along[(axis + 1) % 3] = std::cos(angle);
  along[(axis + 2) % 3] = side == 0 ? -std::sin(angle) : std::sin(angle);
  SidePart part = circle(axis, origin, longer);
  part.oval_ = Oval{origin - focus * along, origin + focus * along, 2 * longer};
  return part;
}

SidePart SidePart::rectangle(int axis, const Vec3& lower, const Vec3& upper) {
  SidePart part;
  part.axis_ = axis;
  part.outer_ = {lower, upper};
  return part;
}

SidePart SidePart::rectangulus(int axis, const std::array<Vec3, 2>& inner, const std::array<Vec3, 2>& outer) {
  SidePart part = rectangle(axis, outer[0], outer[1]);
  part.hole_ = Corners{inner[0], inner[1]};
  return part;
}

bool SidePart::isIn(const Corners& corners, const Vec3& x) const {
  const double slack = slackOfSize * (corners.upper - corners.lower).maxCoeff();
  for (int d = 0; d < 3; ++d)
    if (d != axis_ && !(x[d] >= corners.lower[d] - slack && x[d] <= corners.upper[d] + slack)) return false;
  return true;
}

bool SidePart::isIn(const Oval& oval, const Vec3& x) const {
  const auto distance = [&](const Vec3& focus) {
    Vec3 away = x - focus;
    away[axis_] = 0;
    return away.norm();
  };
  return distance(oval.first) + distance(oval.second) <= oval.sum * (1 + slackOfSize);
}

bool SidePart::holds(const Vec3& x) const {
  if (!oval_) return isIn(outer_, x) && !(hole_ && isIn(*hole_, x));
  return isIn(*oval_, x) && !(ovalHole_ && isIn(*ovalHole_, x));
}

}  // namespace tushar::grid
