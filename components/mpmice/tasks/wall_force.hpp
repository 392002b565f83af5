#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/wall_friction.hpp"
#include "components/mpmice/wall_pressure.hpp"

namespace tushar::mpmice {

/// Views of the pressure of a cell's gas on the walls at its lower and upper faces [Pa].
template <int D>
struct WallPressures {
  CellView<Vec<D>> below, above;
  static WallPressures from(auto& take) {
    return {.below = take(computes(c::wallPressure<D>[0])), .above = take(computes(c::wallPressure<D>[1]))};
  }
};

/// The walls of a cell, and the pressure on each of them. The gas meets the body along the normal of the body's
/// surface, so that it slips along an oblique wall. Between two walls that face each other, there is no normal, and it
/// meets each along the axis.
template <int D>
class CellWalls {
 public:
  CellWalls(const FreeSpace<D>& space, const Index<D>& cell, const euler::State<D>& w) : w_(w) {
    for (int d = 0; d < D; ++d) faces_[d] = space.faces(cell, d);
    surface_ = space.surface(cell, faces_);
  }
  bool hasWall(int axis, int side) const { return faces_[axis].wall(side) > 0; }
  /// The velocities of the walls at the lower and upper faces along each axis [m/s]; undefined where there is none.
  using Velocities = std::array<std::array<Vec<D>, 2>, D>;
  /// Lets the gas slip less if walls do not form one oblique wall, because they belong to bodies that slide along each
  /// other: half as much if the velocities of any two differ by a quarter of the speed of sound. Walls of less than an
  /// eighth of a face count in proportion, so that a box which touches a face by round-off changes nothing.
  void separate(const Velocities& walls, const euler::Gas& gas) {
    std::array<std::pair<const Vec<D>*, double>, 2 * D> others;
    std::size_t count = 0;
    double apart = 0;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1}) {
        if (!hasWall(d, side)) continue;
        const Vec<D>& own = walls[d][side];
        const double part = std::min(1.0, 8 * faces_[d].wall(side));
        for (std::size_t k = 0; k < count; ++k)
          apart = std::max(apart, std::min(part, others[k].second) * (own - *others[k].first).squaredNorm());
        others[count++] = {&own, part};
      }
    const double c2 = gas.soundSpeedSquared(w_[euler::kDensity], w_[euler::kPressure<D>]);
    surface_.slip *= c2 / (c2 + 16 * apart);
  }
  /// Speed at which the gas approaches a wall [m/s].
  double closing(const Vec<D>& wallVelocity, int axis, int side) const {
    Vec<D> relative;
    for (int d = 0; d < D; ++d) relative[d] = w_[euler::kVelocity(d)] - wallVelocity[d];
    const double outward = side == 0 ? -relative[axis] : relative[axis];
    return surface_.slip * relative.dot(surface_.normal) + (1 - surface_.slip) * outward;
  }
  /// The pressure on a wall [Pa]. `blowing` is the speed of new gas that leaves the wall; it adds to the speed at which
  /// the gas approaches.
  double pressure(const euler::Gas& gas, const Vec<D>& wallVelocity, int axis, int side, double blowing) const {
    return wallPressure(gas, w_[euler::kDensity], w_[euler::kPressure<D>], closing(wallVelocity, axis, side) + blowing);
  }

 private:
  euler::State<D> w_;
  std::array<OpenFaces, D> faces_;
  typename FreeSpace<D>::Surface surface_;
};

/// Views of the new gas that leaves burning walls; its speed and recoil are 0 at other walls.
template <int D>
struct Blowing {
  std::optional<CellView<const Vec<D>>> speeds, recoils;

  static Blowing from(auto& take, bool burns) {
    return {.speeds = take(when(burns, requiresNew(c::blowing<D>, 1))),
            .recoils = take(when(burns, requiresNew(c::recoil<D>, 1)))};
  }
  /// Speed [m/s] of the new gas away from the wall at the lower (0) or upper (1) face of a cell.
  double speed(const Index<D>& cell, int axis, int side) const { return at(speeds, cell, axis, side); }
  /// The pressure that the new gas exerts on the wall at the lower (0) or upper (1) face of a cell [Pa].
  double recoil(const Index<D>& cell, int axis, int side) const { return at(recoils, cell, axis, side); }

