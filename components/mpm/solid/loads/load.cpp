#include "components/mpm/solid/loads/load.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tushar::mpm::solid {

namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

int thinAxis(const input::Box& box) {
  const Vec3 sides = box.max - box.min;
  int axis = 0;
  for (int d = 1; d < 3; ++d)
    if (sides[d] < sides[axis]) axis = d;
  return axis;
}

bool isEnd(const input::Cylinder& cylinder) { return cylinder.cylinderEnd || cylinder.axisymmetricEnd; }

/// A point relative to a cylinder: height above the bottom, distance and direction from the axis.
struct CylinderPlace {
  double height, radius;
  Vec3 outwards;

  CylinderPlace(const input::Cylinder& cylinder, const Vec3& point) {
    const Vec3 axis = (cylinder.top - cylinder.bottom).normalized(), offset = point - cylinder.bottom;
    height = offset.dot(axis);
    outwards = offset - height * axis;
    radius = outwards.norm();
    if (radius > 0) outwards /= radius;
  }
};

/// Calls `visit(point)` for the position [m] of each particle of a body.
template <int D, class Visit>
void forEachParticle(const grid::Level& level, const Body& body, Visit&& visit) {
  if (body.seeds) {
    for (const auto& [cell, seeds] : *body.seeds)
      for (const Seed& seed : seeds) visit(seed.at);
    return;
  }
  grid::forEach<D>(level.cells(), [&](const Index<D>& cell) {
    forEachParticleIn<D>(level, body, cell, [&](const Index<D>&, const Vec3& point, double) { visit(point); });
  });
}

}  // namespace

double LoadCurve::at(double time) const {
  if (time <= points.front().first) return points.front().second;
  if (time >= points.back().first) return points.back().second;
  const auto next =
      std::lower_bound(points.begin(), points.end(), time, [](const auto& point, double t) { return point.first < t; });
  const auto& [t0, load] = *(next - 1);
  return load + (time - t0) / (next->first - t0) * (next->second - load);
}

double areaOf(const Surface& surface) {
  constexpr double pi = std::numbers::pi;
  return std::visit(Overloaded{[](const input::Box& box) {
                                 const Vec3 sides = box.max - box.min;
                                 const int thin = thinAxis(box);
                                 return sides[(thin + 1) % 3] * sides[(thin + 2) % 3];
                               },
                               [](const input::Cylinder& c) {
                                 if (c.axisymmetricEnd) return 0.5 * c.radius * c.radius;
                                 if (c.cylinderEnd) return pi * c.radius * c.radius;
                                 const double side = 2 * pi * c.radius * (c.top - c.bottom).norm();
                                 return c.axisymmetricSide ? side / (2 * pi) : side;
                               },
                               [](const input::Sphere& s) { return 4 * pi * s.radius * s.radius; }},
                    surface);
}

double areaPerRadian(const Surface& surface) {
  return std::visit(Overloaded{[](const input::Box& box) {
                                 const Vec3 sides = box.max - box.min;
                                 const double inner = std::max(box.min[0], 0.0), outer = std::max(box.max[0], 0.0);
                                 if (thinAxis(box) == 0) return 0.5 * (inner + outer) * sides[1];
                                 return thinAxis(box) == 1 ? 0.5 * (outer * outer - inner * inner)
                                                           : sides[0] * sides[1];
                               },
                               [](const input::Sphere& s) { return 2 * s.radius * s.radius; },
                               [](const input::Cylinder& c) { return areaOf(c); }},
                    surface);
}

bool isAlong(const Surface& surface, const Vec3& point, const Vec3& spacing, LoadKind kind) {
  const bool forHeat = kind == LoadKind::heatFlux;
  return std::visit(
      Overloaded{
          [&](const input::Box& box) {
            Vec3 more = spacing;
            if (!forHeat) more = spacing[thinAxis(box)] * Vec3::Unit(thinAxis(box));
            input::Box around;
            around.min = box.min - more;
            around.max = box.max + more;
            return around.contains(point);
          },
          [&](const input::Cylinder& c) {
            const CylinderPlace place(c, point);
            const double end = (kind == LoadKind::torque ? 0.9 : 1.2) * spacing.minCoeff(),
                         side = forHeat ? 0.5 * spacing.norm() : end;
            const double height = (c.top - c.bottom).norm();
            if (isEnd(c) && kind != LoadKind::torque)
              return place.height >= -end && place.height <= height + end && place.radius <= c.radius;
            return place.height >= 0 && place.height <= height && std::abs(place.radius - c.radius) <= side;
          },
          [&](const input::Sphere& s) { return std::abs((point - s.origin).norm() - s.radius) <= spacing.norm(); }},
      surface);
}

