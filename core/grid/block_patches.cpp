#include "core/grid/block_patches.hpp"

#include <cstddef>

namespace tushar::grid {

namespace {

/// Divides the leaves into patches; remembers which leaves already belong to a patch.
class PatchMaker {
 public:
  PatchMaker(const BlockTree& tree, const Index3& blockCells, const Index3& most)
      : tree_(tree), blockCells_(blockCells), most_(most), hasPatch_(tree.leaves().size(), false) {}

  bool hasPatch(std::size_t place) const { return hasPatch_[place]; }

  /// Grows a patch from its first leaf; returns the box of its blocks.
  Box growFrom(const BlockId& leaf) {
    Box blocks{leaf.at, leaf.at + Index3::filled(1)};
    for (int axis = 0; axis < tree_.dimension(); ++axis)
      while (mayGrow(leaf.level, blocks, axis)) ++blocks.upper[axis];
    forEach<3>(blocks, [&](const Index3& at) { hasPatch_[placeOf({leaf.level, at})] = true; });
    return blocks;
  }

 private:
  std::size_t placeOf(const BlockId& leaf) const { return static_cast<std::size_t>(tree_.placeOf(leaf)); }

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
    const int place = tree_.placeIfLeaf(block);
    return place >= 0 && !hasPatch_[static_cast<std::size_t>(place)];
  }

  const BlockTree& tree_;
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
