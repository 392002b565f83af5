#include "core/input/geometry/planes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace tushar::input {

namespace {

constexpr double polygonHalf = 1e-5;  ///< half the thickness of a polygon and of its bounding box [m], as in Uintah

double crossZ(const Vec3& a, const Vec3& b) { return a[0] * b[1] - a[1] * b[0]; }

}  // namespace

Polygon::Polygon(std::vector<Vec3> corners) : corners_(std::move(corners)) {
  for (Vec3& corner : corners_) corner[2] = 0;
  bounds_ = {corners_.front(), corners_.front()};
  for (const Vec3& corner : corners_) bounds_ = bounds_.hull({corner, corner});
  bounds_.min.array() -= polygonHalf;
  bounds_.max.array() += polygonHalf;
}

/// For the intersection of the line point + s d with the side from a to b: s = (b - a) x (point - a) / ((b - a).n), and
/// its position on the side is (point - a).n / ((b - a).n), where n is perpendicular to the ray d.
bool Polygon::contains(const Vec3& point) const {
  if ((point.array() < bounds_.min.array()).any() || (point.array() > bounds_.max.array()).any()) return false;
  const Vec3 ray = Vec3(1 / std::numbers::pi, std::numbers::pi, 0).normalized(), across(-ray[1], ray[0], 0);
  bool inside = false;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const Vec3 side = corners_[(k + 1) % corners_.size()] - corners_[k], from = point - corners_[k];
    const double width = side.dot(across);
    if (std::abs(width) < 1e-10) continue;  // m; along the ray
    const double along = crossZ(side, from) / width, share = from.dot(across) / width;
    if (along >= 0 && share >= 0 && share <= 1) inside = !inside;
  }
  return inside;
}

std::vector<Vec3> readPolygon(const std::string& path, const Element& tag, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& problem) {
    diagnostics.error(tag, fmt::format("'{}': {}", path, problem));
    return std::vector<Vec3>{};
  };
  std::ifstream file(path);
  if (!file) return refuse("there is no such file");
  std::vector<Vec3> corners;
  std::string line, more;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line);
    Vec3 corner = Vec3::Zero();
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (!(words >> corner[0] >> corner[1]) || words >> more || !corner.allFinite())
      return refuse(fmt::format("line {}: found '{}', expected two numbers", number, line));
    corners.push_back(corner);
  }
  return corners.size() < 3 ? refuse("a polygon needs at least three corners") : corners;
}

std::pair<Vec3, Vec3> Polyhedron::plane(const HalfSpace& space) const {
  if (space.offset) return {center + *space.offset, -space.offset->normalized()};
  return {*space.point, space.normal->normalized()};
}

bool Polyhedron::isWithin(const Vec3& point, double tolerance) const {
  for (const HalfSpace& space : planes.list)
    if (const auto [at, normal] = plane(space); normal.dot(point - at) < -tolerance) return false;
  return true;
}

bool Polyhedron::contains(const Vec3& point) const { return isWithin(point, 0); }

std::vector<Vec3> Polyhedron::corners() const {
  const std::vector<HalfSpace>& list = planes.list;
  std::vector<Vec3> found;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix3d normals;
        Eigen::Vector3d distances;
        int row = 0;
        for (const std::size_t one : {i, j, k}) {
          const auto [at, normal] = plane(list[one]);
          normals.row(row) = normal.transpose();
          distances[row++] = normal.dot(at);
        }
        if (std::abs(normals.determinant()) < 1e-12) continue;  // rounding of parallel planes
        const Vec3 corner = normals.inverse() * distances;
        if (isWithin(corner, 1e-9 * (1 + corner.norm()))) found.push_back(corner);
      }
  return found;
}

Box3 Polyhedron::bounds() const {
  const std::vector<Vec3> all = corners();
  if (all.empty()) return {};
  Box3 box{all.front(), all.front()};
  for (const Vec3& corner : all) box = box.hull({corner, corner});
  return box;
}

namespace {

void checkHalfSpace(const HalfSpace& space, const Element& element, Diagnostics& diagnostics) {
  const bool absolute = !space.isRelative;
  if (absolute ? !(space.point && space.normal && !space.offset) : !(space.offset && !space.point && !space.normal))
    return diagnostics.error(element, absolute ? "type absolute needs <planePoint> and <normal>, and no <offset>"
                                               : "type relative needs <offset>, and no <planePoint> or <normal>");
  if ((absolute ? *space.normal : *space.offset).isZero(0))
    diagnostics.error(element, absolute ? "the normal is 0" : "the offset is 0");
}

void checkPolyhedron(const Polyhedron& shape, const Element& element, Diagnostics& diagnostics) {
  if (!shape.contains(shape.center))
    diagnostics.error(element, "its <center> is not on the inner side of all its planes");
  else if (shape.bounds().isEmpty())
    diagnostics.error(element, "its planes do not enclose a finite volume");
}

}  // namespace

const Schema<Polyhedron>& Polyhedron::schema() {
  static const Schema<HalfSpace> space =
      Schema<HalfSpace>("half_space", "A plane that bounds a polyhedron.")
          .choiceAttribute("type", &HalfSpace::isRelative, {{"absolute", false}, {"relative", true}}, false,
                           "absolute: given by planePoint and normal; relative: given by offset")
          .optional("planePoint", &HalfSpace::point, "m", "a point in the plane")
          .optional("normal", &HalfSpace::normal, "1", "perpendicular to the plane, pointing into the body")
          .optional("offset", &HalfSpace::offset, "m", "from the centre to the nearest point of the plane")
          .check(checkHalfSpace);
  static const Schema<Planes> planes = Schema<Planes>("bounds", "The planes around a polyhedron.")
                                           .list("half_space", &Planes::list, space, "a plane", 4);
  static const Schema<Polyhedron> schema =
      Schema<Polyhedron>("polyhedron", "A convex body bounded by planes.")
          .foreignAttribute("label", "a name with which an empty tag further down can refer to this shape")
          .foreignAttribute("name", "a synonym of label")
          .required("center", &Polyhedron::center, "m", "a point inside the body")
          .requiredSection("bounds", &Polyhedron::planes, planes)
          .check(checkPolyhedron);
  return schema;
}

}  // namespace tushar::input
