#include "core/grid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/grid/cut_tiling.hpp"

namespace tushar::grid {

namespace {

MortonCurve::Cuts cutsOf(const Level& level) {
  MortonCurve::Cuts cuts{{{0, 1}, {0, 1}, {0, 1}}};
  for (int d = 0; d < level.dimension(); ++d) {
    const int cells = level.cells().upper[d];
    const int parts = std::max(1, std::min(level.domain().patches[level.axis(d)], cells));
    std::vector<int>& along = cuts[d];
    along.clear();
    for (int part = 0; part <= parts; ++part)
      along.push_back(static_cast<int>(static_cast<long>(cells) * part / parts));
    if (level.boxes()) along = level.boxes()->allowedCuts(d, along);
  }
  return cuts;
}

/// The cells of a level that overlap a region; a side of the region that is within a thousandth of a cell width of a
/// node counts as lying on this node.
Box cellsWith(const Level& level, const FineRegion& region) {
  Box cells = level.cells();
  for (int d = 0; d < level.dimension(); ++d) {
    const auto nodesTo = [&](double x) { return (x - level.nodePosition(d, 0)) * level.inverseSpacing(d); };
    const double lower = std::floor(nodesTo(region.lower[level.axis(d)]) + 1e-3);
    const double upper = std::ceil(nodesTo(region.upper[level.axis(d)]) - 1e-3);
    cells.lower[d] = std::clamp(static_cast<int>(lower), 0, level.cells().upper[d]);
    cells.upper[d] = std::clamp(static_cast<int>(upper), 0, level.cells().upper[d]);
  }
  return cells;
}

}  // namespace

Grid::Grid(const Domain& domain, Share share) : share_(share) {
  const int levels = domain.refinement.levels;
  for (int number = 0; number < levels; ++number) levels_.emplace_back(domain, number, levels, this);
  if (levels > 1)
    cutIntoBlocks();
  else
    tiling_ = std::make_unique<CutTiling>(cutsOf(level()));
  partition_.emplace(*tiling_, share_.ranks);
  makePatches();
}

void Grid::cutIntoBlocks() {
  const Refinement& refinement = level().domain().refinement;
  Index3 blockCells = Index3::filled(1), roots = Index3::filled(1), periodic;
  for (int d = 0; d < dimension(); ++d) {
    blockCells[d] = refinement.blockCells[level().axis(d)];
    roots[d] = level().cells().extent(d) / blockCells[d];
    periodic[d] = level().isPeriodic(d);
  }
  for (const FineRegion& region : refinement.regions)
    for (int number = 0; number < region.level; ++number) {
      const Box cells = cellsWith(level(number), region);
      if (cells.empty()) continue;
      forEach<3>(blocksOver(cells, blockCells), [&](const Index3& block) { fixed_blocks_.push_back({number, block}); });
    }
  auto tiling =
      std::make_unique<BlockTiling>(BlockTree(dimension(), roots, periodic, levels()).regridded(fixed_blocks_, {}),
                                    blockCells, mostCellsOfPatch(blockCells));
  blocks_ = tiling.get();
  tiling_ = std::move(tiling);
}

/// Largest number of cells of a patch along each axis: large enough that ghosts cost little, small enough to fit into
/// the cache and to share among threads.
Index3 Grid::mostCellsOfPatch(const Index3& blockCells) const {
  const auto& wanted = level().domain().refinement.blocksPerPatch;
  Index3 most = Index3::filled(1);
  for (int d = 0; d < dimension(); ++d) {
    const int cells = dimension() == 1 ? 256 : dimension() == 2 ? 64 : 32;
    most[d] = blockCells[d] * (wanted ? (*wanted)[level().axis(d)] : std::max(1, cells / blockCells[d]));
  }
  return most;
}

std::unique_ptr<BlockTiling> Grid::cut(BlockTree tree) const {
  return std::make_unique<BlockTiling>(std::move(tree), blockCells(), mostCellsOfPatch(blockCells()));
}

std::unique_ptr<Tiling> Grid::refine(std::unique_ptr<BlockTiling> tiling, RankOffsets shares) {
  blocks_ = tiling.get();
  std::unique_ptr<Tiling> before = replace(std::move(tiling), std::move(shares));
  findNewCells(*before);
  return before;
}

std::unique_ptr<Tiling> Grid::recut(std::unique_ptr<Tiling> tiling, RankOffsets shares) {
  return replace(std::move(tiling), std::move(shares));
}

std::unique_ptr<Tiling> Grid::replace(std::unique_ptr<Tiling> tiling, RankOffsets shares) {
  partition_.reset();
  std::unique_ptr<Tiling> before = std::exchange(tiling_, std::move(tiling));
  if (shares.empty())
    partition_.emplace(*tiling_, share_.ranks);
  else
    partition_.emplace(*tiling_, std::move(shares));
  makePatches();
  return before;
}

void Grid::findNewCells(const Tiling& before) {
  for (std::size_t place = 0; place < patches_.size(); ++place) {
    const Patch& patch = patches_[place];
    if (patch.level().number() == 0) continue;
    for (const Tile& coarser : before.overlapping(patch.level().number() - 1, patch.cells().coarsened(dimension())))
      new_cells_[place].push_back(coarser.cells.refined(dimension()).intersect(patch.cells()));
  }
}

RankOffsets Grid::rankOffsets() const {
  RankOffsets offsets;
  for (int rank = 0; rank <= share_.ranks; ++rank) offsets.push_back(partition_->firstOf(rank));
  return offsets;
}

void Grid::share(RankOffsets offsets) {
  partition_.emplace(*tiling_, std::move(offsets));
  makePatches();
}

void Grid::makePatches() {
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
  new_cells_.assign(patches_.size(), {});
  rims_.clear();
  for (const Patch& patch : patches_)
    if (levels() > 1) rims_.push_back(rimsOf(*this, patch));
}

/// Whether the patch beyond the upper face of `patch` owns the nodes of this face. This is not so if `patch` is no
/// thicker than the layers of nodes outside the grid at its lower side, because those nodes mirror the nodes of the
/// face.
bool Grid::sharesUpperFace(const Patch& patch, int kernelAxis) const {
  const Level& level = patch.level();
  const int face = patch.cells().upper[kernelAxis];
  if (face == level.cells().upper[kernelAxis]) return false;
  if (patch.isAtBoundary(kernelAxis, 0) && patch.cells().extent(kernelAxis) <= level.domain().nodesBeyond) return false;
  Box behind = patch.cells();
  for (int d = 0; d < dimension(); ++d) ++behind.upper[d];
  behind.lower[kernelAxis] = face;
  const std::vector<Patch> others = patchesOverlapping(behind, level.number());
  std::size_t covered = 0;  // all of it, except cells of other levels
  for (const Patch& other : others) covered += other.cells().intersect(behind).size();
  return covered == behind.intersect(level.cells()).size() &&
         std::all_of(others.begin(), others.end(), [&](const Patch& other) { return isMine(other.id()); });
}

bool Grid::isFinest(const Box& cells) const {
  if (levels() == 1) return true;
  const Box near = finest().clipCells(cells);
  std::size_t covered = 0;
  forEachOverlapping(finest(), near, [&](const Patch& patch, const Index3& shift) {
    covered += patch.cells().shifted(shift).intersect(near).size();
  });
  return covered == near.size();
}

std::vector<Patch> Grid::patchesOverlapping(const Box& cells, int level) const {
  std::vector<Patch> found;
  const Box inside = cells.intersect(this->level(level).cells());
  if (inside.empty()) return found;
  const std::vector<Tile> tiles = tiling_->overlapping(level, inside);
  found.reserve(tiles.size());
  for (const Tile& tile : tiles) found.push_back(patchOf(tile));
  return found;
}

}  // namespace tushar::grid
