#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "core/grid/block_tiling.hpp"
#include "core/grid/level.hpp"
#include "core/grid/partition.hpp"
#include "core/grid/patch.hpp"
#include "core/grid/rim.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// The grid of a run, with its levels and patches, as one rank sees it.
///
/// Patches are numbered along Morton's curve, and a rank owns consecutive ones. On a single level, only these are
/// stored and other patches are constructed on demand, so that a rank needs memory only for its own patches even if the
/// grid has a million.
class Grid {
 public:
  /// A grid of one level is divided into the patches that `domain` specifies; along an axis with fewer cells than
  /// requested patches, each cell gets a patch. A grid of several levels is divided into blocks, those in the regions
  /// of `domain.refinement` are refined, and patches are boxes of blocks.
  explicit Grid(const Domain& domain, Share share = {});
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  /// The level with this index; 0 is the coarsest.
  const Level& level(int number = 0) const { return levels_[number]; }
  int levels() const { return static_cast<int>(levels_.size()); }
  const Level& finest() const { return levels_.back(); }
  bool isFinest(const Patch& patch) const { return &patch.level() == &finest(); }
  /// Whether all cells of a box on the finest level exist, that is, none is part of a coarser cell; cells outside the
  /// grid and its periodic images are ignored.
  bool isFinest(const Box& cells) const;
  int dimension() const { return level().dimension(); }

  /// The tree of refined blocks; only if there are several levels.
  const BlockTree& tree() const { return blocks_->tree(); }
  /// Number of cells of a block along each kernel axis.
  const Index3& blockCells() const { return blocks_->blockCells(); }
  const BlockTiling& tiling() const { return *blocks_; }
  /// The patches of all ranks.
  const Tiling& patchTiling() const { return *tiling_; }
  /// Blocks that are always refined because they lie in regions given by the scene; may contain duplicates.
  const std::vector<BlockId>& fixedBlocks() const { return fixed_blocks_; }
  /// Divides another tree into patches.
  std::unique_ptr<BlockTiling> cut(BlockTree tree) const;
  /// Replaces the patches; returns the previous ones. Without given shares, ranks get as equal numbers of cells as the
  /// patches allow. The caller moves the values of the patches: see tasks::regrid.
  std::unique_ptr<Tiling> refine(std::unique_ptr<BlockTiling> tiling, RankOffsets shares = {});
  /// Replaces the patches of a grid of one level by patches whose cuts have moved; returns the previous ones. `shares`
  /// and the values of the patches are as in refine().
  std::unique_ptr<Tiling> recut(std::unique_ptr<Tiling> tiling, RankOffsets shares = {});
  /// Cells of a patch of this rank that were part of coarser cells before the latest call of refine().
  const std::vector<Box>& newCells(int patch) const { return new_cells_[patch - first_patch_]; }
  /// The patches of this rank, in the order of their indices.
  const std::vector<Patch>& patches() const { return patches_; }
  /// Number of cells of all patches on all ranks.
  std::uint64_t cellCount() const { return tiling_->cells(); }
  /// Number of patches on all ranks.
  int patchCount() const { return tiling_->count(); }
  /// The patch with index `id`, on any rank.
  Patch patch(int id) const { return patchOf(tiling_->tile(id)); }
  /// The index of the first patch of this rank.
  int firstPatch() const { return first_patch_; }
  /// Whether a patch belongs to this rank.
  bool isMine(int patch) const {
    return patch >= first_patch_ && patch < first_patch_ + static_cast<int>(patches_.size());
  }
  /// The rank to which a patch belongs.
  int ownerOf(int patch) const { return isMine(patch) ? share_.rank : partition_->ownerOf(patch); }
  const Share& share() const { return share_; }
  /// The nodes that a patch of this rank owns: all its nodes, except those on an upper face if all patches behind this
  /// face are on this rank, because then those patches own them. So each node has exactly one owner among the patches
  /// of this rank.
  const Box& ownNodes(int patch) const { return own_nodes_[patch - first_patch_]; }
  /// The distribution of patches over ranks.
  RankOffsets rankOffsets() const;
  /// Redistributes the patches over the ranks. The caller must move their values: see tasks::migratePatches.
  void share(RankOffsets offsets);

  /// The patch that contains a cell of a level; the cell must be neither refined nor part of a coarser cell.
  Patch patchOf(const Index3& cell, int level) const { return patchOf(tiling_->tileOf(level, cell)); }
  /// The patches of a level that contain cells of a box, in the order of their cells.
  std::vector<Patch> patchesOverlapping(const Box& cells, int level) const;
  /// Calls `visit(patch, shift)` for each patch of a level, and each of its periodic images, that contains cells of a
  /// box; the cells of an image are those of the patch, shifted.
  template <class Visit>
  void forEachOverlapping(const Level& level, const Box& cells, Visit&& visit) const {
    for (const Index3& shift : level.imagesOverlapping(cells))
      for (const Patch& patch : patchesOverlapping(cells.shifted(Index3{} - shift), level.number()))
        visit(patch, shift);
  }
  /// The faces at which a patch of this rank meets other levels.
  const std::vector<RimPiece>& rims(int patch) const { return rims_[patch - first_patch_]; }

 private:
  void cutIntoBlocks();
  Index3 mostCellsOfPatch(const Index3& blockCells) const;
  Patch patchOf(const Tile& tile) const { return {level(tile.level), tile.id, tile.cells}; }
  std::unique_ptr<Tiling> replace(std::unique_ptr<Tiling> tiling, RankOffsets shares);
  void makePatches();
  void findNewCells(const Tiling& before);
  bool sharesUpperFace(const Patch& patch, int kernelAxis) const;

  std::deque<Level> levels_;
  Share share_;
  std::unique_ptr<Tiling> tiling_;
  const BlockTiling* blocks_ = nullptr;  ///< the tiling if there are several levels, otherwise null
  std::vector<BlockId> fixed_blocks_;
  std::optional<Partition> partition_;
  int first_patch_ = 0;
  std::vector<Patch> patches_;
  std::vector<Box> own_nodes_;               ///< index: patch on this rank
  std::vector<std::vector<RimPiece>> rims_;  ///< index: patch on this rank; empty if there is only one level
  std::vector<std::vector<Box>> new_cells_;  ///< index: patch on this rank
};

}  // namespace tushar::grid
