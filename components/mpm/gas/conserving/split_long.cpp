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

/// Whether particles of a box of cells are longer than `longest` [m] along an axis.
template <int D>
bool anyLong(const Box& cells, const ParticleView<const Vec<D>>& edges, const Vec<D>& longest) {
  Lanes::Mask isLong{};
  forEachBatch<D>(cells, edges, [&](const Batch<D>& batch) {
    const LanesVec<D> size = load(edges, batch);
    for (int d = 0; d < D; ++d) isLong |= size[d] > longest[d];
  });
  return any(isLong);
}

/// Whether any particles in `edges.cells()` are longer than `longest` [m] along an axis. Those of the patch itself are
/// consecutive in memory.
template <int D>
bool anyLong(const Box& own, const ParticleView<const Vec<D>>& edges, const Vec<D>& longest, int owned) {
  Lanes::Mask isLong{};
  int p = 0;
  for (; p + Lanes::count <= owned; p += Lanes::count) {
    const auto size = unpack<D>(edges[p].data());
    for (std::size_t d = 0; d < D; ++d) isLong |= size[d] > longest[static_cast<int>(d)];
  }
  bool found = any(isLong);
  for (; p < owned; ++p) found = found || (edges[p].array() > longest.array()).any();
  Box around = edges.cells();
  for (int d = D - 1; d >= 0 && !found; --d) {  // the ghosts below and above the patch along d
    Box below = around, above = around;
    below.upper[d] = around.lower[d] = own.lower[d];
    above.lower[d] = around.upper[d] = own.upper[d];
    found = anyLong<D>(below, edges, longest) || anyLong<D>(above, edges, longest);
  }
  return found;
}

/// Appends the values of particles `first` to `last` - 1.
template <class T>
void append(const ParticleView<const T>& from, int first, int last, std::vector<T>& to) {
  to.insert(to.end(), &from[first], &from[last - 1] + 1);
}

/// Adds particles that are kept, from `first` up to but excluding `last`, whose cells and ids the maker already has.
template <int D>
void addKept(const OldBoxes<D>& old, int first, int last, const NewBoxes<D>& fresh) {
  if (first == last) return;
  append(old.x, first, last, fresh.x);
  append(old.edges, first, last, fresh.edges);
  append(old.mass, first, last, fresh.mass);
  append(old.velocity, first, last, fresh.velocity);
  append(old.modes, first, last, fresh.modes);
  append(old.internalEnergy, first, last, fresh.internalEnergy);
  append(old.affineEnergy, first, last, fresh.affineEnergy);
}

}  // namespace

template <int D>
void splitLong(const Patch& patch, double longestInCells, const OldBoxes<D>& old, ParticleMaker& maker,
               const NewBoxes<D>& fresh) {
  Vec<D> longest;
  for (int d = 0; d < D; ++d) longest[d] = longestInCells * patch.level().spacing(d);
  if (!anyLong<D>(patch.cells(), old.edges, longest, old.edges.owned())) return maker.keepAll();
  int kept = 0, next = 0;  // particles of the patch whose values wait to be added
  const auto addWaiting = [&](int begin) {
    addKept(old, kept, next, fresh);
    kept = next = begin;
  };
  forEach<D>(old.x.cells(), [&](const Index<D>& cell) {
    const bool isOwn = patch.cells().contains(cell);
    for (const int p : old.x.in(cell)) {
      const bool isLong = (old.edges[p].array() > longest.array()).any();
      if (isLong) {
        addWaiting(p + 1);
        addHalved(patch, longestInCells, old.at(p), 0, maker, fresh);
      } else if (isOwn) {
        if (p != next) addWaiting(p);
        next = p + 1;
        maker.add(cell, old.ids[p]);
      }
    }
  });
  addWaiting(0);
}

template void splitLong<1>(const Patch&, double, const OldBoxes<1>&, ParticleMaker&, const NewBoxes<1>&);
template void splitLong<2>(const Patch&, double, const OldBoxes<2>&, ParticleMaker&, const NewBoxes<2>&);
template void splitLong<3>(const Patch&, double, const OldBoxes<3>&, ParticleMaker&, const NewBoxes<3>&);

}  // namespace tushar::mpm::gas::conserving
