#include <fmt/format.h>

#include <Eigen/LU>

#include <cmath>

#include "core/input/geometry/shapes.hpp"

// The tags of each shape, and checks that it is not degenerate.

namespace tushar::input {

namespace {

/// The schema of a shape with a label; the label is read by readGeometry.
template <class T>
Schema<T> shapeSchema(const std::string& name, const std::string& sentence) {
  Schema<T> schema(name, sentence);
  schema.foreignAttribute("label", "a name with which an empty tag further down can refer to this shape");
  schema.foreignAttribute("name", "a synonym of label");
  return schema;
}

template <class T>
void checkAxis(const T& shape, const Element& element, Diagnostics& diagnostics) {
  if (shape.bottom != shape.top) return;
  diagnostics.error(element, fmt::format("bottom and top are both {}, so the <{}> has no height", toText(shape.bottom),
                                         element.name()));
}

void checkBox(const Box& box, const Element& element, Diagnostics& diagnostics) {
  for (int d = 0; d < 3; ++d) {
    if (box.max[d] > box.min[d]) continue;
    diagnostics.error(element, fmt::format("the box has no extent along {}: max {} is not above min {}", "xyz"[d],
                                           box.max[d], box.min[d]));
  }
}

void checkEllipsoid(const Ellipsoid& shape, const Element& element, Diagnostics& diagnostics) {
  const bool radii = shape.rx && shape.ry && shape.rz;
  const bool axes = shape.v1 && shape.v2 && shape.v3;
  const bool any = shape.rx || shape.ry || shape.rz;
  if (radii == axes || (axes && any) || (radii && (shape.v1 || shape.v2 || shape.v3))) {
    diagnostics.error(element, "expected either <rx>, <ry> and <rz> or <v1>, <v2> and <v3>");
    return;
  }
  const auto v = shape.semiAxes();
  if (v[0].isZero(0) || v[1].isZero(0) || v[2].isZero(0)) {
    diagnostics.error(element, "one of the semi-axes v1, v2 and v3 is zero");
    return;
  }
  // Scenes give directions to a few digits.
  const auto skewed = [](const Vec3& a, const Vec3& b) { return std::abs(a.dot(b)) > 1e-6 * a.norm() * b.norm(); };
  if (skewed(v[0], v[1]) || skewed(v[1], v[2]) || skewed(v[2], v[0])) {
    diagnostics.error(element, "the semi-axes v1, v2 and v3 are not perpendicular to each other");
  }
}

void checkCone(const Cone& cone, const Element& element, Diagnostics& diagnostics) {
  checkAxis(cone, element, diagnostics);
  if (cone.bottomRadius > 0 || cone.topRadius > 0) return;
  diagnostics.error(element, "bottom_radius and top_radius are both 0, so the <cone> has no volume");
}

void checkParallelepiped(const Parallelepiped& shape, const Element& element, Diagnostics& diagnostics) {
  const auto edges = shape.edges();
  const double scale = edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
  if (std::abs(edges.determinant()) > 1e-12 * scale) return;  // 1e-12: the rounding error of a flat one
  diagnostics.error(element, "p1, p2, p3 and p4 lie in one plane, so the <parallelepiped> has no volume");
}

}  // namespace

const Schema<Box>& Box::schema() {
  static const Schema<Box> schema = shapeSchema<Box>("box", "A box whose edges are parallel to the axes.")
                                        .required("min", &Box::min, "m", "lower corner")
                                        .required("max", &Box::max, "m", "upper corner")
                                        .check(checkBox);
  return schema;
}

const Schema<Sphere>& Sphere::schema() {
  static const Schema<Sphere> schema = shapeSchema<Sphere>("sphere", "A ball.")
                                           .required("origin", &Sphere::origin, "m", "centre")
                                           .required("radius", &Sphere::radius, "m", "radius", positive());
  return schema;
}

const Schema<Ellipsoid>& Ellipsoid::schema() {
  static const Schema<Ellipsoid> schema =
      shapeSchema<Ellipsoid>("ellipsoid", "An ellipsoid, given by three radii or by three semi-axes.")
          .required("origin", &Ellipsoid::origin, "m", "centre")
          .optional("rx", &Ellipsoid::rx, "m", "radius along x", positive())
          .optional("ry", &Ellipsoid::ry, "m", "radius along y", positive())
          .optional("rz", &Ellipsoid::rz, "m", "radius along z", positive())
          .optional("v1", &Ellipsoid::v1, "m", "first semi-axis")
          .optional("v2", &Ellipsoid::v2, "m", "second semi-axis")
          .optional("v3", &Ellipsoid::v3, "m", "third semi-axis")
          .check(checkEllipsoid);
  return schema;
}

const Schema<Cone>& Cone::schema() {
  static const Schema<Cone> schema =
      shapeSchema<Cone>("cone", "A cone or a truncated cone.")
          .required("bottom", &Cone::bottom, "m", "centre of one end")
          .required("top", &Cone::top, "m", "centre of the other end")
          .required("bottom_radius", &Cone::bottomRadius, "m", "radius at the bottom", nonNegative())
          .required("top_radius", &Cone::topRadius, "m", "radius at the top", nonNegative())
          .check(checkCone);
  return schema;
}

const Schema<Cylinder>& Cylinder::schema() {
  static const Schema<Cylinder> schema =
      shapeSchema<Cylinder>("cylinder", "A circular cylinder in any direction.")
          .required("bottom", &Cylinder::bottom, "m", "centre of one end")
          .required("top", &Cylinder::top, "m", "centre of the other end")
          .required("radius", &Cylinder::radius, "m", "radius", positive())
          .value("cylinder_end", &Cylinder::cylinderEnd, false, "",
                 "whether a pressure acts on the end of the cylinder instead of its side")
          .value("axisymmetric_end", &Cylinder::axisymmetricEnd, false, "",
                 "whether, in an axisymmetric scene, a pressure acts on the end of the cylinder")
          .value("axisymmetric_side", &Cylinder::axisymmetricSide, false, "",
                 "whether, in an axisymmetric scene, a pressure acts on the side of the cylinder")
          .check(checkAxis<Cylinder>);
  return schema;
}

const Schema<Parallelepiped>& Parallelepiped::schema() {
  static const Schema<Parallelepiped> schema =
      shapeSchema<Parallelepiped>("parallelepiped",
                                  "A sheared box, given by one corner and the three adjacent corners.")
          .required("p1", &Parallelepiped::p1, "m", "one corner")
          .required("p2", &Parallelepiped::p2, "m", "the corner at the end of the first edge")
          .required("p3", &Parallelepiped::p3, "m", "the corner at the end of the second edge")
          .required("p4", &Parallelepiped::p4, "m", "the corner at the end of the third edge")
          .check(checkParallelepiped);
  return schema;
}

const Schema<Torus>& Torus::schema() {
  static const Schema<Torus> schema =
      shapeSchema<Torus>("torus", "A ring.")
          .required("center", &Torus::center, "m", "centre")
          .required("major_radius", &Torus::majorRadius, "m",
                    "radius of the ring, from its axis to the centre of the tube", nonNegative())
          .required("minor_radius", &Torus::minorRadius, "m", "radius of the tube", positive())
          .requiredChoice("axis", &Torus::axis, {{"x", 0}, {"y", 1}, {"z", 2}}, "axis of the ring")
          .value("theta", &Torus::theta, 0.0, "rad",
                 "tilt of the axis: a z axis tilts towards -x, a y axis towards z, an x axis towards y");
  return schema;
}

}  // namespace tushar::input
