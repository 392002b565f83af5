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
/// Whether a particle at `point`, whose neighbours are `spacing` away, lies along a surface.
bool isAlong(const Surface& surface, const Vec3& point, const Vec3& spacing);
/// The direction in which a positive load pushes: the thin axis of a box, outwards, or along a cylinder to its top.
Vec3 normalAt(const Surface& surface, const Vec3& point);

/// A `PhysicalBC/MPM/pressure`: the force pressure times area is shared evenly among the particles at the surface.
struct PressureLoad {
  Surface surface;
  LoadCurve curve;         ///< Pa
  int material = -1;       ///< -1: all
  double particles = 0;    ///< how many there are at the surface, set by countParticles

  /// Whether a particle of a body is loaded: it is along the surface and some neighbour's place is not in the body.
  bool acts(const Body& body, const Vec3& point, const Vec3& spacing) const;
  Vec3 force(const Vec3& point, double time) const;
};

/// The distance between the particles of a body along x, y, z, m.
Vec3 particleSpacing(const grid::Level& level, const Body& body);

/// Counts the particles at the surface of each load.
void countParticles(const grid::Level& level, const std::vector<Material>& materials, std::vector<PressureLoad>& loads);

}  // namespace tushar::mpm::solid
