#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/particles/ids.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// The lower (-1) or upper (1) half of a piece along an axis.
template <int D>
GasBox<D> half(const GasBox<D>& whole, int axis, int side) {
  GasBox<D> part = whole;
  const double offset = 0.25 * side * whole.edges[axis];
  const Vec<D> slip = offset * whole.modes.col(gradientColumn(axis));
  const double spare = whole.affineEnergy - 0.5 * slip.squaredNorm();
  if (side > 0) part.id = derivedId(whole.id, whole.x[axis], axis);
  part.x[axis] += offset;
  part.edges[axis] *= 0.5;
  part.mass *= 0.5;
  part.velocity += slip;
  part.internalEnergy += std::min(spare, 0.0);
  part.affineEnergy = std::max(spare, 0.0);
  return part;
}

/// Adds a piece, halved along each axis, starting at `axis`, along which it is too long.
template <int D>
void addHalved(const Patch& patch, double longestInCells, const GasBox<D>& piece, int axis, ParticleMaker& maker,
               const NewBoxes<D>& fresh) {
  const Level& level = patch.level();
  while (axis < D && !(piece.edges[axis] > longestInCells * level.spacing(axis))) ++axis;
  if (axis == D) {
    const Index<D> cell = level.cellOf<D>(piece.x);
    if (patch.cells().contains(cell)) fresh.add(maker, cell, piece);
    return;
  }
  addHalved(patch, longestInCells, half(piece, axis, -1), axis, maker, fresh);
  addHalved(patch, longestInCells, half(piece, axis, 1), axis, maker, fresh);
}

/// Calls `visit(p)` for the particles of the patch, of indices below `owned`, that are longer than `longest` [m] along
/// an axis. They are consecutive in memory.
template <int D, class Visit>
void forEachLong(const ParticleView<const Vec<D>>& edges, const Vec<D>& longest, int owned, Visit&& visit) {
  const auto visitOne = [&](int p) {
    if ((edges[p].array() > longest.array()).any()) visit(p);
  };
  int p = 0;
  for (; p + Lanes::count <= owned; p += Lanes::count) {
    const auto size = unpack<D>(edges[p].data());
    Lanes::Mask isLong{};
    for (std::size_t d = 0; d < D; ++d) isLong |= size[d] > longest[static_cast<int>(d)];
    if (any(isLong))  // rarely
      for (int lane = 0; lane < Lanes::count; ++lane) visitOne(p + lane);
  }
  for (; p < owned; ++p) visitOne(p);
}

/// Calls `visit(p)` for the ghosts around the cells `own` of a patch that are longer than `longest` [m] along an axis.
template <int D, class Visit>
void forEachLongGhost(const Box& own, const ParticleView<const Vec<D>>& edges, const Vec<D>& longest, Visit&& visit) {
  const auto visitAll = [&](const Box& cells) {
    forEachBatch<D>(cells, edges, [&](const Batch<D>& batch) {
      const LanesVec<D> size = load(edges, batch);
      Lanes::Mask isLong{};
      for (int d = 0; d < D; ++d) isLong |= size[d] > longest[d];
      if (batch.holds(~isLong)) return;
      for (int lane = 0; lane < Lanes::count; ++lane)
        if (batch.used[lane] != 0 && isLong[lane] != 0) visit(batch.place[lane]);
    });
  };
  Box around = edges.cells();
  for (int d = D - 1; d >= 0; --d) {  // the ghosts below and above the patch along d
    Box below = around, above = around;
    below.upper[d] = around.lower[d] = own.lower[d];
    above.lower[d] = around.upper[d] = own.upper[d];
    visitAll(below);
    visitAll(above);
  }
}

}  // namespace

template <int D>
void splitLong(const Patch& patch, double longestInCells, const OldBoxes<D>& old, ParticleMaker& maker,
               const NewBoxes<D>& fresh) {
  Vec<D> longest;
  for (int d = 0; d < D; ++d) longest[d] = longestInCells * patch.level().spacing(d);
  const auto halve = [&](int p) { addHalved(patch, longestInCells, old.at(p), 0, maker, fresh); };
  bool splits = false;
  int next = 0;  // the first particle that is not kept yet
  forEachLong<D>(old.edges, longest, old.edges.owned(), [&](int p) {
    splits = true;
    maker.keep(next, p);
    next = p + 1;
    halve(p);
  });
  forEachLongGhost<D>(patch.cells(), old.edges, longest, [&](int p) {
    splits = true;
    halve(p);
  });
  splits ? maker.keep(next, old.edges.owned()) : maker.keepAll();
}

template void splitLong<1>(const Patch&, double, const OldBoxes<1>&, ParticleMaker&, const NewBoxes<1>&);
template void splitLong<2>(const Patch&, double, const OldBoxes<2>&, ParticleMaker&, const NewBoxes<2>&);
template void splitLong<3>(const Patch&, double, const OldBoxes<3>&, ParticleMaker&, const NewBoxes<3>&);

}  // namespace tushar::mpm::gas::conserving