Vec3 normalAt(const Surface& surface, const Vec3& point) {
  return std::visit(Overloaded{[](const input::Box& box) { return Vec3(Vec3::Unit(thinAxis(box))); },
                               [&](const input::Cylinder& c) {
                                 return isEnd(c) ? Vec3((c.top - c.bottom).normalized())
                                                 : CylinderPlace(c, point).outwards;
                               },
                               [&](const input::Sphere& s) { return Vec3((point - s.origin).normalized()); }},
                    surface);
}

bool isAtSurface(const grid::Level& level, const Body& body, const Vec3& point) {
  const Vec3 spacing = particleSpacing(level, body, point), place = body.inShape(point);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      if (level.domain().resolution[axis] > 1 && !body.shape->contains(place + side * spacing[axis] * Vec3::Unit(axis)))
        return true;
  return false;
}

bool SurfaceLoad::acts(const grid::Level& level, const Body& body, const Vec3& point) const {
  return isAlong(surface, point, particleSpacing(level, body, point), kind) && isAtSurface(level, body, point);
}

Vec3 SurfaceLoad::givenDirection() const {
  const auto* cylinder = std::get_if<input::Cylinder>(&surface);
  const bool isGiven = cylinder ? isEnd(*cylinder) : std::holds_alternative<input::Box>(surface);
  return isGiven ? normalAt(surface, Vec3::Zero()) : Vec3(Vec3::Zero());
}

double SurfaceLoad::weight(const Vec3& point) const {
  const auto* cylinder = std::get_if<input::Cylinder>(&surface);
  const bool byRadius = cylinder ? cylinder->axisymmetricEnd : aroundAxis;
  return byRadius ? point[0] : 1.0;
}

double SurfaceLoad::share(const Vec3& point, double time) const {
  const double area = kind == Kind::torque ? 1.0 : aroundAxis ? areaPerRadian(surface) : areaOf(surface);
  return curve.at(time) * area * weight(point) / particles;
}

Vec3 SurfaceLoad::force(const Vec3& point, double time) const {
  if (kind != Kind::torque) return share(point, time) * normalAt(surface, point);
  const auto& cylinder = std::get<input::Cylinder>(surface);
  const CylinderPlace place(cylinder, point);
  if (place.radius == 0) return Vec3::Zero();
  return share(point, time) / place.radius * place.outwards.cross((cylinder.top - cylinder.bottom).normalized());
}

namespace {

bool hasKind(const std::vector<SurfaceLoad>& loads, SurfaceLoad::Kind kind) {
  return std::any_of(loads.begin(), loads.end(), [kind](const SurfaceLoad& load) { return load.kind == kind; });
}

}  // namespace

bool Loads::hasForces() const {
  return !bodies.empty() || hasKind(surfaces, LoadKind::pressure) || hasKind(surfaces, LoadKind::torque);
}
bool Loads::hasHeat() const { return hasKind(surfaces, SurfaceLoad::Kind::heatFlux); }

Vec3 particleSpacing(const grid::Level& level, const Body& body, const Vec3& point) {
  Vec3 spacing;
  for (int axis = 0; axis < 3; ++axis) spacing[axis] = level.cellWidth(axis) / body.particlesPerCell[axis];
  const Vec3* const half = body.list ? body.list->halfAt(point) : nullptr;
  for (int axis = 0; axis < 3 && half; ++axis)
    if (std::isfinite((*half)[axis])) spacing[axis] = 2 * (*half)[axis];
  return spacing;
}

void countParticles(const grid::Level& level, const std::vector<Material>& materials, std::vector<SurfaceLoad>& loads) {
  std::vector<InputProblem> problems;
  for (SurfaceLoad& load : loads) {
    load.particles = 0;
    for (std::size_t m = 0; m < materials.size(); ++m) {
      if (load.material >= 0 && load.material != static_cast<int>(m)) continue;
      const double before = load.particles;
      for (const Body& body : materials[m].bodies) {
        const auto count = [&](const Vec3& point) {
          if (load.acts(level, body, point)) load.particles += load.weight(point);
        };
        if (level.dimension() == 1) forEachParticle<1>(level, body, count);
        if (level.dimension() == 2) forEachParticle<2>(level, body, count);
        if (level.dimension() == 3) forEachParticle<3>(level, body, count);
      }
      if (load.kind == LoadKind::heatFlux && load.particles > before && !(materials[m].specificHeat > 0))
        problems.push_back({load.where, "PhysicalBC/MPM/heat_flux",
                            fmt::format("heats '{}', which has no <specific_heat>", materials[m].name)});
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void refuseIdle(const std::vector<SurfaceLoad>& loads) {
  std::vector<InputProblem> problems;
  for (const SurfaceLoad& load : loads)
    if (load.particles == 0)
      problems.push_back({load.where, "PhysicalBC/MPM", "no particle lies along the surface of this load"});
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace tushar::mpm::solid
