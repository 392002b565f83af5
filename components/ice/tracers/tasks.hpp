#pragma once

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "components/ice/tracers/flow.hpp"
#include "components/ice/tracers/tracers.hpp"

// The bodies of the tasks of tracers.

namespace tushar::ice {

/// The velocity of a gas without bodies; 0 in cells without gas.
template <int D>
void findFlow(const Patch& patch, CellView<const double> density, CellView<const Vec<D>> momentum,
              CellView<Vec<D>> flow) {
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    flow[cell] = density[cell] > 0 ? Vec<D>(momentum[cell] / density[cell]) : Vec<D>(Vec<D>::Zero());
  });
}

/// The place of the n-th tracer in a cell, each coordinate from 0 to 1: {1/2 + n a_d}, with a_d = g^-(d+1) and
/// g^(D+1) = g + 1. Such points fill a cell evenly, however many there are. Source: H. Niederreiter, Random Number
/// Generation and Quasi-Monte Carlo Methods, SIAM 1992, chapter 3; with D = 1 these are multiples of the golden ratio.
template <int D>
Vec<D> placeInCell(std::uint64_t n) {
  static const double g = [] {
    double root = 1.5;
    for (int k = 0; k < 60; ++k) root = std::pow(1 + root, 1.0 / (D + 1));
    return root;
  }();
  Vec<D> place;
  double step = 1;
  for (int d = 0; d < D; ++d) {
    step /= g;
    const double sum = 0.5 + static_cast<double>(n) * step;
    place[d] = sum - std::floor(sum);
  }
  return place;
}

/// The point [m] of the n-th tracer in a cell.
template <int D>
Vec<D> pointInCell(const Level& level, const Index<D>& cell, std::uint64_t n) {
  const Vec<D> place = placeInCell<D>(n);
  Vec<D> x;
  for (int d = 0; d < D; ++d) x[d] = level.nodePosition(d, cell[d]) + place[d] * level.spacing(d);
  return x;
}

/// The values of new tracers, one list for each variable.
template <int D>
struct NewTracers {
  std::vector<Vec<D>>&x, &velocity, &displacement;
  std::vector<std::vector<double>*> scalars, decays;  ///< of each scalar; of each one that decays

  static NewTracers from(auto& take, const TracerScalars* carried) {
    NewTracers made{take(creates(p::x<D>)), take(creates(p::velocity<D>)), take(creates(p::displacement<D>)), {}, {}};
    for (const auto& one : *carried) made.scalars.push_back(&take(creates(one->value())));
    for (const auto& one : *carried)
      if (one->decays()) made.decays.push_back(&take(creates(one->totalDecay())));
    return made;
  }
  /// Adds a tracer at a point; its velocity is not known yet.
  void add(const Vec<D>& at, const TracerScalars& carried) const {
    x.push_back(at);
    velocity.push_back(Vec<D>::Zero());
    displacement.push_back(Vec<D>::Zero());
    for (std::size_t k = 0; k < scalars.size(); ++k) scalars[k]->push_back(carried[k]->settings().initialValue);
    for (std::vector<double>* decay : decays) decay->push_back(0);
  }
};

/// The values of the tracers that there are; those that are kept need them all.
template <int D>
struct KnownTracers {
  ParticleView<const ParticleId> id;
  ParticleView<const Vec<D>> x, velocity, displacement;
  std::vector<ParticleView<const double>> scalars, decays;

  static KnownTracers from(auto& take, const TracerScalars* carried) {
    KnownTracers known{take(requiresNew(data::particleId)),
                       take(requiresNew(p::x<D>)),
                       take(requiresNew(p::velocity<D>)),
                       take(requiresNew(p::displacement<D>)),
                       {},
                       {}};
    for (const auto& one : *carried) known.scalars.push_back(take(requiresNew(one->value())));
    for (const auto& one : *carried)
      if (one->decays()) known.decays.push_back(take(requiresNew(one->totalDecay())));
    return known;
  }
};

/// Calls `visit(cell)` for the cells of a patch whose centre a region contains.
template <int D, class Visit>
void forEachCellOf(const Patch& patch, const TracerRegion& region, Visit&& visit) {
  const Level& level = patch.level();
  const input::Box3 bounds = region.shape->bounds();
  forEach<D>(level.cellsNear(bounds.min, bounds.max).intersect(patch.cells()), [&](const Index<D>& cell) {
    if (region.shape->owns(level.expandPoint<D>(level.cellCentre<D>(cell)))) visit(cell);
  });
}

