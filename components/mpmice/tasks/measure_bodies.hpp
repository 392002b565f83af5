#pragma once

#include "components/mpm/solid/material.hpp"
#include "components/mpmice/free_shares.hpp"
#include "components/mpmice/gas_in_cells.hpp"
#include "components/mpmice/near_bodies.hpp"
#include "components/mpmice/particle_box.hpp"
#include "components/mpmice/tasks/fill_outside.hpp"
#include "core/data/vanished.hpp"

namespace tushar::mpmice {

/// Number of layers of cells around a patch in which particles may have boxes that extend into the patch, before or
/// after a step.
inline constexpr int boxReach = 2;

/// Computes the edges of the box of each particle, from its initial size in cells, F, and its unburned fraction.
template <int D>
void findBoxes(const Patch& patch, const mpm::solid::Material&, ParticleView<const Vec<D>> size,
               ParticleView<const mpm::solid::Matrix3> deformation,
               const std::optional<ParticleView<const double>>& unburned, ParticleView<Vec<D>> edges) {
  for (int p = 0; p < edges.owned(); ++p) {
    edges[p] = edgesOf<D>(patch.level(), size[p], deformation[p]);
    if (unburned && (*unburned)[p] < 1) edges[p] *= std::pow((*unburned)[p], 1.0 / D);
  }
}

/// Views of the positions and box edges of the particles of a material, on a patch and around it.
template <int D>
struct Boxes {
  ParticleView<const Vec<D>> x, edges;

  /// `reads` is readsOld for the values at the start of a step, or readsNew for those computed in it.
  static Boxes from(auto& take, auto reads) {
    return {.x = take(reads(p::x<D>, boxReach)), .edges = take(reads(p::boxEdges<D>, boxReach))};
  }
  ParticleBox<D> of(const mpm::CellFrame<D>& frame, int p) const { return {frame.coordinates(x[p]), edges[p]}; }
};

/// The box of a particle before a step, the same box where it is after the step, and the box after the step.
template <int D>
using Move = std::array<ParticleBox<D>, 3>;

/// Views of the boxes of particles before and after a step.
template <int D>
struct MovedBoxes {
  Boxes<D> before, after;
  std::optional<ParticleView<const Vec<D>>> aheadBefore = {}, ahead = {};  ///< if a side of the grid is open

