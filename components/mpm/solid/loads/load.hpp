#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "components/mpm/solid/material.hpp"
#include "core/grid/level.hpp"
#include "core/input/geometry/shapes.hpp"

namespace tushar::mpm::solid {

/// A load over time: straight lines between points, constant before the first and after the last.
struct LoadCurve {
  std::vector<std::pair<double, double>> points;  ///< s, and the unit of the load

  double at(double time) const;
};

/// A side of a body on which a pressure acts: a box that is thin along one axis, or the curved or the end face of a
/// cylinder, or a sphere.
using Surface = std::variant<input::Box, input::Cylinder, input::Sphere>;

/// Area of a surface, m^2; per radian where an axisymmetric cylinder says so.
double areaOf(const Surface& surface);
/// Whether a particle at `point`, whose neighbours are `spacing` away, lies along a surface. As in Uintah that is: to a
/// spacing from a box, along its thin axis and for heat along all; from a cylinder to 1.2 of the least spacing, for
/// heat from its side to half the length of the spacing; to that length from a sphere.
bool isAlong(const Surface& surface, const Vec3& point, const Vec3& spacing, bool forHeat);
/// The direction in which a positive load pushes: the thin axis of a box, outwards, or along a cylinder to its top.
Vec3 normalAt(const Surface& surface, const Vec3& point);

/// A `PhysicalBC/MPM/pressure` or `heat_flux`: what acts on the area is shared evenly among the particles at the
/// surface, but by their radius on the end of an axisymmetric cylinder.
struct SurfaceLoad {
  enum class Kind { pressure, heatFlux };

  Kind kind = Kind::pressure;
  Surface surface;
  LoadCurve curve;       ///< Pa, or W/m^2
  int material = -1;     ///< -1: all
  Location where;        ///< in the scene
  double particles = 0;  ///< how many shares there are at the surface, set by countParticles

  /// Whether a particle of a body is loaded: it is along the surface and some neighbour's place is not in the body. On
  /// a grid of one cell along z neighbours along z do not count.
  bool acts(const grid::Level& level, const Body& body, const Vec3& point) const;
  /// Of a pressure, N.
  Vec3 force(const Vec3& point, double time) const;
  /// What a particle gets, N or W.
  double share(const Vec3& point, double time) const;
  /// Its weight among those at the surface: 1, or its radius (m).
  double weight(const Vec3& point) const;
};

/// A `PhysicalBC/MPM/force`: a force per mass on the particles that start in a box, or next to it.
struct BodyLoad {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m
  Vec3 forceDensity = Vec3::Zero();                 ///< N/kg

  bool acts(const Vec3& point, const Vec3& spacing) const {
    return ((point - lower + spacing).array() >= 0).all() && ((upper + spacing - point).array() >= 0).all();
  }
};

/// The loads of a scene, numbered from 1: those on surfaces, then those on bodies.
struct Loads {
  std::vector<SurfaceLoad> surfaces;
  std::vector<BodyLoad> bodies;

  bool hasForces() const;
  bool hasHeat() const;
};

/// The distance between the particles of a body along x, y, z, m.
Vec3 particleSpacing(const grid::Level& level, const Body& body);

/// Counts the particles at the surface of each load.
void countParticles(const grid::Level& level, const std::vector<Material>& materials, std::vector<SurfaceLoad>& loads);
/// Throws InputError for the loads whose surface has no particle.
void refuseIdle(const std::vector<SurfaceLoad>& loads);

}  // namespace tushar::mpm::solid
