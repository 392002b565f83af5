#include "core/grid/level.hpp"

#include <algorithm>

namespace tushar::grid {

Level::Level(const Domain& domain, Share share) : domain_(domain), share_(share) {
  chooseAxes();
  cutIntoPatches();
  partition_.emplace(*curve_, share_.ranks);
  makePatches();
}

RankOffsets Level::rankOffsets() const {
  RankOffsets offsets;
  for (int rank = 0; rank <= share_.ranks; ++rank) offsets.push_back(partition_->firstOf(rank));
  return offsets;
}

void Level::share(RankOffsets offsets) {
  partition_.emplace(*curve_, std::move(offsets));
  makePatches();
}

void Level::chooseAxes() {
  const auto isPlane = [&](int axis, int side) {
    const auto& conditions = domain_.boundaries.face(axis, side);
    const auto has = [&](BoundaryKind kind) {
      return std::any_of(conditions.begin(), conditions.end(),
                         [&](const BoundaryCondition& c) { return c.kind == kind; });
    };
    return has(BoundaryKind::symmetry) && !has(BoundaryKind::dirichlet);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = domain_.upper[axis] - domain_.lower[axis];
    const bool flat = extent == 0;
    const bool thin =
        domain_.resolution[axis] == 1 && ((isPlane(axis, 0) && isPlane(axis, 1)) || domain_.periodic[axis] != 0);
    if (!flat) cellVolume_ *= extent / domain_.resolution[axis];
    if (!flat && !thin) axes_.push_back(axis);
  }
  if (axes_.empty()) axes_.push_back(0);
  for (int d = 0; d < dimension(); ++d) is_periodic_ = is_periodic_ || isPeriodic(d);
}

void Level::cutIntoPatches() {
  cells_.upper = Index3::filled(1);
  MortonCurve::Cuts cuts{{{0, 1}, {0, 1}, {0, 1}}};
  for (int d = 0; d < dimension(); ++d) {
    const auto k = static_cast<std::size_t>(d);
    const int cells = domain_.resolution[axis(d)];
    const int parts = std::max(1, std::min(domain_.patches[axis(d)], cells));
    const double extent = domain_.upper[axis(d)] - domain_.lower[axis(d)];
    lower_[k] = domain_.lower[axis(d)];
    spacing_[k] = extent > 0 ? extent / cells : 1.0;
    inverse_spacing_[k] = 1.0 / spacing_[k];
    cells_.upper[d] = cells;
    cuts[k].clear();
    for (int part = 0; part <= parts; ++part)
      cuts[k].push_back(static_cast<int>(static_cast<long>(cells) * part / parts));
  }
  curve_.emplace(std::move(cuts));
}

void Level::makePatches() {
  patches_.clear();
  first_patch_ = partition_->firstOf(share_.rank);
  const int end = partition_->firstOf(share_.rank + 1);
  for (int id = first_patch_; id < end; ++id) patches_.push_back(patch(id));
  own_nodes_.clear();
  for (const Patch& patch : patches_) {
    Box own = patch.nodes();
    for (int d = 0; d < dimension(); ++d)
      if (sharesUpperFace(patch, d)) own.upper[d] = patch.cells().upper[d];
    own_nodes_.push_back(own);
  }
}

/// Not so for a patch that is no thicker than the layers of nodes beyond the grid at its other side: these mirror the
/// nodes of the face.
bool Level::sharesUpperFace(const Patch& patch, int kernelAxis) const {
  const int face = patch.cells().upper[kernelAxis];
  if (face == cells_.upper[kernelAxis]) return false;
  if (patch.isAtBoundary(kernelAxis, 0) && patch.cells().extent(kernelAxis) <= domain_.nodesBeyond) return false;
  Box behind = patch.cells();
  for (int d = 0; d < dimension(); ++d) ++behind.upper[d];
  behind.lower[kernelAxis] = face;
  const std::vector<Patch> others = patchesOverlapping(behind);
  return std::all_of(others.begin(), others.end(), [&](const Patch& other) { return isMine(other.id()); });
}

Box Level::nodes() const {
  Box nodes = nodesOfCells();
  for (int d = 0; d < dimension(); ++d) {
    if (isPeriodic(d)) continue;
    nodes.lower[d] -= domain_.nodesBeyond;
    nodes.upper[d] += domain_.nodesBeyond;
  }
  return nodes;
}

double Level::minSpacing() const {
  double least = spacing(0);
  for (int d = 1; d < dimension(); ++d) least = std::min(least, spacing(d));
  return least;
}

int Level::cellAlong(int kernelAxis, double x) const {
  const int cells = cells_.upper[kernelAxis];
  const double first = nodePosition(kernelAxis, 0), last = nodePosition(kernelAxis, cells);
  if (!(x >= first)) return -1;
  if (x >= last) return x == last ? cells - 1 : cells;
  int cell = std::min(static_cast<int>((x - first) / spacing(kernelAxis)), cells - 1);
  while (x < nodePosition(kernelAxis, cell)) --cell;
  while (cell + 1 < cells && x >= nodePosition(kernelAxis, cell + 1)) ++cell;
  return cell;
}

Box Level::cellsNear(const Vec3& lower, const Vec3& upper) const {
  Box near = cells_;
  for (int d = 0; d < dimension(); ++d) {
    near.lower[d] = std::max(0, cellAlong(d, lower[axis(d)]) - 1);
    near.upper[d] = std::min(cells_.upper[d], cellAlong(d, upper[axis(d)]) + 2);
  }
  return near;
}

std::string Level::axesLeftOut() const {
  std::string names;
  for (int axis = 0; axis < 3; ++axis)
    if (std::find(axes_.begin(), axes_.end(), axis) == axes_.end())
      names += (names.empty() ? "" : ", ") + std::string(1, "xyz"[axis]);
  return names;
}

Patch Level::patchOf(const Index3& cell) const {
  Index3 block;
  for (int d = 0; d < 3; ++d) block[d] = curve_->blockAlong(d, cell[d]);
  return {*this, curve_->placeOf(block), curve_->cellsAt(block)};
}

std::vector<Patch> Level::patchesOverlapping(const Box& cells) const {
  std::vector<Patch> found;
  const Box inside = cells.intersect(cells_);
  if (inside.empty()) return found;
  Box blocks;
  for (int d = 0; d < 3; ++d) {
    blocks.lower[d] = curve_->blockAlong(d, inside.lower[d]);
    blocks.upper[d] = curve_->blockAlong(d, inside.upper[d] - 1) + 1;
  }
  forEach<3>(blocks,
             [&](const Index3& block) { found.emplace_back(*this, curve_->placeOf(block), curve_->cellsAt(block)); });
  return found;
}

Box Level::clip(const Box& box, const Box& grid) const {
  Box clipped = box;
  for (int d = 0; d < 3; ++d) {
    if (d < dimension() && isPeriodic(d)) continue;
    clipped.lower[d] = std::max(box.lower[d], grid.lower[d]);
    clipped.upper[d] = std::min(box.upper[d], grid.upper[d]);
  }
  return clipped;
}

std::vector<Index3> Level::imagesOverlapping(const Box& cells) const {
  Box images{{}, Index3::filled(1)};
  for (int d = 0; d < dimension(); ++d) {
    if (!isPeriodic(d)) continue;
    const int count = cells_.upper[d];
    const auto imageOf = [&](int cell) { return cell >= 0 ? cell / count : -((count - 1 - cell) / count); };
    images.lower[d] = imageOf(cells.lower[d]);
    images.upper[d] = imageOf(cells.upper[d] - 1) + 1;
  }
  std::vector<Index3> shifts;
  forEach<3>(images, [&](Index3 image) {
    for (int d = 0; d < 3; ++d) image[d] *= cells_.upper[d];
    shifts.push_back(image);
  });
  return shifts;
}

const BoundaryCondition* Level::condition(int kernelAxis, int side, const BoundaryVariable& variable,
                                          int material) const {
  for (const BoundaryCondition& condition : domain_.boundaries.face(axis(kernelAxis), side))
    if (condition.variable == variable && (condition.material < 0 || condition.material == material)) return &condition;
  return nullptr;
}

}  // namespace tushar::grid
