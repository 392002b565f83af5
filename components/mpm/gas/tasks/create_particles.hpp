#pragma once

#include "components/mpm/gas/labels.hpp"
#include "components/mpm/gas/material.hpp"
#include "components/mpm/gas/mirror_symmetry.hpp"
#include "components/mpm/particles/ids.hpp"

namespace tushar::mpm::gas {

/// Throws InputError if another body of the gas also contains the point.
void refuseOverlap(const Gas& gas, const GasObject& object, const Vec3& point);

/// The message about a body without particles on the grid.
InputProblem emptyBody(const Level& level, const GasObject& object);

/// Throws InputError unless the density is positive, the pressure is not negative, and the whole state is finite.
void refuseImpossible(const GasObject& object, const Vec3& point, double density, double pressure,
                      const Vec3& velocity);

/// A random number in (0, 1) that depends only on its arguments, neither on the patches nor on the order of calls.
/// `place` numbers the particles that a cell could hold.
double drawn(int seed, std::uint64_t cellNumber, int place, int axis);

/// The coordinate, along an axis, of a particle in the k-th of `parts` equal parts of its cell: -1/2 is the lower face
/// of the cell, 1/2 the upper. `draw()` returns a random number in (0, 1).
template <class Draw>
double placeInCell(Placement placement, int k, int parts, const Draw& draw) {
  if (placement == Placement::random) return draw() - 0.5;
  return (k - 0.5 * (parts - 1) + (placement == Placement::jittered ? draw() - 0.5 : 0.0)) / parts;
}

/// Calls `visit(x)` for each position [m] in a cell at which a particle of the object is placed at the start; `place`
/// counts them.
template <int D, class Visit>
void forEachPlace(const Level& level, const GasObject& object, const Index<D>& cell, int& place, const Visit& visit) {
  Box places{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) places.upper[d] = object.particlesPerCell[level.axis(d)];
  forEach<D>(places, [&](const Index<D>& k) {
    Vec<D> at;
    for (int d = 0; d < D; ++d) {
      const double offset = placeInCell(object.placement, k[d], places.upper[d],
                                        [&] { return drawn(object.seed, level.cellNumber(cell), place, d); });
      at[d] = positionInCell(level, d, cell[d], offset);
    }
    ++place;
    visit(at);
  });
}

/// Throws InputError if a body has no particle on the whole grid.
template <int D>
void checkBodies(const Level& level, const Gas& gas) {
  std::vector<InputProblem> problems;
  int before = 0, place = 0;
  for (const GasObject& object : gas.objects) {
    bool found = false;
    const input::Box3 bounds = object.shape->bounds();
    forEach<D>(level.cellsNear(bounds.min, bounds.max), [&](const Index<D>& cell) {
      if (found) return;
      place = before;
      forEachPlace<D>(level, object, cell, place,
                      [&](const Vec<D>& at) { found = found || object.shape->owns(level.expandPoint<D>(at)); });
    });
    if (!found) problems.push_back(emptyBody(level, object));
    before = place;
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

/// Fills each body with its particles: `particlesPerCell` along each axis, at the centres of equal parts of the cell,
/// x_p = (c + (k + 1/2) / N) h, or as the `placement` of the body specifies. Only points that belong to the shape get a
/// particle, with the body's state at the point.
///
/// The id of a particle is its cell's number and its place in the cell, so that it does not depend on the patches.
/// Throws InputError where two bodies contain the same point, and for a body without a particle on the grid.
template <int D>
void createParticles(const Patch& patch, const Gas& gas, ParticleMaker& maker, std::vector<Vec<D>>& x,
                     std::vector<Vec<D>>& velocity, std::vector<double>& density, std::vector<double>& internalEnergy) {
  const Level& level = patch.level();
  if (patch.id() == 0) checkBodies<D>(level, gas);
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    ParticleId inCell = 0;
    int place = 0;
    for (const GasObject& object : gas.objects) {
      forEachPlace<D>(level, object, cell, place, [&](const Vec<D>& at) {
        const Vec3 point = level.expandPoint<D>(at);
        if (!object.shape->owns(point)) return;
        refuseOverlap(gas, object, point);
        maker.add(cell, idOf<D>(level, cell, inCell++, object.where));
        const double rho = object.density(point), p = object.pressure(point);
        const Vec3 v = object.velocity(point);
        refuseImpossible(object, point, rho, p, v);
        x.push_back(at);
        velocity.push_back(level.reduce<D>(v));
        density.push_back(rho);
        internalEnergy.push_back(gas.internalEnergy(rho, p));
      });
    }
  });
}

}  // namespace tushar::mpm::gas
