#pragma once

#include "components/mpmice/free_space.hpp"
#include "components/mpmice/tasks/measure_bodies.hpp"

namespace tushar::mpmice {

/// Calls `visit(cell, part)` for the cells that contain parts of a box, whose coordinates are relative to the cell
/// `origin`. `part` is a fraction of the box; the parts add up to 1. What is outside the grid counts for the nearest
/// cell, so that a box beside a symmetry plane has the parts of its mirror image.
template <int D, class Visit>
void forEachPart(const Level& level, const Index<D>& origin, const ParticleBox<D>& box, Visit&& visit) {
  std::array<std::array<double, 4>, D> lengths;
  Box reach{{}, Index3::filled(1)};
  for (int d = 0; d < D; ++d) {
    const int least = static_cast<int>(std::floor(box.middle[d] - 0.5 * box.edges[d]));
    const Quad along = box.lengthsIn(d, Quad{0, 1, 2, 3} + least);
    // Round-off decides on parts that are less than this.
    for (int i = 0; i < 4; ++i) lengths[d][i] = along[i] < offRoundShares ? 0 : along[i];
    reach.lower[d] = least;
    reach.upper[d] = static_cast<int>(std::floor(box.middle[d] + 0.5 * box.edges[d])) + 1;
  }
  if (reach.size() == 1 && !level.boxes()) {
    Index<D> only = origin;
    for (int d = 0; d < D; ++d) only[d] += reach.lower[d];
    return visit(nearestOnGrid<D>(level, only), 1.0);
  }
  const auto forEachVolume = [&](auto&& use) {
    forEach<D>(reach, [&](const Index<D>& at) {
      double volume = 1;
      for (int d = 0; d < D; ++d) volume *= lengths[d][at[d] - reach.lower[d]];
      if (volume > 0) use(nearestOnGrid<D>(level, origin + at), volume);
    });
  };
  const auto isThere = [&](const Index<D>& cell) { return !level.boxes() || level.isInside<D>(cell); };
  double whole = 0;
  forEachVolume([&](const Index<D>& cell, double volume) { whole += isThere(cell) ? volume : 0; });
  if (!(whole > 0)) return visit(origin, 1.0);
  forEachVolume([&](const Index<D>& cell, double volume) {
    if (isThere(cell)) visit(cell, volume / whole);
  });
}

/// The box of a particle at the end of a step, relative to the cell in which it started the step.
template <int D>
ParticleBox<D> boxAtEnd(const mpm::CellFrame<D>& frame, const Vec<D>& x, const Vec<D>& edges) {
  return {withinReach<D>(frame.coordinates(x), edges), edges};
}

/// Views of the particles of a body after a step, on a patch and around it.
template <int D>
struct WarmParticles {
  Boxes<D> boxes;
  ParticleView<const double> mass, temperature;

  /// `isBurning` tells whether masses change in the step.
  static WarmParticles from(auto& take, bool isBurning) {
    Boxes<D> boxes = Boxes<D>::from(take, readsNew);
    return {.boxes = std::move(boxes),
            .mass = take(isBurning ? requiresNew(p::mass, boxReach) : requiresOld(p::mass, boxReach)),
            .temperature = take(requiresNew(p::temperature, boxReach))};
  }
};

/// Views of a body in cells; see WarmBody.
struct NewWarmBody {
  CellView<double> capacity, temperature, volume;

  static NewWarmBody from(auto& take) {
    return {.capacity = take(computes(c::capacityOfBody)),
            .temperature = take(computes(c::temperatureOfBody)),
            .volume = take(computes(c::volumeOfBody))};
  }
};

/// Computes the heat capacity [J/(m³ K)] of a body in each cell, its mean temperature [K] and the volume of its boxes,
/// divided by that of the cell.
template <int D>
void measureHeatOfBody(const Patch& patch, const mpm::solid::Material& material, const WarmParticles<D>& particles,
                       const NewWarmBody& found) {
  const Level& level = patch.level();
  for (const CellView<double>& field : {found.capacity, found.temperature, found.volume}) field.fill(0);
  const double perMass = material.specificHeat / level.cellVolume();
  const ParticleView<const Vec<D>>&x = particles.boxes.x, &edges = particles.boxes.edges;
  forEachCell<D>(level, x, [&](const Index<D>& cell, const mpm::CellFrame<D>& frame, const auto& range) {
    for (const int p : range) {
      if (x[p][0] == data::removed) continue;
      const double capacity = particles.mass[p] * perMass, volume = edges[p].prod();
      forEachPart<D>(level, cell, boxAtEnd<D>(frame, x[p], edges[p]), [&](const Index<D>& at, double part) {
        if (!found.capacity.box().contains(at)) return;
        found.capacity[at] += part * capacity;
        found.temperature[at] += part * capacity * particles.temperature[p];
        found.volume[at] += part * volume;
      });
    }
  });
  forEach<D>(patch.cells(), [&](const Index<D>& cell) {
    if (found.capacity[cell] > 0) found.temperature[cell] /= found.capacity[cell];
  });
}

/// The mean of a number of cells over a box, whose coordinates are relative to the cell `origin`.
template <int D>
double meanOver(const Level& level, const Index<D>& origin, const ParticleBox<D>& box,
                const CellView<const double>& numbers) {
  double mean = 0;
  forEachPart<D>(level, origin, box, [&](const Index<D>& at, double part) { mean += part * numbers[at]; });
  return mean;
}

/// Adds to the temperature of each particle the mean of c.warming over its box.
template <int D>
void warmBody(const Patch& patch, const mpm::solid::Material&, ParticleView<const Vec<D>> x,
              ParticleView<const Vec<D>> edges, CellView<const double> warming, ParticleView<double> temperature) {
  const Level& level = patch.level();
  forEachCell<D>(level, x, [&](const Index<D>& cell, const mpm::CellFrame<D>& frame, const auto& range) {
    for (const int p : range) {
      if (x[p][0] == data::removed) continue;
      temperature[p] += meanOver<D>(level, cell, boxAtEnd<D>(frame, x[p], edges[p]), warming);
    }
  });
}

}  // namespace tushar::mpmice