  static MovedBoxes from(auto& take, bool opensAtSides) {
    Boxes<D> before = Boxes<D>::from(take, readsOld), after = Boxes<D>::from(take, readsNew);
    return {.before = std::move(before),
            .after = std::move(after),
            .aheadBefore = take(when(opensAtSides, requiresOld(p::ahead<D>, boxReach))),
            .ahead = take(when(opensAtSides, requiresNew(p::ahead<D>, boxReach)))};
  }
  Move<D> of(const mpm::CellFrame<D>& frame, int p) const;
};

/// The cells of a view in a box of cells around the cell `origin`; `reach` is relative to this cell.
template <int D, class T>
Box cellsIn(const CellView<T>& view, const Index<D>& origin, const Box& reach) {
  Index3 shift{};
  for (int d = 0; d < D; ++d) shift[d] = origin[d];
  return reach.shifted(shift).intersect(view.box());
}

/// Calls `visit(cell, frame, particles)` for the cells around a patch that contain particles, which are ordered by id.
template <int D, class Visit>
void forEachCell(const Level& level, const ParticleView<const Vec<D>>& x, Visit&& visit) {
  x.template forEachOccupied<D>(x.cells(), [&](const Index<D>& cell, const data::ParticleRange& range) {
    visit(cell, mpm::CellFrame<D>(level, cell), range);
  });
}

/// Takes the boxes of a body, and their mirror images, from the free shares of a patch.
template <int D>
void takeBoxes(const Level& level, const Boxes<D>& boxes, TakenShares<D>& taken) {
  forEachCell<D>(level, boxes.x, [&](const Index<D>& cell, const mpm::CellFrame<D>& frame, const auto& range) {
    for (const int p : range) taken.take(cell, boxes.of(frame, p));
    if (!taken.planes().areNear(cell)) return;
    for (const int p : range)
      taken.planes().template forEachOf<1>(cell, {boxes.of(frame, p)},
                                           [&](const Index<D>& at, const auto& images) { taken.take(at, images[0]); });
  });
}

/// Computes the fractions of cells and faces that bodies leave free.
template <int D>
void measureFreeSpace(const Patch& patch, const std::vector<mpm::solid::Material>&,
                      const std::vector<Boxes<D>>& materials, const FreeShares<D>& free) {
  TakenShares<D> taken(free, BoxImages<D>(patch.level()));
  for (const Boxes<D>& boxes : materials) takeBoxes<D>(patch.level(), boxes, taken);
  taken.settle();
  fillOutside<D>(patch.level(), free, leastFreeVolume);
}

/// Views of what one of several bodies leaves free.
template <int D>
struct FreeOfBody : FreeShares<D> {
  static FreeOfBody from(auto& take, bool endsAtPlane) {
    return {{take(computes(c::freeOfBody)), take(computes(c::coverageOfBody<D>)),
             take(when(endsAtPlane, computes(c::coverageOfBodyAtEnd<D>)))}};
  }
};

/// Computes the fraction of cells that one of several bodies leaves free, and what it covers of faces, at the start of
/// a step.
template <int D>
void measureBody(const Patch& patch, const mpm::solid::Material&, const Boxes<D>& boxes, const FreeOfBody<D>& free) {
  TakenShares<D> taken(free, BoxImages<D>(patch.level()));
  takeBoxes<D>(patch.level(), boxes, taken);
  taken.settle();
}

/// Views of what moves through the lower faces of cells in a step: the volume of bodies, and the mean of their
/// displacements, weighted by the volumes that boxes sweep.
template <int D>
struct SweptFaces {
  CellView<Vec<D>> volume, shift;

  static SweptFaces from(auto& take) { return {take(computes(c::swept<D>)), take(computes(c::sweptBy<D>))}; }
};

/// Sums over the boxes that move through faces.
template <int D>
class Sweeps {
 public:
  explicit Sweeps(const SweptFaces<D>& faces)
      : faces_(faces), weights_(static_cast<std::size_t>(faces.volume.box().size())), touched_(faces.volume.box()) {
    faces_.volume.fill(Vec<D>::Zero());
    faces_.shift.fill(Vec<D>::Constant(c::notSwept));
  }
  /// Adds the volume, in cells, that a box sweeps upwards through the lower faces of the surrounding cells while it
  /// moves from `before` to `after`. It is the mean over all sequences of moves along one axis each, so that no axis is
  /// preferred.
  void add(const Index<D>& origin, const ParticleBox<D>& before, const ParticleBox<D>& after);
  /// Divides the sums of displacements by those of their weights. Faces for which `isNeeded(cell)` is false count as
  /// not swept.
  template <class IsNeeded>
  void settle(IsNeeded&& isNeeded) const {
    touched_.forEachIn(touched_.box(), [&](const Index<D>& cell) {
      Vec<D>&volume = faces_.volume[cell], &shift = faces_.shift[cell];
      const Vec<D>& weight = weights_[offsetIn<D>(touched_.box(), cell)];
      const bool isKept = isNeeded(cell);
      if (!isKept) volume = Vec<D>::Zero();
      for (int a = 0; a < D; ++a) shift[a] = isKept && weight[a] > 0 ? shift[a] / weight[a] : c::notSwept;
    });
  }
  void settle() const {
    settle([](const Index<D>&) { return true; });
  }

 private:
  /// A number for each cell along one axis of those that a box reaches while it moves.
  using Along = std::array<double, 2 * (boxReach + 2)>;
  static_assert(std::tuple_size_v<Along> % 4 == 0);

