#include "core/input/geometry/smooth_cylinder.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tushar::input {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// The rotation by the smallest angle that turns the z axis into `direction`. Uses Eigen's function except for opposite
/// directions, for which Eigen's singular value decomposition takes the compiler seconds.
Eigen::Matrix3d turnOfZ(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d z(0, 0, 1), end = direction.normalized(), normal = z.cross(end);
  const double cosine = end.dot(z);
  Eigen::Quaterniond turn;
  if (cosine < -1 + 1e-12) {
    const Eigen::Vector3d axis = normal.isZero(0) ? Eigen::Vector3d(-1, 0, 0) : Eigen::Vector3d(normal.normalized());
    const double half = (1 + std::max(cosine, -1.0)) * 0.5;
    turn.w() = std::sqrt(half);
    turn.vec() = axis * std::sqrt(1 - half);
  } else {
    const double twice = std::sqrt((1 + cosine) * 2);
    turn.w() = twice * 0.5;
    turn.vec() = normal * (1 / twice);
  }
  return turn.toRotationMatrix();
}

}  // namespace

bool SmoothCylinder::contains(const Vec3& point) const {
  const Vec3 axis = top - bottom, offset = point - bottom;
  const double height = offset.dot(axis), squared = axis.squaredNorm();
  const double radiusSquared = axis.cross(offset).squaredNorm() / squared;
  return height >= 0 && height <= squared && radiusSquared <= outerRadius * outerRadius &&
         (innerRadius == 0 || radiusSquared > innerRadius * innerRadius);
}

Box3 SmoothCylinder::bounds() const {
  const Vec3 half = Vec3::Constant(outerRadius);
  return Box3{bottom - half, bottom + half}.hull({top - half, top + half});
}

double SmoothCylinder::angle() const { return degree * (endAngle - startAngle); }

double SmoothCylinder::areaOf(int ring, int count) const {
  const double inner = innerRadius + ring * width(), outer = inner + width();
  return 0.5 * angle() / count * (outer * outer - inner * inner);
}

int SmoothCylinder::particlesOfRing(int ring, double cellVolume) const {
  const double radius = innerRadius + (ring + 0.5) * width();
  if (scheme == Scheme::constantVolumes) return std::max(static_cast<int>(angle() * radius / width()), 1);
  double share = 1;
  int count = angular.value_or(1);
  while (count > 1 && areaOf(ring, count) * height() < 0.05 * cellVolume) {
    share *= 0.9;
    count = std::max(static_cast<int>(angular.value_or(1) * share), 1);
  }
  return count;
}

void SmoothCylinder::addRing(const Vec3& center, int ring, int count, std::vector<Particle>& particles) const {
  const Eigen::Matrix3d rotation = turnOfZ((top - bottom).normalized());
  const double radius = innerRadius + (ring + 0.5) * width(), step = angle() / count;
  for (int k = 0; k < count; ++k) {
    const double phi = degree * startAngle + (k + 0.5) * step, x = std::cos(phi), y = std::sin(phi);
    Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
    edges.col(0) << radius * step * y, -radius * step * x, 0;
    edges.col(1) << width() * x, width() * y, 0;
    edges(2, 2) = height();
    const Vec3 at = center + rotation * Eigen::Vector3d(radius * x, radius * y, 0);
    particles.push_back({at, rotation * edges * rotation.transpose(), areaOf(ring, count) * height()});
  }
}

std::vector<SmoothCylinder::Particle> SmoothCylinder::particles(double cellVolume) const {
  const Vec3 axis = (top - bottom).normalized();
  std::vector<Particle> all;
  for (int layer = 0; layer < axial; ++layer)
    for (int ring = 0; ring < radial; ++ring)
      addRing(bottom + (layer + 0.5) * height() * axis, ring, particlesOfRing(ring, cellVolume), all);
  return all;
}

namespace {

void checkSmoothCylinder(const SmoothCylinder& shape, const Element& element, Diagnostics& diagnostics) {
  if (shape.bottom == shape.top) diagnostics.error(element, "bottom and top are the same, so it has no height");
  if (shape.innerRadius >= shape.outerRadius)
    diagnostics.error(element, "inner_radius is not below outer_radius, so it has no thickness");
  if (shape.endAngle <= shape.startAngle)
    diagnostics.error(element, "arc_angle, where the arc ends, is not above arc_start_angle");
  if (shape.scheme == SmoothCylinder::Scheme::pieSlices && !shape.angular)
    diagnostics.error(element, "missing tag <num_angular>, which pie_slices needs");
}

}  // namespace

const Schema<SmoothCylinder>& SmoothCylinder::schema() {
  using Self = SmoothCylinder;
  static const Schema<Self> schema = [] {
    Schema<Self> tags("smoothcyl",
                      "A hollow cylinder that, if it is the only shape of a body, places particles in rings.");
    tags.foreignAttribute("label", "a name with which an empty tag further down can refer to this shape")
        .foreignAttribute("name", "a synonym of label")
        .choice("discretization_scheme", &Self::scheme,
                {{"pie_slices", Scheme::pieSlices}, {"constant_particle_volumes", Scheme::constantVolumes}},
                Scheme::pieSlices,
                "how many particles a ring has: num_angular, or as many as make each particle about as long as the "
                "ring is wide")
        .required("bottom", &Self::bottom, "m", "centre of one end")
        .required("top", &Self::top, "m", "centre of the other end")
        .value("inner_radius", &Self::innerRadius, 0, "m", "radius of the hole", nonNegative())
        .required("outer_radius", &Self::outerRadius, "m", "outer radius", positive())
        .required("num_radial", &Self::radial, "1", "number of rings around the axis", positive())
        .required("num_axial", &Self::axial, "1", "number of layers along the axis", positive())
        .optional("num_angular", &Self::angular, "1", "number of particles in a ring; needed for pie_slices",
                  positive())
        .value("arc_start_angle", &Self::startAngle, 0, "degrees", "angle at which the arc begins", between(0, 360))
        .value("arc_angle", &Self::endAngle, 360, "degrees", "angle at which the arc ends", between(0, 360))
        .ignored("endcap_thickness", "as in Uintah, end caps have no particles")
        .ignored("output_file", "the archive contains the particles")
        .check(checkSmoothCylinder);
    return tags;
  }();
  return schema;
}

}  // namespace tushar::input
