#include "components/mpm/gas/conserving/redistribute.hpp"
#include "components/mpm/particles/ids.hpp"

namespace tushar::mpm::gas::conserving {

namespace {

/// A particle on its way to being halved, axis by axis.
template <int D>
struct Piece {
  ParticleId id;
  Vec<D> x, edges;
  double mass;
  Vec<D> velocity;
  Modes<D> modes;
  double internalEnergy, affineEnergy;
};

template <int D>
Piece<D> pieceOf(const Boxes<D>& boxes, int p) {
  return {boxes.ids[p],      boxes.x[p],     boxes.edges[p],          boxes.mass[p],
          boxes.velocity[p], boxes.modes[p], boxes.internalEnergy[p], boxes.affineEnergy[p]};
}

/// Half of a piece along an axis, on the lower (-1) or upper (1) side.
template <int D>
Piece<D> half(const Piece<D>& whole, int axis, int side) {
  Piece<D> part = whole;
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

template <int D>
void add(const Patch& patch, const Piece<D>& piece, NewBoxes<D>& fresh) {
  const Level& level = patch.level();
  const Index<D> cell = level.cellOf<D>(piece.x);
  if (!patch.cells().contains(cell)) return;
  fresh.maker.add(cell, piece.id);
  fresh.x.push_back(piece.x);
  fresh.edges.push_back(piece.edges);
  fresh.mass.push_back(piece.mass);
  fresh.velocity.push_back(piece.velocity);
  fresh.modes.push_back(piece.modes);
  fresh.internalEnergy.push_back(piece.internalEnergy);
  fresh.affineEnergy.push_back(piece.affineEnergy);
}

/// Adds a piece, halved along each axis from `axis` on where it is too long.
template <int D>
void addHalved(const Patch& patch, double longestInCells, const Piece<D>& piece, int axis, NewBoxes<D>& fresh) {
  while (axis < D && !(piece.edges[axis] > longestInCells * patch.level().spacing(axis))) ++axis;
  if (axis == D) return add(patch, piece, fresh);
  addHalved(patch, longestInCells, half(piece, axis, -1), axis, fresh);
  addHalved(patch, longestInCells, half(piece, axis, 1), axis, fresh);
}

}  // namespace

template <int D>
void splitLong(const Patch& patch, double longestInCells, const Boxes<D>& boxes, NewBoxes<D> fresh) {
  Vec<D> longest;
  for (int d = 0; d < D; ++d) longest[d] = longestInCells * patch.level().spacing(d);
  bool any = false;
  forEach<D>(boxes.x.cells(), [&](const Index<D>& cell) {
    for (const int p : boxes.x.in(cell)) any = any || (boxes.edges[p].array() > longest.array()).any();
  });
  if (!any) return fresh.maker.keepAll();
  forEach<D>(boxes.x.cells(), [&](const Index<D>& cell) {
    for (const int p : boxes.x.in(cell)) addHalved(patch, longestInCells, pieceOf(boxes, p), 0, fresh);
  });
}

template void splitLong<1>(const Patch&, double, const Boxes<1>&, NewBoxes<1>);
template void splitLong<2>(const Patch&, double, const Boxes<2>&, NewBoxes<2>);
template void splitLong<3>(const Patch&, double, const Boxes<3>&, NewBoxes<3>);

}  // namespace tushar::mpm::gas::conserving
