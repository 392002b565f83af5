#pragma once

#include <array>

#include "core/input/geometry/piece.hpp"
#include "core/input/schema.hpp"

namespace tushar::input {

// `contains` treats faces as Uintah does, with the same formulas in the same order, so that rounding has the same
// effect: boxes, cylinders, cones and spheres include their faces; a parallelepiped includes only the faces far from
// p1, and a torus none; an ellipsoid includes points at which the sum in its inequality exceeds 1 by less than 1e-12.
// `owns` excludes the flat upper faces (at max, at the top, far from p1), as a half-open cell does.

/// A box: the points p with min <= p <= max along each axis.
struct Box : GeometryPiece {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override { return {min, max}; }
  static const Schema<Box>& schema();
};

/// A sphere: the points p with |p - origin| <= radius.
struct Sphere : GeometryPiece {
  Vec3 origin = Vec3::Zero();
  double radius = 0;

  bool contains(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Sphere>& schema();
};

/// An ellipsoid: sum over its semi-axes v of ((p - origin).v / v.v)^2 < 1 + 1e-12; the semi-axes are perpendicular.
struct Ellipsoid : GeometryPiece {
  Vec3 origin = Vec3::Zero();
  std::optional<double> rx, ry, rz;  ///< semi-axes along x, y and z [m] …
  std::optional<Vec3> v1, v2, v3;    ///< … or semi-axes along any perpendicular directions [m]

  std::array<Vec3, 3> semiAxes() const;
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Ellipsoid>& schema();
};

/// A cone: the points with 0 <= s <= 1 whose distance from the axis is at most radius(s). The coordinate s along the
/// axis is 0 at the bottom and 1 at the top; radius(s) is linear.
struct Cone : GeometryPiece {
  Vec3 bottom = Vec3::Zero();
  Vec3 top = Vec3::Zero();
  double bottomRadius = 0;
  double topRadius = 0;

  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Cone>& schema();
};

/// A cone with the same radius at both ends. The flags select the surfaces on which a pressure acts.
struct Cylinder : GeometryPiece {
  Vec3 bottom = Vec3::Zero();
  Vec3 top = Vec3::Zero();
  double radius = 0;
  bool cylinderEnd = false;
  bool axisymmetricEnd = false;
  bool axisymmetricSide = false;

  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Cylinder>& schema();
};

/// A parallelepiped with corner p1 and the three adjacent corners: p = p1 + a (p2 - p1) + b (p3 - p1) + c (p4 - p1)
/// with a, b and c above 0 and at most 1.
struct Parallelepiped : GeometryPiece {
  Vec3 p1 = Vec3::Zero();
  Vec3 p2 = Vec3::Zero();
  Vec3 p3 = Vec3::Zero();
  Vec3 p4 = Vec3::Zero();

  /// The three edges that start at p1, one per column.
  Eigen::Matrix<double, 3, 3, Eigen::DontAlign> edges() const;
  bool contains(const Vec3& point) const override;
  bool owns(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Parallelepiped>& schema();
};

/// A torus: (R - d)^2 + h^2 < r^2, with d the distance from the axis and h the distance from the plane of the ring.
struct Torus : GeometryPiece {
  Vec3 center = Vec3::Zero();
  double majorRadius = 0;  ///< R, radius of the ring [m]
  double minorRadius = 0;  ///< r, radius of the tube [m]
  int axis = 2;
  double theta = 0;  ///< tilt [rad]: a z axis tilts towards -x, a y axis towards z, an x axis towards y

  /// The unit vector along the axis, tilted by theta.
  Vec3 direction() const;
  bool contains(const Vec3& point) const override;
  Box3 bounds() const override;
  static const Schema<Torus>& schema();
};

}  // namespace tushar::input
