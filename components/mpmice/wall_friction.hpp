#pragma once

#include <limits>

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/bodies_at_nodes.hpp"
#include "components/mpmice/free_space.hpp"
#include "components/mpmice/gas_diffusion.hpp"
#include "components/mpmice/near_bodies.hpp"

namespace tushar::mpmice {

/// Thickness, in cells, of the layer of gas that the velocity of a cell represents. For a small cell, it includes the
/// neighbour with which the cell is merged.
inline double layerOf(double free) { return free < smallFreeVolume ? 1 + free : free; }

/// The drag of the walls of a cell on its gas, for each face, per cell volume: the viscosity times the area of the
/// wall, divided by the distance from the wall to the middle of the gas, and a coefficient of momentum exchange times
/// a quarter of the part of the face that is wall. The area is measured along the surface of the body.
template <int D>
class CellFriction {
 public:
  /// `massAt(face, axis)` is the mass of the bodies at the face; a wall without mass causes no drag.
  /// `coefficientAt(face, axis)` is their coefficient of momentum exchange with the gas of the cell [kg/(m³ s)].
  template <class MassAt, class CoefficientAt>
  CellFriction(const Level& level, const FreeSpace<D>& space, const Index<D>& cell, double free, double viscosity,
               MassAt&& massAt, CoefficientAt&& coefficientAt) {
    std::array<OpenFaces, D> all;
    for (int a = 0; a < D; ++a) all[a] = space.faces(cell, a);
    surface_ = space.surface(cell, all);
    const double slip = surface_.slip;
    for (int a = 0; a < D; ++a) {
      const OpenFaces& faces = all[a];
      const double along = slip * std::abs(surface_.normal[a]) + (1 - slip);
      const double perWidth = level.inverseSpacing(a);
      for (int side = 0; side < 2; ++side) {
        const double wall = faces.wall(side);
        const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(a);
        if (!(wall > 0) || !(massAt(face, a) > 0)) continue;
        const double viscous = viscosity * wall * along * perWidth * perWidth / (0.5 * layerOf(free));
        drag_[a][side] = viscous + 0.25 * coefficientAt(face, a) * wall * along;
        viscous_ += viscous;
        all_ += drag_[a][side];
      }
    }
  }

  /// Sum of the drag of all walls [Pa s/m²]; 0 without walls.
  double all() const { return all_; }
  /// The part of it that is due to viscosity.
  double viscous() const { return viscous_; }
  /// The fraction of the friction that acts at a face.
  double share(int axis, int side) const { return drag_[axis][side] > 0 ? drag_[axis][side] / all_ : 0; }
  /// The component of a velocity along the walls: without its component into an oblique wall or, between several walls,
  /// into each of them.
  Vec<D> alongWalls(const Vec<D>& velocity) const {
    Vec<D> along = velocity - surface_.slip * velocity.dot(surface_.normal) * surface_.normal;
    for (int a = 0; a < D; ++a) along[a] -= (1 - surface_.slip) * (share(a, 0) + share(a, 1)) * velocity[a];
    return along;
  }

 private:
  typename FreeSpace<D>::Surface surface_;
  std::array<std::array<double, 2>, D> drag_{};
  double all_ = 0, viscous_ = 0;
};

/// Computes the drag of the walls of a cell with gas, and the fraction of it at each face.
template <int D>
CellFriction<D> frictionWeights(const Level& level, const Settings& settings, const GasInCells<D>& cells,
                                const FreeSpace<D>& space, const BodiesAtNodes<D>& bodies, const Index<D>& cell) {
  const double viscosity = viscosityAtWalls<D>(level, settings, cells, cell);
  const auto massAt = [&](const Index<D>& face, int axis) { return bodies.massAt(face, axis); };
  const auto coefficientAt = [&](const Index<D>& face, int axis) {
    double sum = 0;
    for (std::size_t k = 0; k < settings.drag.ofGases.size(); ++k)
      sum += (settings.gases.empty() ? 1 : cells.held.shares[k][cell]) *
             bodies.meanAt(face, axis, settings.drag.ofGases[k]);
    return sum;
  };
  return {level, space, cell, cells.free[cell], viscosity, massAt, coefficientAt};
}

/// Computes the friction force on the gas of a cell in a step, per cell volume [N/m³].
template <int D>
struct FrictionOfStep {
  const Level& level;
  const Settings& settings;
  const GasInCells<D>& cells;
  const FreeSpace<D>& space;
  const BodiesAtNodes<D>& bodies;
  double dt;

