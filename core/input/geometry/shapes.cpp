#include "core/input/geometry/shapes.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace tushar::input {

namespace {

/// The bounding box of a disc with a given radius around `center`, perpendicular to the unit vector `normal`.
Box3 discBounds(const Vec3& center, const Vec3& normal, double radius) {
  const Vec3 half = radius * (1.0 - normal.array().square()).max(0.0).sqrt().matrix();
  return {center - half, center + half};
}

/// The height of a point along the axis: 0 at the bottom, 1 at the top.
double height(const Vec3& point, const Vec3& bottom, const Vec3& top) {
  const Vec3 axis = top - bottom;
  return (point - bottom).dot(axis) / axis.squaredNorm();
}

bool ownedByFrustum(const Vec3& point, const Vec3& bottom, const Vec3& top, double bottomRadius, double topRadius) {
  const double s = height(point, bottom, top);
  if (s < 0 || s >= 1) return false;
  const double radius = bottomRadius + s * (topRadius - bottomRadius);
  return (point - bottom - s * (top - bottom)).squaredNorm() <= radius * radius;
}

Box3 frustumBounds(const Vec3& bottom, const Vec3& top, double bottomRadius, double topRadius) {
  const Vec3 normal = (top - bottom).normalized();
  return discBounds(bottom, normal, bottomRadius).hull(discBounds(top, normal, topRadius));
}

}  // namespace

bool Box::contains(const Vec3& point) const {
  return (point.array() >= min.array()).all() && (point.array() <= max.array()).all();
}

bool Box::owns(const Vec3& point) const {
  return (point.array() >= min.array()).all() && (point.array() < max.array()).all();
}

bool Sphere::contains(const Vec3& point) const { return (point - origin).squaredNorm() <= radius * radius; }

Box3 Sphere::bounds() const {
  const Vec3 half = Vec3::Constant(radius);
  return {origin - half, origin + half};
}

std::array<Vec3, 3> Ellipsoid::semiAxes() const {
  if (v1) return {*v1, *v2, *v3};
  return {Vec3(*rx, 0, 0), Vec3(0, *ry, 0), Vec3(0, 0, *rz)};
}

bool Ellipsoid::contains(const Vec3& point) const {
  double sum = 0;
  for (const Vec3& axis : semiAxes()) sum += std::pow((point - origin).dot(axis) / axis.squaredNorm(), 2);
  return sum - 1 < 1e-12;
}

Box3 Ellipsoid::bounds() const {
  Vec3 half = Vec3::Zero();
  for (const Vec3& axis : semiAxes()) half += axis.cwiseAbs2();
  half = half.cwiseSqrt().eval();
  return {origin - half, origin + half};
}

bool Cone::contains(const Vec3& point) const {
  const double s = height(point, bottom, top);
  if (s < 0 || s > 1) return false;
  return (point - (bottom * (1 - s) + top * s)).norm() <= bottomRadius * (1 - s) + topRadius * s;
}

bool Cone::owns(const Vec3& point) const { return ownedByFrustum(point, bottom, top, bottomRadius, topRadius); }
Box3 Cone::bounds() const { return frustumBounds(bottom, top, bottomRadius, topRadius); }

bool Cylinder::contains(const Vec3& point) const {
  const Vec3 axis = top - bottom, offset = point - bottom;
  const double along = offset.dot(axis), length2 = axis.squaredNorm();
  if (along < 0 || along > length2) return false;
  return axis.cross(offset).squaredNorm() / length2 <= radius * radius;
}

bool Cylinder::owns(const Vec3& point) const { return ownedByFrustum(point, bottom, top, radius, radius); }
Box3 Cylinder::bounds() const { return frustumBounds(bottom, top, radius, radius); }

Eigen::Matrix<double, 3, 3, Eigen::DontAlign> Parallelepiped::edges() const {
  Eigen::Matrix<double, 3, 3, Eigen::DontAlign> matrix;
  matrix << p2 - p1, p3 - p1, p4 - p1;
  return matrix;
}

bool Parallelepiped::contains(const Vec3& point) const {
  const Vec3 along = edges().inverse() * (point - p1);
  return (along.array() > 0).all() && (along.array() <= 1).all();
}

bool Parallelepiped::owns(const Vec3& point) const {
  const Vec3 along = edges().inverse() * (point - p1);
  return (along.array() >= 0).all() && (along.array() < 1).all();
}

Box3 Parallelepiped::bounds() const {
  const auto edge = edges();
  return {p1 + edge.cwiseMin(0).rowwise().sum(), p1 + edge.cwiseMax(0).rowwise().sum()};
}

Vec3 Torus::direction() const {
  const double c = std::cos(theta);
  const double s = std::sin(theta);
  if (axis == 0) return {c, s, 0};
  if (axis == 1) return {0, c, s};
  return {-s, 0, c};
}

bool Torus::contains(const Vec3& point) const {
  const Vec3 offset = point - center;
  const double h = offset.dot(direction());
  const double d = std::sqrt(std::max(0.0, offset.squaredNorm() - h * h));
  return (majorRadius - d) * (majorRadius - d) + h * h < minorRadius * minorRadius;
}

Box3 Torus::bounds() const {
  const Box3 ring = discBounds(center, direction(), majorRadius);
  const Vec3 tube = Vec3::Constant(minorRadius);
  return {ring.min - tube, ring.max + tube};
}

}  // namespace tushar::input