 private:
  static double at(const std::optional<CellView<const Vec<D>>>& faces, const Index<D>& cell, int axis, int side) {
    const Index<D> above = side == 0 ? cell : cell + Index<D>::unit(axis);
    if (!faces || !faces->box().contains(above)) return 0;
    const double up = (*faces)[above][axis];  // positive where the gas is below
    return std::max(0.0, side == 0 ? -up : up);
  }
};

/// Computes the pressure on all walls: `pressureOn(law of the gas, cell, walls of the cell, velocity of the wall, axis,
/// side)`.
template <int D, class PressureOn>
void fillWallPressure(const Patch& patch, const Settings& settings, const GasInCells<D>& cells,
                      const typename BodiesAtNodes<D>::Records& records, const WallPressures<D>& walls,
                      PressureOn&& pressureOn) {
  const Level& level = patch.level();
  walls.below.fill(Vec<D>::Zero());
  walls.above.fill(Vec<D>::Zero());
  const NearBodies<D> near(patch.cells(), nearLayers, cells.free, cells.held.density);
  FreeSpace<D> space(level, settings, cells);
  space.measure(near);
  const BodiesAtNodes<D> bodies(level, records);
  namespace lane = mpm::solid::lane;
  near.forEachActingIn(patch.cells(), [&](const Index<D>& cell) {
    if (space.isEmpty(cell) || space.isOpenAround(cell)) return;
    const euler::Gas law = lawAt<D>(settings, cells.held, cells.free[cell], cell);
    CellWalls<D> ofCell(space, cell, cells.primitive(law, cell));
    typename CellWalls<D>::Velocities velocities;
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1})
        if (ofCell.hasWall(d, side))
          velocities[d][side] = bodies.velocityAt(side == 0 ? cell : cell + Index<D>::unit(d), d, lane::velocity);
    if (records.size() > 1) ofCell.separate(velocities, law);
    for (int d = 0; d < D; ++d)
      for (const int side : {0, 1})
        if (ofCell.hasWall(d, side))
          (side == 0 ? walls.below : walls.above)[cell][d] =
              pressureOn(law, cell, ofCell, velocities[d][side], d, side);
  });
}

/// Computes the pressure of the gas on walls, from the velocities of gas and bodies at the start of the step.
template <int D>
void computeWallPressure(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                         const GasInCells<D>& cells, const typename BodiesAtNodes<D>::Records& records,
                         const Blowing<D>& blowing, const WallPressures<D>& walls) {
  fillWallPressure<D>(patch, settings, cells, records, walls,
                      [&](const euler::Gas& law, const Index<D>& cell, const CellWalls<D>& ofCell,
                          const Vec<D>& velocity, int d, int side) {
                        return ofCell.pressure(law, velocity, d, side, blowing.speed(cell, d, side)) +
                               blowing.recoil(cell, d, side);
                      });
}

/// Views of the pressures of computeWallPressure and, if there is friction, of it.
template <int D>
struct KnownWalls {
  CellView<const Vec<D>> below, above;
  std::optional<CellView<const Vec<D>>> friction = {};

  static KnownWalls from(auto& take, int ghost, bool hasFriction) {
    return {.below = take(requiresNew(c::wallPressure<D>[0], ghost)),
            .above = take(requiresNew(c::wallPressure<D>[1], ghost)),
            .friction = take(when(hasFriction, requiresNew(c::wallFriction<D>, ghost)))};
  }
};

/// Force along an axis on the walls at the lower face of a cell [N], exerted by the gas of the cell and by that of the
/// cell below, if there is one.
template <int D>
double forceAt(const Level& level, const FreeSpace<D>& space, const KnownWalls<D>& walls, double reference,
               const Index<D>& cell, int axis) {
  const Box& grid = level.cells();
  const bool periodic = level.isPeriodic(axis);
  double force = 0;
  if (const Index<D> below = cell - Index<D>::unit(axis); periodic || below[axis] >= grid.lower[axis])
    if (const double wall = space.faces(below, axis).wall(1); wall > 0)
      force += wall * (walls.above[below][axis] - reference);
  if (periodic || cell[axis] < grid.upper[axis])
    if (const double wall = space.faces(cell, axis).wall(0); wall > 0)
      force -= wall * (walls.below[cell][axis] - reference);
  return force * level.cellVolume() * level.inverseSpacing(axis);
}

