#include "core/grid/block_tiling.hpp"

#include <algorithm>
#include <utility>

namespace tushar::grid {

Box blocksOver(const Box& cells, const Index3& blockCells) {
  Box blocks;
  for (int d = 0; d < 3; ++d) {
    blocks.lower[d] = cells.lower[d] / blockCells[d];
    blocks.upper[d] = (cells.upper[d] - 1) / blockCells[d] + 1;
  }
  return blocks;
}

namespace {

std::size_t placeInTable(const BlockTree& tree, const BlockId& block) {
  const int level = block.level, dimension = tree.dimension();
  const auto count = [&](int d) { return static_cast<std::size_t>(tree.roots()[d]) << (d < dimension ? level : 0); };
  const std::size_t x = block.at[0], y = block.at[1], z = block.at[2];
  return x + count(0) * (y + count(1) * z);
}

/// Lookup tables for those levels whose table has at most `mostPerLeaf` entries per leaf of the tree. A table is faster
/// than a search on the curve.
std::vector<std::vector<int>> tablesOf(const BlockTree& tree) {
  constexpr std::size_t mostPerLeaf = 8;
  std::vector<std::vector<int>> tables(static_cast<std::size_t>(tree.levels()));
  for (int level = 0; level < tree.levels(); ++level)
    if (const std::size_t all = Box{{}, tree.blocksOf(level)}.size(); all <= mostPerLeaf * tree.leaves().size())
      tables[static_cast<std::size_t>(level)].assign(all, -1);
  return tables;
}

}  // namespace

BlockTiling::BlockTiling(BlockTree tree, const Index3& blockCells, const Index3& most)
    : tree_(std::move(tree)),
      block_cells_(blockCells),
      patches_(patchesOf(tree_, blockCells, most)),
      patch_of_leaf_(tree_.leaves().size(), -1),
      patch_of_block_(tablesOf(tree_)) {
  cells_before_.push_back(0);
  for (std::size_t id = 0; id < patches_.size(); ++id) {
    const auto& [level, cells] = patches_[id];
    std::vector<int>& table = patch_of_block_[static_cast<std::size_t>(level)];
    forEach<3>(blocksOver(cells, block_cells_), [&, level = level](const Index3& at) {
      const BlockId block{level, at};
      patch_of_leaf_[tree_.placeOf(block)] = static_cast<int>(id);
      if (!table.empty()) table[placeInTable(tree_, block)] = static_cast<int>(id);
    });
    cells_before_.push_back(cells_before_.back() + cells.size());
  }
}

Tile BlockTiling::tile(int id) const {
  const auto& [level, cells] = patches_[id];
  return {id, level, cells};
}

int BlockTiling::patchOf(const BlockId& block) const {
  if (const std::vector<int>& table = patch_of_block_[static_cast<std::size_t>(block.level)]; !table.empty())
    return table[placeInTable(tree_, block)];
  const int place = tree_.placeIfLeaf(block);
  return place < 0 ? -1 : patch_of_leaf_[static_cast<std::size_t>(place)];
}

Tile BlockTiling::tileOf(int level, const Index3& cell) const {
  BlockId block{level, {}};
  for (int d = 0; d < 3; ++d) block.at[d] = cell[d] / block_cells_[d];
  const int id = patchOf(block);
  return id < 0 ? Tile{-1, level, {}} : tile(id);
}

std::vector<Tile> BlockTiling::overlapping(int level, const Box& cells) const {
  thread_local std::vector<int> ids;
  ids.clear();
  const Box blocks = blocksOver(cells, block_cells_);
  forEach<3>(blocks.rowStarts(), [&](Index3 at) {
    while (at[0] < blocks.upper[0]) {
      const int id = patchOf({level, at});
      if (id < 0) {
        ++at[0];
        continue;
      }
      // A patch is a box of blocks: the first row of blocks that it shares with `blocks` adds it, once.
      const Box ofPatch = blocksOver(patches_[static_cast<std::size_t>(id)].cells, block_cells_);
      if (at[1] == std::max(ofPatch.lower[1], blocks.lower[1]) && at[2] == std::max(ofPatch.lower[2], blocks.lower[2]))
        ids.push_back(id);
      at[0] = ofPatch.upper[0];
    }
  });
  std::sort(ids.begin(), ids.end());
  std::vector<Tile> found;
  found.reserve(ids.size());
  for (const int id : ids) found.push_back(tile(id));
  return found;
}

int BlockTiling::patchAfter(std::uint64_t cells) const {
  return static_cast<int>(std::lower_bound(cells_before_.begin(), cells_before_.end(), cells) - cells_before_.begin());
}

}  // namespace tushar::grid
