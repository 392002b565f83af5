#include "components/mpm/solid/body_notes.hpp"

#include <fmt/format.h>

#include "components/mpm/solid/material.hpp"

namespace tushar::mpm::solid {

namespace {

constexpr const char* tagOfBodies = "MaterialProperties/MPM/material/geom_object";

/// Whether `test(point)` holds for any particle of a body that starts in a region of the grid. Stops at the first one.
template <int D, class Test>
bool hasParticle(const Level& level, const Body& body, const input::Box3& region, Test&& test) {
  const Box near = level.cellsNear(region.min, region.max);
  bool found = false;
  for (int slab = near.lower[D - 1]; slab < near.upper[D - 1] && !found; ++slab) {
    Box cells = near;
    cells.lower[D - 1] = slab;
    cells.upper[D - 1] = slab + 1;
    forEach<D>(cells, [&](const Index<D>& cell) {
      if (!found)
        forEachParticleIn<D>(level, body, cell,
                             [&](const Index<D>&, const Vec3& at, double) { found = found || test(at); });
    });
  }
  return found;
}

template <int D>
bool isEmpty(const Level& level, const Body& body) {
  if (body.seeds) return body.seeds->empty();
  return !hasParticle<D>(level, body, body.shape->bounds(), [](const Vec3&) { return true; });
}

/// Whether a particle of one of two bodies starts inside the other one; only for bodies whose particles start in parts
/// of cells.
template <int D>
bool overlap(const Level& level, const Body& one, const Body& other) {
  if (one.seeds || other.seeds) return false;
  const input::Box3 common = one.shape->bounds().common(other.shape->bounds());
  const auto startsIn = [&](const Body& body, const Body& around) {
    return hasParticle<D>(level, body, common, [&](const Vec3& at) { return around.shape->contains(at); });
  };
  return ((common.max - common.min).array() >= 0).all() && (startsIn(one, other) || startsIn(other, one));
}

/// Adds a note if the body starts with a velocity along an axis of which the grid has one cell.
void noteLostVelocity(const Level& level, const Body& body, std::vector<InputProblem>& notes) {
  for (int axis = 0; axis < 3; ++axis) {
    if (level.domain().resolution[axis] > 1) continue;
    const input::Expression& velocity = body.velocity[axis];
    if (velocity.isConstant() && velocity(Vec3::Zero()) == 0) continue;
    notes.push_back({body.where, tagOfBodies,
                     fmt::format("its velocity along {}, {} m/s, does not count: the grid has one cell along {}",
                                 "xyz"[axis], velocity.text(), "xyz"[axis])});
  }
}

/// Whether the grid has one cell along an axis of a vector along which it is not 0, and along none other.
bool isLost(const Level& level, const Vec3& vector) {
  bool isAny = false, isKept = false;
  for (int axis = 0; axis < 3; ++axis) {
    isAny = isAny || vector[axis] != 0;
    isKept = isKept || (vector[axis] != 0 && level.domain().resolution[axis] > 1);
  }
  return isAny && !isKept;
}

/// Adds notes on loads and masters that move nothing, because the grid has one cell along their axes.
void noteLostForces(const Level& level, const Problem& problem, std::vector<InputProblem>& notes) {
  for (const SurfaceLoad& load : problem.start.loads.surfaces)
    if (load.kind == LoadKind::pressure && isLost(level, load.givenDirection()))
      notes.push_back({load.where, "PhysicalBC/MPM/pressure",
                       "pushes along an axis of which the grid has one cell, and so has no effect; a box pushes along "
                       "its thinnest side"});
  for (const BodyLoad& load : problem.start.loads.bodies)
    if (isLost(level, load.forceDensity))
      notes.push_back({load.where, "PhysicalBC/MPM/force",
                       "force_density: acts only along an axis of which the grid has one cell, and so has no effect"});
  for (const Contact& contact : problem.contacts) {
    if (contact.type != Contact::Type::specified) continue;
    Vec3 along;
    for (int axis = 0; axis < 3; ++axis) along[axis] = contact.direction[axis] ? 1 : 0;
    if (isLost(level, along))
      notes.push_back({contact.where, "MaterialProperties/MPM/contact",
                       fmt::format("direction: {} the other materials follow the master only along an axis of which "
                                   "the grid has one cell, so that they do not follow it; give a <direction>",
                                   contact.directionIsGiven ? "as given," : "without it,")});
  }
}

template <int D>
std::vector<InputProblem> notesOn(const Level& level, const Problem& problem) {
  std::vector<InputProblem> notes;
  noteLostForces(level, problem, notes);
  for (const Material& material : problem.materials)
    for (std::size_t k = 0; k < material.bodies.size(); ++k) {
      const Body& body = material.bodies[k];
      if (isEmpty<D>(level, body))
        notes.push_back({body.where, tagOfBodies, "has no particles: it is outside the grid, or too small for <res>"});
      noteLostVelocity(level, body, notes);
      for (std::size_t before = 0; before < k && problem.insertions.empty(); ++before)
        if (const Body& other = material.bodies[before]; overlap<D>(level, body, other)) {
          notes.push_back({body.where, tagOfBodies,
                           fmt::format("overlaps the geom_object of the same material on line {}: particles of both "
                                       "start in the same place, so mass is there twice",
                                       other.where.line)});
          break;
        }
    }
  return notes;
}

}  // namespace

std::vector<InputProblem> notesOnBodies(const Level& level, const Problem& problem) {
  if (level.dimension() == 1) return notesOn<1>(level, problem);
  return level.dimension() == 2 ? notesOn<2>(level, problem) : notesOn<3>(level, problem);
}

}  // namespace tushar::mpm::solid
