#include "core/grid/block_patches.hpp"

#include <cstddef>
#include <vector>

namespace tushar::grid {

namespace {

/// The positions of leaves on the curve. For levels with not many more blocks than leaves, a table answers faster than
/// a search on the curve.
class LeafPlaces {
 public:
  explicit LeafPlaces(const BlockTree& tree) : tree_(tree), tables_(static_cast<std::size_t>(tree.levels())) {
    constexpr std::size_t mostPerLeaf = 8;
    for (int level = 0; level < tree.levels(); ++level) {
      const Box all{{}, tree.blocksOf(level)};
      if (all.size() > mostPerLeaf * tree.leaves().size()) continue;
      tables_[static_cast<std::size_t>(level)] = {all, std::vector<int>(all.size(), -1)};
    }
    for (std::size_t place = 0; place < tree.leaves().size(); ++place) {
      const BlockId& leaf = tree.leaves()[place];
      Table& table = tables_[static_cast<std::size_t>(leaf.level)];
      if (!table.places.empty()) table.places[table.blocks.offset(leaf.at)] = static_cast<int>(place);
    }
  }

  /// The position of a block of the grid; -1 if it is not a leaf.
  int of(const BlockId& block) const {
    const Table& table = tables_[static_cast<std::size_t>(block.level)];
    return table.places.empty() ? tree_.placeIfLeaf(block) : table.places[table.blocks.offset(block.at)];
  }

 private:
  struct Table {
    Box blocks;               ///< all blocks of the level
    std::vector<int> places;  ///< x fastest; empty if there is no table
  };
  const BlockTree& tree_;
  std::vector<Table> tables_;  ///< index: level
};

/// Divides the leaves into patches; remembers which leaves already belong to a patch.
class PatchMaker {
 public:
  PatchMaker(const BlockTree& tree, const Index3& blockCells, const Index3& most)
      : tree_(tree), places_(tree), blockCells_(blockCells), most_(most), hasPatch_(tree.leaves().size(), false) {}

  bool hasPatch(std::size_t place) const { return hasPatch_[place]; }

  /// Grows a patch from its first leaf; returns the box of its blocks.
  Box growFrom(const BlockId& leaf) {
    Box blocks{leaf.at, leaf.at + Index3::filled(1)};
    for (int axis = 0; axis < tree_.dimension(); ++axis)
      while (mayGrow(leaf.level, blocks, axis)) ++blocks.upper[axis];
    forEach<3>(blocks, [&](const Index3& at) {
      hasPatch_[static_cast<std::size_t>(places_.of({leaf.level, at}))] = true;
    });
    return blocks;
  }

 private:
  bool mayGrow(int level, const Box& blocks, int axis) const {
    if ((blocks.extent(axis) + 1) * blockCells_[axis] > most_[axis]) return false;
    if (blocks.upper[axis] >= tree_.blocksOf(level)[axis]) return false;
    Box layer = blocks;
    layer.lower[axis] = blocks.upper[axis];
    layer.upper[axis] = blocks.upper[axis] + 1;
    bool free = true;
    forEach<3>(layer, [&](const Index3& at) { free = free && isFreeLeaf({level, at}); });
    return free;
  }

  bool isFreeLeaf(const BlockId& block) const {
    const int place = places_.of(block);
    return place >= 0 && !hasPatch_[static_cast<std::size_t>(place)];
  }

  const BlockTree& tree_;
  LeafPlaces places_;
  Index3 blockCells_, most_;
  std::vector<bool> hasPatch_;  ///< index: position of the leaf on the curve
};

}  // namespace

Box cellsOf(const BlockId& block, const Index3& blockCells, int dimension) {
  Box cells{{}, Index3::filled(1)};
  for (int d = 0; d < dimension; ++d) {
    cells.lower[d] = block.at[d] * blockCells[d];
    cells.upper[d] = cells.lower[d] + blockCells[d];
  }
  return cells;
}

std::vector<PatchBox> patchesOf(const BlockTree& tree, const Index3& blockCells, const Index3& most) {
  std::vector<PatchBox> patches;
  PatchMaker maker(tree, blockCells, most);
  for (std::size_t place = 0; place < tree.leaves().size(); ++place) {
    if (maker.hasPatch(place)) continue;
    const BlockId& leaf = tree.leaves()[place];
    const Box blocks = maker.growFrom(leaf);
    const Box first = cellsOf(leaf, blockCells, tree.dimension());
    const Box last = cellsOf({leaf.level, blocks.upper - Index3::filled(1)}, blockCells, tree.dimension());
    patches.push_back({leaf.level, {first.lower, last.upper}});
  }
  return patches;
}

}  // namespace tushar::grid
