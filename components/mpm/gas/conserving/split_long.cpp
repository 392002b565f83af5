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
  if (side > 0) part.id = derivedId(whole.id, whole.x[axis]);
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

}  // namespace

template <int D>
void splitLong(const Patch& patch, double longestInCells, const OldBoxes<D>& old, ParticleMaker& maker,
               const NewBoxes<D>& fresh) {
  Lanes::Mask isLong{};
  forEachBatch<D>(old.x.cells(), old.x, [&](const Batch<D>& batch) {
    const LanesVec<D> edges = load(old.edges, batch);
    for (int d = 0; d < D; ++d) isLong |= edges[d] > longestInCells * patch.level().spacing(d);
  });
  if (all(~isLong)) return maker.keepAll();
  forEach<D>(old.x.cells(), [&](const Index<D>& cell) {
    for (const int p : old.x.in(cell)) addHalved(patch, longestInCells, old.at(p), 0, maker, fresh);
  });
}

template void splitLong<1>(const Patch&, double, const OldBoxes<1>&, ParticleMaker&, const NewBoxes<1>&);
template void splitLong<2>(const Patch&, double, const OldBoxes<2>&, ParticleMaker&, const NewBoxes<2>&);
template void splitLong<3>(const Patch&, double, const OldBoxes<3>&, ParticleMaker&, const NewBoxes<3>&);

}  // namespace tushar::mpm::gas::conserving
