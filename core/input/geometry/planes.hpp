#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

// Shapes that straight lines or planes bound.

namespace tushar::input {

/// A polygon in the plane z = 0, within 1e-5 m of it as in Uintah. A ray from the point crosses its sides an odd number
/// of times.
class Polygon : public GeometryPiece {
 public:
  /// Takes at least three corners, in order around the polygon; their z is ignored.
  explicit Polygon(std::vector<Vec3> corners);
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override { return bounds_; }

 private:
  std::vector<Vec3> corners_;
  Box3 bounds_;
};

/// The corners of a polygon: a line `x y` for each, in the file `path`. If a line is malformed, there are fewer than
/// three, or there is no such file, reports an error at `tag` and returns no corners.
std::vector<Vec3> readPolygon(const std::string& path, const Element& tag, Diagnostics& diagnostics);

/// A plane through a point; its normal points into the body.
struct HalfSpace {
  std::string type;                   ///< absolute or relative
  std::optional<Vec3> point, normal;  ///< absolute: the point (m), and the normal
  std::optional<Vec3> offset;         ///< relative: the vector from the centre of the body to the plane (m)
};

/// The points on the inner side of all of its planes, or on them.
struct Polyhedron : GeometryPiece {
  struct Planes {
    std::vector<HalfSpace> list;
  };
  Vec3 center = Vec3::Zero();
  Planes planes;

  bool contains(const Vec3& point) const override;
  /// The box of its corners.
  Box3 bounds() const override;
  /// Where three of its planes meet on the inner side of all others.
  std::vector<Vec3> corners() const;
  static const Schema<Polyhedron>& schema();

 private:
  /// A point in a plane, and the unit normal into the body.
  std::pair<Vec3, Vec3> plane(const HalfSpace& space) const;
  bool isWithin(const Vec3& point, double tolerance) const;
};

}  // namespace tushar::input