  /// The mean section of a box across axis `a` while it moves along this axis: over all sequences of moves, in which
  /// the box has already moved along another axis, or not yet.
  static double meanSection(const Along (&old)[D], const Along (&fresh)[D], const Index<D>& k, int a) {
    if constexpr (D == 1) {
      return 1;
    } else if constexpr (D == 2) {
      const int b = 1 - a;
      return 0.5 * (old[b][k[b]] + fresh[b][k[b]]);
    } else {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const double was[] = {old[b][k[b]], old[c][k[c]]}, is[] = {fresh[b][k[b]], fresh[c][k[c]]};
      return (was[0] * was[1] + is[0] * is[1]) / 3 + (was[0] * is[1] + is[0] * was[1]) / 6;
    }
  }
  static void store(const Quad& numbers, double* to) { std::memcpy(to, &numbers, sizeof(numbers)); }
  /// The weights of the displacements through the faces of a cell. At the first call, all sums of the cell become 0.
  Vec<D>& weightsOf(const Index<D>& cell) {
    Vec<D>& weights = weights_[offsetIn<D>(touched_.box(), cell)];
    if (std::uint8_t& mark = *touched_.row(cell); !mark) {
      mark = 1;
      weights = faces_.shift[cell] = Vec<D>::Zero();
    }
    return weights;
  }

  const SweptFaces<D>& faces_;
  std::vector<Vec<D>, euler::Unfilled<Vec<D>>> weights_;
  CellMarks<D> touched_;  ///< the cells with sums
};

template <int D>
void Sweeps<D>::add(const Index<D>& origin, const ParticleBox<D>& before, const ParticleBox<D>& after) {
  if (before.middle == after.middle) return;
  Box reach{{}, Index3::filled(1)};  // the cells with parts of a box
  Along up[D], old[D], fresh[D];
  double most = 0;
  for (int d = 0; d < D; ++d) {
    const auto [least, greatest] = std::minmax(before.middle[d], after.middle[d]);
    const double half = 0.5 * std::max(before.edges[d], after.edges[d]);
    reach.lower[d] = static_cast<int>(std::floor(least - half));
    reach.upper[d] = static_cast<int>(std::floor(greatest + half)) + 1;
    for (int k = 0; k < reach.extent(d); k += 4) {
      const Quad faces = Quad{0, 1, 2, 3} + (reach.lower[d] + k);
      const Quad rise = after.lengthsAbove(d, faces) - before.lengthsAbove(d, faces);
      store(rise, &up[d][k]);
      store(before.lengthsIn(d, faces), &old[d][k]);
      store(after.lengthsIn(d, faces), &fresh[d][k]);
      for (int i = 0; i < 4; ++i) most = std::max(most, std::abs(rise[i]));
    }
  }
  if (most == 0) return;
  forEach<D>(cellsIn(faces_.volume, origin, reach), [&](const Index<D>& cell) {
    Index<D> k = cell - origin;
    for (int d = 0; d < D; ++d) k[d] -= reach.lower[d];
    Vec<D>& weights = weightsOf(cell);
    for (int a = 0; a < D; ++a) {
      if (up[a][k[a]] == 0) continue;
      const double volume = up[a][k[a]] * meanSection(old, fresh, k, a);
      faces_.volume[cell][a] += volume;
      faces_.shift[cell][a] += std::abs(volume) * (after.middle[a] - before.middle[a]);
      weights[a] += std::abs(volume);
    }
  });
}

/// The position of a particle, clamped to the region around its starting cell within which patches read particles. The
/// limits of the time step keep it closer.
template <int D>
Vec<D> withinReach(const Vec<D>& coordinates, const Vec<D>& edges) {
  const Vec<D> least = edges.array() - boxReach, most = boxReach + 1 - edges.array();
  return coordinates.cwiseMax(least).cwiseMin(most);
}

template <int D>
Move<D> MovedBoxes<D>::of(const mpm::CellFrame<D>& frame, int p) const {
  const ParticleBox<D> old = before.of(frame, p);
  ParticleBox<D> fresh = after.of(frame, p);
  fresh.middle = withinReach<D>(fresh.middle, old.edges.cwiseMax(fresh.edges));
  return {old, ParticleBox<D>{fresh.middle, old.edges}, fresh};
}

}  // namespace tushar::mpmice