inline constexpr const char* initialRegionPath = "Models/Model/TracerParticles/tracer/initialization/geom_object";
/// Number of ids for the tracers of a cell at the start.
inline constexpr ParticleId tracersOfCell = 1 << 16;

/// The number of tracers that the first `count` regions put into a cell at the start.
template <int D>
ParticleId placedBefore(const Level& level, const Tracers& tracers, std::size_t count, const Index<D>& cell) {
  const Vec3 centre = level.expandPoint<D>(level.cellCentre<D>(cell));
  ParticleId sum = 0;
  for (std::size_t r = 0; r < count; ++r)
    if (tracers.initial[r].shape->owns(centre)) sum += tracers.initial[r].perCell;
  return sum;
}

/// Makes the tracers at the start, if the time is between those of the settings. Those of several regions in a cell
/// continue the same sequence of places.
template <int D>
void placeTracers(const Patch& patch, const Tracers& tracers, ParticleMaker& maker, const TracersOfGases* all,
                  double time, const NewTracers<D>& made) {
  if (time < all->settings().start || time > all->settings().stop) return;
  const Level& level = patch.level();
  const auto& regions = tracers.initial;
  for (std::size_t r = 0; r < regions.size(); ++r)
    forEachCellOf<D>(patch, regions[r], [&](const Index<D>& cell) {
      const ParticleId first = placedBefore<D>(level, tracers, r, cell);
      const ParticleId end = first + regions[r].perCell;
      if (end > tracersOfCell)
        throw InputError({{regions[r].where, initialRegionPath,
                           fmt::format("a cell can contain at most {} tracer particles at the start, but the regions "
                                       "put more than that into one cell",
                                       tracersOfCell)}});
      for (ParticleId k = first; k < end; ++k) {
        maker.add<D>(cell, level.cellNumber<D>(cell) * tracersOfCell + k);
        made.add(pointInCell<D>(level, cell, k), all->scalars());
      }
    });
}

/// The number of tracers that a region has made in each of its cells by a time [s]. Round-off of the time does not
/// change it: 1e-9 is far more than this, and far less than one tracer.
inline std::uint64_t madeBy(double time, const TracerSettings& settings, const TracerRegion& region) {
  const double since = std::min(time, settings.stop) - settings.start;
  return since <= 0 ? 0 : static_cast<std::uint64_t>(region.perCellPerTime * since + 1e-9);
}

/// Makes the tracers that are due in a step from `time` on. Their number follows from the time alone, so that it does
/// not depend on the lengths of steps. Those of all sources in a cell, and those at the start, have different places.
template <int D>
void insertTracers(const Patch& patch, const Tracers& tracers, ParticleMaker& maker, const TracersOfGases* all,
                   double time, double dt, const KnownTracers<D>& known, const NewTracers<D>& made) {
  constexpr ParticleId isInserted = ParticleId{1} << 63;
  const Level& level = patch.level();
  const auto& sources = tracers.sources;
  std::size_t inserted = 0;
  for (std::size_t r = 0; r < sources.size(); ++r) {
    const std::uint64_t from = madeBy(time, all->settings(), sources[r]),
                        to = madeBy(time + dt, all->settings(), sources[r]);
    if (from == to) continue;
    forEachCellOf<D>(patch, sources[r], [&](const Index<D>& cell) {
      const ParticleId placed = placedBefore<D>(level, tracers, tracers.initial.size(), cell);
      for (std::uint64_t n = from; n < to; ++n, ++inserted) {
        const std::uint64_t number = n * sources.size() + r;
        maker.add<D>(cell, isInserted | (number * level.cells().size() + level.cellNumber<D>(cell)));
        made.add(pointInCell<D>(level, cell, placed + number), all->scalars());
      }
    });
  }
  inserted == 0 ? maker.keepAll() : maker.keep(0, known.x.owned());
}

/// Calls `visit(p, cell)` for the tracers of a patch.
template <int D, class Visit>
void forEachTracer(const Patch& patch, ParticleView<const Vec<D>> x, Visit&& visit) {
  x.template forEachOccupied<D>(patch.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    for (const int p : range) visit(p, cell);
  });
}

/// Sets the velocities of tracers to those of the flow at a time [s].
template <int D>
void setTracerVelocity(const Patch& patch, const Tracers&, const euler::Gas& gas, double time, double dt,
                       CellView<const Vec<D>> velocity, ParticleView<const Vec<D>> x, ParticleView<Vec<D>> v) {
  const Flow<D> flow(patch, gas, time + dt, velocity);
  forEachTracer<D>(patch, x, [&](int p, const Index<D>& cell) { v[p] = flow.at(x[p], cell); });
}

