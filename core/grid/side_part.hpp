#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// The shapes that a part of a side can have. Each is an attribute of `Face`, whose value is the side to which the part
/// belongs.
inline constexpr std::array<std::string_view, 5> sidePartNames{"circle", "annulus", "ellipse", "rectangle",
                                                               "rectangulus"};

/// A part of a side of the grid. The outer rim belongs to the part, the rim of a hole does not. Both hold with a
/// tolerance of a billionth of the size, so that round-off does not make a jet lopsided. Coordinates along the normal
/// of the side do not matter.
class SidePart {
 public:
  /// The points within `radius` [m] of `origin`, on a side whose normal is `axis`.
  static SidePart circle(int axis, const Vec3& origin, double radius);
  /// The ring between two circles.
  static SidePart annulus(int axis, const Vec3& origin, double inner, double outer);
  /// An ellipse with the semi-axes `longer` and `shorter` [m]. The longer axis is turned by `degrees` from y towards z
  /// on x+, from z towards x on y+, from x towards y on z+, and the other way round on the opposite sides.
  static SidePart ellipse(int axis, int side, const Vec3& origin, double shorter, double longer, double degrees);
  /// The rectangle between two corners [m].
  static SidePart rectangle(int axis, const Vec3& lower, const Vec3& upper);
  /// The frame between two rectangles.
  static SidePart rectangulus(int axis, const std::array<Vec3, 2>& inner, const std::array<Vec3, 2>& outer);

  bool holds(const Vec3& x) const;
  /// The corners of a bounding box; their coordinates along the normal of the side are ignored.
  const Vec3& lower() const { return outer_.lower; }
  const Vec3& upper() const { return outer_.upper; }

  friend bool operator==(const SidePart&, const SidePart&) = default;

 private:
  struct Corners {
    Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();
    friend bool operator==(const Corners&, const Corners&) = default;
  };
  /// An ellipse, given by its two foci, which coincide for a circle, and the sum of the distances from its points to
  /// them [m].
  struct Oval {
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
    double sum = 0;
    friend bool operator==(const Oval&, const Oval&) = default;
  };
  bool isIn(const Corners& corners, const Vec3& x) const;
  bool isIn(const Oval& oval, const Vec3& x) const;

  int axis_ = 0;
  Corners outer_;                ///< corners of a rectangle, or of the bounding box
  std::optional<Corners> hole_;  ///< corners of the hole of a rectangulus
  std::optional<Oval> oval_, ovalHole_;
};

}  // namespace tushar::grid
