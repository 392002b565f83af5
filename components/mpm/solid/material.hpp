#pragma once

#include "components/mpm/solid/constitutive/model.hpp"
#include "components/mpm/solid/damage/damage.hpp"
#include "components/mpm/solid/damage/erosion.hpp"
#include "components/mpm/solid/grains/grain.hpp"
#include "components/mpm/solid/listed_particles.hpp"
#include "components/mpm/solid/placement.hpp"
#include "core/core.hpp"
#include "core/input/expression.hpp"
#include "core/input/geometry.hpp"

namespace tushar::mpm::solid {

/// The initial shape and state of a body; the state may vary in space.
struct Body {
  Location where;  ///< location of its tag in the scene
  std::shared_ptr<const input::GeometryPiece> shape;
  Index3 particlesPerCell{{1, 1, 1}};  ///< number of particles per cell along x, y, z
  input::VectorExpression velocity;    ///< velocity [m/s]
  input::Expression temperature;       ///< temperature [K]
  double color = 0;
  bool fillsDepth = false;  ///< whether a particle that starts in the body is as deep as the grid, as gas requires
  int levels = 1;  ///< number of particle sizes that fill the shape; negative: only the smallest extend beyond it
  /// Rows of A, and b: the body's particles start at A X + b [m] instead of X.
  Vec3 affineRow0 = Vec3::UnitX(), affineRow1 = Vec3::UnitY(), affineRow2 = Vec3::UnitZ(), affineShift = Vec3::Zero();
  std::shared_ptr<const ListedParticles> list;  ///< its particles, which are also its shape, if a file lists them
  std::shared_ptr<const Seeds> seeds;  ///< initial positions of the body's particles; null: in equal parts of cells

  Matrix3 affineMatrix() const;
  /// The point X of the shape [m] that starts at `point` = A X + b.
  Vec3 inShape(const Vec3& point) const;
};

/// The initial position of the k-th particle of a cell [m], rounded as in Uintah, because the last digit of a point on
/// a face decides whether the point is inside the shape.
template <int D>
Vec3 placeOf(const Level& level, const Body& body, const Index<D>& cell, const Index<D>& k) {
  Vec<D> at;
  for (int d = 0; d < D; ++d) {
    const double apart = level.spacing(d) / body.particlesPerCell[level.axis(d)];
    at[d] = (level.nodePosition(d, cell[d]) + apart * 0.5) + apart * k[d];
  }
  return level.expandPoint<D>(at);
}

/// The part of the depth of the grid that the body fills at a point: the share of its layers of particles, along the
/// axes with one cell, that lie in the shape.
template <int D>
double depthAt(const Level& level, const Body& body, const Vec3& point) {
  Index3 layers = body.particlesPerCell;
  for (int axis = 0; axis < 3; ++axis)
    if (body.fillsDepth || level.cellWidth(axis) == 0) layers[axis] = 1;
  for (int d = 0; d < D; ++d) layers[level.axis(d)] = 1;
  int inside = 0;
  forEach<3>(Box{{}, layers}, [&](const Index3& k) {
    Vec3 at = point;
    for (int axis = 0; axis < 3; ++axis) {
      if (layers[axis] == 1) continue;
      const double apart = level.cellWidth(axis) / layers[axis];
      at[axis] = (level.domain().lower[axis] + apart * 0.5) + apart * k[axis];
    }
    inside += body.shape->contains(at);
  });
  return inside / static_cast<double>(layers[0] * layers[1] * layers[2]);
}

/// Calls `visit(k, point, depth)` for each particle of a body that starts in a cell: `k` is its index in the cell,
/// `point` its position [m], rounded by placeOf, and `depth` its share of the depth of the grid.
template <int D, class Visit>
void forEachParticleIn(const Level& level, const Body& body, const Index<D>& cell, Visit&& visit) {
  if (!level.isInside<D>(cell)) return;
  Box places{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) places.upper[d] = body.particlesPerCell[level.axis(d)];
  forEach<D>(places, [&](const Index<D>& k) {
    const Vec3 point = placeOf<D>(level, body, cell, k);
    if (const double depth = depthAt<D>(level, body, point); depth > 0) visit(k, point, depth);
  });
}

/// A material: its constitutive model and constants, and the bodies made of it.
struct Material {
  std::string name;
  int index = 0;       ///< index of the material in the scene
  double density = 0;  ///< initial density [kg/m^3]
  std::shared_ptr<const Model> model;
  double specificHeat = 0;         ///< specific heat [J/(kg K)]
  double meltTemperature = 0;      ///< melting temperature [K]
  double roomTemperature = 0;      ///< room temperature [K]
  double thermalConductivity = 0;  ///< thermal conductivity [W/(m K)]
  double thermalExpansion = 0;     ///< coefficient of linear expansion [1/K]
  bool isRigid = false;            ///< whether the stress exerts no force
  bool transmitsForce = false;     ///< whether the material moves as one rigid body under the sum of the forces on it
  bool hasMirrorImages = false;    ///< whether its particles have mirror images beyond symmetry planes
  /// Whether this material may provide the planes that separate it from other materials (see SeparatingPlane).
  bool mayLeadContact = true;
  Damage damage;
  Erosion erosion;
  std::vector<Body> bodies;
  std::optional<double> criticalDensity;  ///< density at which its particles just touch [kg/m^3] (DoGranularMPM)
  bool isStressFree = false;              ///< whether F does not change in steps that exceed the critical density
  std::optional<int> grainType;           ///< Grain::type
  bool hasGrainContact = true;            ///< Grain::hasContact
  bool maySplit = false;                  ///< Grain::maySplit
  ParticleId firstIdInCell = 0;           ///< smallest id of its particles, relative to that of their cell

  Grain grain() const { return {grainType.value_or(0), hasGrainContact, maySplit}; }
  MaterialConstants constants() const { return {density, specificHeat, meltTemperature, roomTemperature}; }
  /// The density of a particle at F = I [kg/m^3]; differs from `density`, the density at the start, in bodies with an
  /// initial pressure.
  double undeformedDensity() const { return density * model->initialVolumeRatio(); }
  /// Whether particles may lose strength and then support less than the stress of the constitutive model.
  bool isDamageable() const { return erosion.acts() || !std::holds_alternative<NoDamage>(damage); }
};

/// Largest number of state variables of the model of any material.
inline int largestStateOf(const std::vector<Material>& materials) {
  int size = 0;
  for (const Material& material : materials) size = std::max(size, material.model->stateSize());
  return size;
}

}  // namespace tushar::mpm::solid