/// Positions and velocities of tracers before and after a step.
template <int D>
struct MovingTracers {
  ParticleView<const Vec<D>> x, velocity, displacement;
  ParticleView<Vec<D>> newX, newVelocity, newDisplacement;

  static MovingTracers from(auto& take) {
    return {.x = take(requiresOld(p::x<D>)),
            .velocity = take(requiresOld(p::velocity<D>)),
            .displacement = take(requiresOld(p::displacement<D>)),
            .newX = take(computes(p::x<D>)),
            .newVelocity = take(computes(p::velocity<D>)),
            .newDisplacement = take(computes(p::displacement<D>))};
  }
};

/// Moves tracers by Heun's method, which is of second order: x* = x + dt v(x, t), x' = x + dt/2 (v(x, t) + v(x*, t')).
/// The velocity of a tracer is v(x, t) at the start and v(x', t') at the end of the step. Walls and symmetry planes
/// reflect.
template <int D>
void moveTracers(const Patch& patch, const Tracers&, const euler::Gas& gas, double time, double dt,
                 CellView<const Vec<D>> velocity, const MovingTracers<D>& tracers) {
  const Flow<D> flow(patch, gas, time + dt, velocity);
  forEachTracer<D>(patch, tracers.x, [&](int p, const Index<D>& cell) {
    const Vec<D>&x = tracers.x[p], &v = tracers.velocity[p];
    Vec<D> end = x + dt * v;
    flow.reflect(end, cell);
    end = x + (0.5 * dt) * (v + flow.at(end, cell));
    flow.reflect(end, cell);
    tracers.newX[p] = end;
    tracers.newVelocity[p] = flow.at(end, cell);
    tracers.newDisplacement[p] = tracers.displacement[p] + (end - x);
  });
}

/// A scalar that decays, before and after a step.
template <int D>
struct DecayingScalar {
  ParticleView<const Vec<D>> x, newX;
  ParticleView<const double> value, totalDecay;
  ParticleView<double> newValue, newTotalDecay;

  static DecayingScalar from(auto& take, const TracerScalar* scalar) {
    return {.x = take(requiresOld(p::x<D>)),
            .newX = take(requiresNew(p::x<D>)),
            .value = take(requiresOld(scalar->value())),
            .totalDecay = take(requiresOld(scalar->totalDecay())),
            .newValue = take(computes(scalar->value())),
            .newTotalDecay = take(computes(scalar->totalDecay()))};
  }
};

/// Lets a scalar s of tracers fall by ds/dt = -(c1 c2 + c3) s, with the mean of c2 at the start and at the end of the
/// step.
template <int D>
void decayTracerScalar(const Patch& patch, const Tracers&, const ScalarDecay& decay, double dt,
                       CellView<const double> coefficient, const DecayingScalar<D>& scalar) {
  const Level& level = patch.level();
  forEachTracer<D>(patch, scalar.x, [&](int p, const Index<D>& cell) {
    Index<D> end = level.cellOf<D>(scalar.newX[p]);
    if (!coefficient.box().contains(end)) end = cell;
    const double c2 = 0.5 * (coefficient[cell] + coefficient[end]);
    scalar.newValue[p] = scalar.value[p] * std::exp(-(decay.factor * c2 + decay.linearRate) * dt);
    scalar.newTotalDecay[p] = scalar.totalDecay[p] + c2 * dt;
  });
}

/// Keeps a scalar of tracers that does not decay.
inline void keepTracerScalar(const Patch&, const Tracers&, ParticleView<const double> before,
                             ParticleView<double> after) {
  for (int p = 0; p < after.owned(); ++p) after[p] = before[p];
}

/// Shows the value of a variable in the cells of tracers.
template <int D>
void cloneToTracers(const Patch& patch, const Tracers&, CellView<const double> value, ParticleView<const Vec<D>> x,
                    ParticleView<double> clone) {
  forEachTracer<D>(patch, x, [&](int p, const Index<D>& cell) { clone[p] = value[cell]; });
}

/// Counts the tracers of a patch.
template <int D>
void countTracers(const Patch&, const Tracers&, ParticleView<const Vec<D>> x, Sum& total) {
  total.add(x.owned());
}

}  // namespace tushar::ice
