#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

// Shapes bounded by straight lines or planes.

namespace tushar::input {

/// A polygon in the plane z = 0, extended to all z within 1e-5 m of this plane, as in Uintah. A point is inside if a
/// ray from it crosses the sides of the polygon an odd number of times.
class Polygon : public GeometryPiece {
 public:
  /// Constructs a polygon from at least three corners, in order around it; their z coordinates are ignored.
  explicit Polygon(std::vector<Vec3> corners);
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  std::vector<Vec3> corners_;
  Box3 bounds_;
};

/// Reads the corners of a polygon from the file `path`, which has one line `x y` for each corner. If the file is
/// missing, a line is malformed, or there are fewer than three corners, reports an error at `tag` and returns no
/// corners.
std::vector<Vec3> readPolygon(const std::string& path, const Element& tag, Diagnostics& diagnostics);

/// A half-space, bounded by a plane; the normal of the plane points into the body.
struct HalfSpace {
  bool isRelative = false;            ///< whether the plane is given relative to the centre of the body
  std::optional<Vec3> point, normal;  ///< absolute: a point [m] on the plane, and the normal
  std::optional<Vec3> offset;         ///< relative: the vector from the centre of the body to the plane [m]
};

/// The points that are on the inner side of all planes, or on the planes.
struct Polyhedron : GeometryPiece {
  struct Planes {
    std::vector<HalfSpace> list;
  };
  Vec3 center = Vec3::Zero();
  Planes planes;

  bool contains(const Vec3& point) const override;
  /// The bounding box of the corners.
  Box3 bounds() const override;
  /// The corners: points where three planes meet on the inner side of all others.
  std::vector<Vec3> corners() const;
  static const Schema<Polyhedron>& schema();

 private:
  /// A point on the plane, and its unit normal, which points into the body.
  std::pair<Vec3, Vec3> plane(const HalfSpace& space) const;
  bool isWithin(const Vec3& point, double tolerance) const;
};

}  // namespace tushar::input
