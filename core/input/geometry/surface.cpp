#include "core/input/geometry/surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace tushar::input {

namespace {

/// The coordinates y and x of a point in a plane z = const.
struct Cut {
  double y, x;
};

/// The point at which an edge crosses the height z. It is always computed from the lower end to the upper one,
/// whichever end is given first.
Cut cutAt(double z, Vec3 a, Vec3 b) {
  if (b[2] < a[2]) std::swap(a, b);
  const double share = (z - a[2]) / (b[2] - a[2]);
  return {a[1] + share * (b[1] - a[1]), a[0] + share * (b[0] - a[0])};
}

/// The position at which the line along x through the point intersects the triangle; none if it does not.
std::optional<double> crossingOf(const Vec3& point, const std::array<Vec3, 3>& corners) {
  std::array<Cut, 2> cuts{};
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
    if ((a[2] <= point[2]) != (b[2] <= point[2])) cuts[found++] = cutAt(point[2], a, b);
  }
  if (found < 2 || (cuts[0].y <= point[1]) == (cuts[1].y <= point[1])) return {};
  const double share = (point[1] - cuts[0].y) / (cuts[1].y - cuts[0].y);
  return cuts[0].x + share * (cuts[1].x - cuts[0].x);
}

/// The same point with cyclically permuted coordinates, so that the coordinate along `axis` comes first.
Vec3 turned(const Vec3& point, int axis) { return {point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]}; }

using Corner = std::array<double, 3>;
using Edge = std::pair<Corner, Corner>;

Edge edgeOf(const Vec3& a, const Vec3& b) {
  const Corner p{a[0], a[1], a[2]}, q{b[0], b[1], b[2]};
  return std::minmax(p, q);
}

}  // namespace

Surface::Surface(Triangles triangles, bool isClosed) : triangles_(std::move(triangles)) {
  bounds_ = {triangles_.front()[0], triangles_.front()[0]};
  for (const auto& corners : triangles_)
    for (const Vec3& corner : corners) bounds_ = bounds_.hull({corner, corner});
  bins_ = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles_.size())) / 2);
  for (int axis = 0; axis < (isClosed ? 1 : 3); ++axis) lines_.push_back(linesAlong(axis));
}

Surface::Lines Surface::linesAlong(int axis) const {
  Lines lines;
  lines.crossing.resize(bins_ * bins_);
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    lines.triangles.push_back({turned(a, axis), turned(b, axis), turned(c, axis)});
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (std::size_t z = binOf(third, low[third]); z <= binOf(third, high[third]); ++z)
      for (std::size_t y = binOf(second, low[second]); y <= binOf(second, high[second]); ++y)
        lines.crossing[z * bins_ + y].push_back(static_cast<int>(t));
  }
  return lines;
}

std::size_t Surface::binOf(int axis, double coordinate) const {
  const double extent = bounds_.max[axis] - bounds_.min[axis];
  const double place = extent > 0 ? (coordinate - bounds_.min[axis]) / extent * static_cast<double>(bins_) : 0;
  return std::min(static_cast<std::size_t>(std::max(place, 0.0)), bins_ - 1);
}

Surface::Crossings Surface::crossingsAlong(int axis, const Vec3& point) const {
  const int second = (axis + 1) % 3, third = (axis + 2) % 3;
  const Lines& lines = lines_[axis];
  const Vec3 from = turned(point, axis);
  Crossings found;
  for (const int t : lines.crossing[binOf(third, point[third]) * bins_ + binOf(second, point[second])])
    if (const auto at = crossingOf(from, lines.triangles[t])) ++(*at > from[0] ? found.ahead : found.behind);
  return found;
}

bool Surface::contains(const Vec3& point) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(point[axis] >= bounds_.min[axis] && point[axis] <= bounds_.max[axis])) return false;
  std::size_t odd = 0;
  for (std::size_t axis = 0; axis < lines_.size(); ++axis)
    odd += crossingsAlong(static_cast<int>(axis), point).ahead % 2;
  return 2 * odd > lines_.size();
}

double Surface::disagreement() const {
  constexpr int perAxis = 17;
  int points = 0, disagree = 0;
  for (int x = 0; x < perAxis; ++x)
    for (int y = 0; y < perAxis; ++y)
      for (int z = 0; z < perAxis; ++z, ++points) {
        const Vec3 share((x + 0.5) / perAxis, (y + 0.5) / perAxis, (z + 0.5) / perAxis);
        const Vec3 point = bounds_.min + share.cwiseProduct(bounds_.max - bounds_.min);
        std::size_t odd = 0;
        for (std::size_t axis = 0; axis < lines_.size(); ++axis) {
          const Crossings found = crossingsAlong(static_cast<int>(axis), point);
          odd += found.ahead % 2 + found.behind % 2;
        }
        if (odd > 0 && odd < 2 * lines_.size()) ++disagree;
      }
  return static_cast<double>(disagree) / points;
}

std::string whyOpen(const Triangles& triangles) {
  std::map<Edge, int> uses;
  for (const auto& corners : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[edgeOf(corners[k], corners[(k + 1) % 3])];
  const auto isOpen = [](const auto& use) { return use.second % 2 != 0; };
  const auto first = std::find_if(uses.begin(), uses.end(), isOpen);
  if (first == uses.end()) return {};
  const auto& [a, b] = first->first;
  return fmt::format(
      "{} of its {} edges belong to an odd number of triangles, so the surface is not closed; one of these edges goes "
      "from "
      "({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m",
      std::count_if(uses.begin(), uses.end(), isOpen), uses.size(), a[0], a[1], a[2], b[0], b[1], b[2]);
}

}  // namespace tushar::input