  /// The friction of a cell. That of viscosity is limited so that gas and walls do not pass a common velocity within
  /// the step. Drag by coefficients, which may be any, is limited further, so that they do not pass it together with
  /// all other cells that push the same nodes, either, or whose gas is merged with that of the cell.
  Vec<D> on(const Index<D>& cell) const {
    const CellFriction<D> weights = frictionWeights<D>(level, settings, cells, space, bodies, cell);
    if (!(weights.all() > 0)) return Vec<D>::Zero();
    Vec<D> walls = Vec<D>::Zero();
    double ofBodies = 0;
    for (int a = 0; a < D; ++a)
      for (int side = 0; side < 2; ++side) {
        const double share = weights.share(a, side);
        if (!(share > 0)) continue;
        const Index<D> face = side == 0 ? cell : cell + Index<D>::unit(a);
        walls += share * bodies.velocityAt(face, a, mpm::solid::lane::velocity);
        ofBodies += share / bodies.massAt(face, a);
      }
    if (settings.areRigid) ofBodies = 0;
    const Vec<D> gas = cells.held.momentum[cell] / cells.held.density[cell];
    ofBodies *= level.cellVolume();
    const double viscous = std::min(weights.viscous(), 1 / (dt * (1 / massAbout(cell) + ofBodies)));
    const double most = 1 / (dt * (1 / cells.held.density[cell] + facesOfNode * ofBodies));
    const double drag = std::min(weights.all() - weights.viscous(), std::max(0.0, most - viscous));
    return (viscous + drag) * weights.alongWalls(walls - gas);
  }

 private:
  /// The largest number of faces whose drag a node takes: those of the cells around it along each axis, in three
  /// layers.
  static constexpr double facesOfNode = D * 3 * (1 << (D - 1));

  /// The mass, per cell volume, on which the friction in a cell acts [kg/m³]. A small cell is merged with one of the
  /// larger cells around it at the end of the step, so that the least of their masses counts, too. It does not if it is
  /// much greater than that of the cell: merged cells have the same density, so they were not merged before, and the
  /// traces of gas behind a body that leaves a wall could not take the friction of a dense gas.
  double massAbout(const Index<D>& cell) const {
    const double own = cells.held.density[cell], free = cells.free[cell];
    if (!(free < smallFreeVolume)) return own;
    double least = std::numeric_limits<double>::infinity();
    forEach<D>(level.clipCells(cellsAround<D>(cell, 1)), [&](const Index<D>& next) {
      if (!space.isEmpty(next) && cells.free[next] >= smallFreeVolume)
        least = std::min(least, cells.held.density[next]);
    });
    constexpr double alike = 10;
    return least * free < alike * own ? own + least : own;
  }
};

/// Computes the friction of walls on the gas of each cell, from the velocities of gas and walls at the start of the
/// step.
template <int D>
void computeWallFriction(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                         double dt, const GasInCells<D>& cells, const typename BodiesAtNodes<D>::Records& records,
                         CellView<Vec<D>> friction) {
  const Level& level = patch.level();
  friction.fill(Vec<D>::Zero());
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  const FreeSpace<D> space(level, settings, cells);
  const BodiesAtNodes<D> bodies(level, records);
  const FrictionOfStep<D> step{level, settings, cells, space, bodies, dt};
  near.forEachIn(patch.cells(), [&](const Index<D>& cell) {
    if (!space.isEmpty(cell)) friction[cell] = step.on(cell);
  });
}

}  // namespace tushar::mpmice