/// Friction along the walls at the lower face of a cell [N], exerted by the gas of the cell and by that of the cell
/// below.
template <int D>
Vec<D> frictionAt(const Level& level, const Settings& settings, const FreeSpace<D>& space, const KnownWalls<D>& walls,
                  const GasInCells<D>& cells, const BodiesAtNodes<D>& bodies, const Index<D>& face, int axis) {
  Vec<D> force = Vec<D>::Zero();
  for (int side = 0; side < 2; ++side) {
    const Index<D> cell = side == 0 ? face : face - Index<D>::unit(axis);
    if (!level.isPeriodic(axis) && (cell[axis] < level.cells().lower[axis] || cell[axis] >= level.cells().upper[axis]))
      continue;
    const Vec<D>& friction = (*walls.friction)[cell];
    if (friction.isZero(0)) continue;
    force -= frictionWeights<D>(level, settings, cells, space, bodies, cell).share(axis, side) * friction;
  }
  return level.cellVolume() * force;
}

/// Whether a cell's lower face along an axis is a face of the grid. The cell may be just beyond the upper side, whose
/// faces belong to the grid.
template <int D>
bool isFace(const Level& level, const Index<D>& cell, int axis) {
  for (int d = 0; d < D; ++d) {
    const int end = level.cells().upper[d] + (d == axis ? 1 : 0);
    if (!level.isPeriodic(d) && (cell[d] < level.cells().lower[d] || cell[d] >= end)) return false;
  }
  return true;
}
/// Whether a patch owns a face: the lower faces of its cells, and those on an upper side of the grid.
template <int D>
bool ownsFace(const Patch& patch, const Index<D>& cell, int axis) {
  const Level& level = patch.level();
  const bool isOnSide = !level.isPeriodic(axis) && cell[axis] == level.cells().upper[axis];
  return patch.cells().contains(isOnSide ? cell - Index<D>::unit(axis) : cell);
}

/// Distributes the force of the gas at each face [N] over the nodes of the face and the bodies (see BodiesAtNodes).
/// Bodies that the gas cannot move receive no force.
template <int D>
void addWallForce(const Patch& patch, const std::vector<mpm::solid::Material>&, const Settings& settings,
                  const GasInCells<D>& cells, const KnownWalls<D>& walls,
                  const typename BodiesAtNodes<D>::Records& records, VectorSum& total,
                  const std::vector<NodeView<Vec<D>>>& forces) {
  const Level& level = patch.level();
  for (const auto& force : forces) force.fill(Vec<D>::Zero());
  const BodiesAtNodes<D> bodies(level, records);
  Box around = patch.cells().grown(1, D);
  for (int d = 0; d < D; ++d) ++around.upper[d];
  const NearBodies<D> near(around, nearLayers, cells.free, cells.held.density);
  FreeSpace<D> space(level, settings, cells);
  space.measure(near);
  const auto addAt = [&](const Index<D>& cell, int axis) {
    if (!walls.friction && space.isOpen(cell, axis)) return;
    Vec<D> force = Vec<D>::Zero();
    if (walls.friction) force = frictionAt<D>(level, settings, space, walls, cells, bodies, cell, axis);
    force[axis] += forceAt<D>(level, space, walls, settings.referencePressure, cell, axis);
    if (force.isZero(0) || !(bodies.massAt(cell, axis) > 0)) return;
    Vec<D> moving = force;
    if (bodies.isOnPlane(cell, axis)) moving[axis] = 0;  // the plane bears it
    if (!settings.areRigid)
      bodies.distribute(cell, axis, [&](std::size_t body, const Index<D>& node, double share) {
        if (forces[body].box().contains(node)) forces[body][node] += moving * share;
      });
    if (ownsFace<D>(patch, cell, axis)) total.add(level.expandDirection<D>(force));
  };
  near.forEachActingIn(around, [&](const Index<D>& cell) {
    for (int axis = 0; axis < D; ++axis)
      if (isFace<D>(level, cell, axis)) addAt(cell, axis);
  });
}

}  // namespace tushar::mpmice
