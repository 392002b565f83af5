#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "components/mpm/solid/material.hpp"
#include "core/grid/level.hpp"
#include "core/input/geometry/shapes.hpp"

namespace tushar::mpm::solid {

/// A load as a function of time: linear between points, constant before the first and after the last.
struct LoadCurve {
  std::vector<std::pair<double, double>> points;  ///< time [s], and the load in its own unit

  double at(double time) const;
};

/// The part of a body's surface on which a load acts: a box that is thin along one axis, the side or an end of a
/// cylinder, or a sphere.
using Surface = std::variant<input::Box, input::Cylinder, input::Sphere>;

/// The quantity that a surface load prescribes.
enum class LoadKind { pressure, torque, heatFlux };

/// Area of a surface [m^2]; per radian for the side or end of an axisymmetric cylinder.
double areaOf(const Surface& surface);
/// Area per radian [m^2/rad] of a box or sphere whose first axis is the distance r from an axis of symmetry, the
/// integral of r along it.
double areaPerRadian(const Surface& surface);
/// Whether a particle at `point`, whose neighbours are `spacing` away, lies along a surface. The largest distances are
/// Uintah's. From a box: one spacing along its thin axis or, for heat, along all axes. From a cylinder: 1.2 times the
/// smallest spacing, for a torque 0.9 times, and for heat from its side half the length of the spacing vector. From a
/// sphere: the length of that vector.
bool isAlong(const Surface& surface, const Vec3& point, const Vec3& spacing, LoadKind kind);
/// The direction in which a positive load pushes: along the thin axis of a box, outwards from a sphere or from the side
/// of a cylinder, and, on the end of a cylinder, from its bottom to its top.
Vec3 normalAt(const Surface& surface, const Vec3& point);

/// A `PhysicalBC/MPM/pressure`, `torque` or `heat_flux`: the particles at the surface share the force or heat of the
/// whole area, or the torque. The shares are equal or, on the end of an axisymmetric cylinder and on boxes and spheres
/// around an axis of symmetry, proportional to the particles' radii.
struct SurfaceLoad {
  using Kind = LoadKind;

  Kind kind = Kind::pressure;
  Surface surface;
  LoadCurve curve;          ///< load as a function of time [Pa, N m, or W/m^2]
  int material = -1;        ///< index of the material; -1: all
  Location where;           ///< location of its tag in the scene
  bool aroundAxis = false;  ///< whether the scene is axisymmetric
  double particles = 0;     ///< sum of the weights of the particles at the surface, computed by countParticles
  bool outwardNormal =
      /// For pressure on faces of particles: whether it acts on the face towards normalAt, rather than on the opposite
      /// face.
      true;

  /// Whether the load acts on a particle of a body: it does if the particle lies along the surface of the load and at
  /// the surface of the body.
  bool acts(const grid::Level& level, const Body& body, const Vec3& point) const;
  /// Force of a pressure on a particle [N]; for a torque T, its share T / (n r) along r x axis, as in Uintah: a
  /// positive torque turns a right-handed screw from the top of the cylinder to its bottom.
  Vec3 force(const Vec3& point, double time) const;
  /// Force, torque or heat flow per particle [N, N m or W].
  double share(const Vec3& point, double time) const;
  /// The direction in which a positive pressure pushes, if it is the same everywhere: on a box and on the end of a
  /// cylinder; otherwise 0.
  Vec3 givenDirection() const;
  /// Weight of a particle among those at the surface: 1, or its radius [m].
  double weight(const Vec3& point) const;
};

/// A tag `PhysicalBC/MPM/force`: a force per mass on the particles that start in a box or within one spacing of it.
struct BodyLoad {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< lower corner and upper corner [m]
  Vec3 forceDensity = Vec3::Zero();                 ///< force density [N/kg]
  Location where = {};                              ///< location of its tag in the scene

  bool acts(const Vec3& point, const Vec3& spacing) const {
    return ((point - lower + spacing).array() >= 0).all() && ((upper + spacing - point).array() >= 0).all();
  }
};

/// The loads of a scene, numbered from 1: first those on surfaces, then those on bodies.
struct Loads {
  std::vector<SurfaceLoad> surfaces;
  std::vector<BodyLoad> bodies;

  bool hasForces() const;
  bool hasHeat() const;
};

/// Calls `onSurface(load)` or `onBody(load)` for each load on a particle; `packed` contains the numbers of the loads in
/// the form of p.loadCurveID.
template <class OnSurface, class OnBody>
void forEachLoad(const Loads& loads, int packed, OnSurface&& onSurface, OnBody&& onBody) {
  for (int ids = packed; ids > 0; ids /= 256) {
    const std::size_t k = ids % 256 - 1;
    if (k < loads.surfaces.size())
      onSurface(loads.surfaces[k]);
    else
      onBody(loads.bodies[k - loads.surfaces.size()]);
  }
}

/// The distance along x, y, z [m] between the particle of a body that starts at `point` and its neighbours.
Vec3 particleSpacing(const grid::Level& level, const Body& body, const Vec3& point);
/// Whether a particle that starts at `point` is at the surface of its body: at least one neighbouring particle would be
/// outside. Neighbours along an axis with one cell are ignored.
bool isAtSurface(const grid::Level& level, const Body& body, const Vec3& point);

/// Computes SurfaceLoad::particles: sums the weights of the particles at the surface of each load.
void countParticles(const grid::Level& level, const std::vector<Material>& materials, std::vector<SurfaceLoad>& loads);
/// Throws InputError for loads whose surface has no particles.
void refuseIdle(const std::vector<SurfaceLoad>& loads);

}  // namespace tushar::mpm::solid
