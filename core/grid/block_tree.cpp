#include "core/grid/block_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "core/grid/box.hpp"

namespace tushar::grid {

namespace {

constexpr int mostPlaceBits = 20;  ///< number of bits of a block's coordinate on the finest level
constexpr int keyLevelBits = 4;
constexpr int mostTreeLevels = 1 << keyLevelBits;
constexpr std::uint64_t keyLevelMask = mostTreeLevels - 1;

/// Spreads the lowest 21 bits, so that each is followed by two zero bits.
constexpr std::uint64_t spreadBits(std::uint64_t bits) {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// Extracts every third bit, starting with the lowest: the inverse of spreadBits.
constexpr int gatherBits(std::uint64_t bits) {
  bits &= 0x1249249249249249;
  bits = (bits | bits >> 2) & 0x10c30c30c30c30c3;
  bits = (bits | bits >> 4) & 0x100f00f00f00f00f;
  bits = (bits | bits >> 8) & 0x001f0000ff0000ff;
  bits = (bits | bits >> 16) & 0x001f00000000ffff;
  return static_cast<int>((bits | bits >> 32) & 0x1fffff);
}

BlockId parentOf(const BlockId& block) {
  return {block.level - 1, {{block.at[0] >> 1, block.at[1] >> 1, block.at[2] >> 1}}};
}

/// Calls `visit(offset)` for all offsets 0 or 1 along each of the first `dimension` axes, in the order of the curve.
template <class Visit>
void forEachCorner(int dimension, Visit&& visit) {
  for (int corner = 0; corner < 1 << dimension; ++corner) visit(Index3{{corner & 1, corner >> 1 & 1, corner >> 2 & 1}});
}

void checkTree(int dimension, const Index3& roots, int levels) {
  if (dimension < 1 || dimension > 3)
    throw std::invalid_argument(fmt::format("a tree of blocks must have 1 to 3 dimensions, not {}", dimension));
  if (levels < 1 || levels > mostTreeLevels)
    throw std::invalid_argument(
        fmt::format("a tree of blocks must have 1 to {} levels, not {}", mostTreeLevels, levels));
  for (int d = 0; d < 3; ++d) {
    const int most = d < dimension ? 1 << mostPlaceBits >> (levels - 1) : 1;
    if (roots[d] < 1 || roots[d] > most)
      throw std::invalid_argument(
          fmt::format("a grid of {} levels must have 1 to {} blocks of the coarsest level along the {} axis, not {}",
                      levels, most, "xyz"[d], roots[d]));
  }
}

}  // namespace

std::strong_ordering operator<=>(const BlockId& a, const BlockId& b) {
  const int finer = std::max(a.level, b.level);
  std::strong_ordering order = a.level <=> b.level;
  // The highest bit in which the places differ along any axis decides; if several axes differ in this bit, the last
  // one.
  int highest = 0;
  for (int d = 0; d < 3; ++d) {
    const std::int64_t first = std::int64_t{a.at[d]} << (finer - a.level);
    const std::int64_t second = std::int64_t{b.at[d]} << (finer - b.level);
    const auto bit = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(first ^ second)));
    if (bit == 0 || bit < highest) continue;
    highest = bit;
    order = first <=> second;
  }
  return order;
}

BlockTree::BlockTree(int dimension, const Index3& roots, const Index3& periodic, int levels)
    : dimension_(dimension), roots_(roots), levels_(levels) {
  checkTree(dimension, roots, levels);
  for (int d = 0; d < dimension; ++d) periodic_[d] = periodic[d] != 0;
  setLeaves(std::vector<Keys>(static_cast<std::size_t>(levels)));
}

Index3 BlockTree::blocksOf(int level) const {
  Index3 blocks = roots_;
  for (int d = 0; d < dimension_; ++d) blocks[d] <<= level;
  return blocks;
}

std::uint64_t BlockTree::keyOf(const BlockId& block) const {
  std::uint64_t key = 0;
  for (int d = 0; d < dimension_; ++d)
    key |= spreadBits(static_cast<std::uint64_t>(block.at[d]) << (levels_ - 1 - block.level)) << d;
  return key << keyLevelBits | static_cast<std::uint64_t>(block.level);
}

BlockId BlockTree::blockOf(std::uint64_t key) const {
  BlockId block{static_cast<int>(key & keyLevelMask), {}};
  for (int d = 0; d < dimension_; ++d)
    block.at[d] = gatherBits(key >> (keyLevelBits + d)) >> (levels_ - 1 - block.level);
  return block;
}

std::optional<BlockId> BlockTree::inside(const BlockId& block) const {
  if (block.level < 0) return std::nullopt;
  BlockId found = block;
  const Index3 blocks = blocksOf(block.level);
  for (int d = 0; d < 3; ++d) {
    if (periodic_[d]) found.at[d] = (block.at[d] % blocks[d] + blocks[d]) % blocks[d];
    if (found.at[d] < 0 || found.at[d] >= blocks[d]) return std::nullopt;
  }
  return found;
}

int BlockTree::levelAt(const BlockId& block) const {
  std::optional<BlockId> place = inside(block);
  if (!place) return -1;
  while (place->level >= levels_) place = parentOf(*place);
  // The last leaf that does not come after the block's lower corner on the curve contains this corner.
  const auto after = std::upper_bound(keys_.begin(), keys_.end(), keyOf(*place) | keyLevelMask);
  return std::min(static_cast<int>(*(after - 1) & keyLevelMask), block.level + 1);
}

int BlockTree::placeOf(const BlockId& leaf) const {
  return static_cast<int>(std::lower_bound(keys_.begin(), keys_.end(), keyOf(leaf)) - keys_.begin());
}

int BlockTree::placeIfLeaf(const BlockId& block) const {
  const std::size_t place = static_cast<std::size_t>(placeOf(block));
  return place < leaves_.size() && leaves_[place] == block ? static_cast<int>(place) : -1;
}

BlockTree BlockTree::regridded(const std::vector<BlockId>& wanted, const std::vector<BlockId>& kept) const {
  std::vector<Keys> refined(levels_);
  const auto add = [&](const BlockId& block) {
    if (block.level >= levels_ - 1) return;
    if (const std::optional<BlockId> known = inside(block)) refined[known->level].push_back(keyOf(*known));
  };
  for (const BlockId& block : wanted) add(block);
  for (const BlockId& block : kept)
    if (isRefined(block)) add(block);
  return withRefined(std::move(refined));
}

BlockTree BlockTree::withRefined(std::vector<Keys> refined) const {
  for (std::size_t level = refined.size(); level-- > 0;) {
    Keys& keys = refined[level];
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    if (level > 0)
      for (const std::uint64_t key : keys) addRefinedAround(blockOf(key), refined[level - 1]);
  }
  BlockTree tree = *this;
  tree.setLeaves(refined);
  return tree;
}

void BlockTree::addRefinedAround(const BlockId& block, Keys& coarser) const {
  // The parents of all blocks around this one: along each axis, its own parent, and the neighbour of that on the side
  // where the block lies within its parent.
  const BlockId parent = parentOf(block);
  forEachCorner(dimension_, [&](const Index3& corner) {
    BlockId around = parent;
    for (int d = 0; d < dimension_; ++d)
      if (corner[d] == 1) around.at[d] += block.at[d] % 2 == 1 ? 1 : -1;
    if (const std::optional<BlockId> known = inside(around)) coarser.push_back(keyOf(*known));
  });
}

void BlockTree::setLeaves(const std::vector<Keys>& refined) {
  keys_.clear();
  const auto addUnlessRefined = [&](const BlockId& block) {
    const Keys& finer = refined[block.level];
    const std::uint64_t key = keyOf(block);
    if (!std::binary_search(finer.begin(), finer.end(), key)) keys_.push_back(key);
  };
  forEach<3>({{}, roots_}, [&](const Index3& root) { addUnlessRefined({0, root}); });
  for (const Keys& keys : refined)
    for (const std::uint64_t key : keys)
      forEachCorner(dimension_, [&](const Index3& corner) {
        const BlockId block = blockOf(key);
        addUnlessRefined({block.level + 1, block.at + block.at + corner});
      });
  std::sort(keys_.begin(), keys_.end());
  leaves_.clear();
  for (const std::uint64_t key : keys_) leaves_.push_back(blockOf(key));
}

BlockTree BlockTree::fromKeys(int dimension, const Index3& roots, const Index3& periodic, int levels,
                              const std::vector<std::uint64_t>& keys) {
  const BlockTree unrefined(dimension, roots, periodic, levels);
  std::vector<Keys> refined(levels);
  for (const std::uint64_t key : keys) {
    const std::size_t level = key & keyLevelMask;
    if (level == 0 || level >= refined.size()) continue;
    if (const std::optional<BlockId> parent = unrefined.inside(parentOf(unrefined.blockOf(key))))
      refined[level - 1].push_back(unrefined.keyOf(*parent));
  }
  // Builds a tree anew: if leaves are wrong or missing, its keys differ from the given ones.
  BlockTree tree = unrefined.withRefined(std::move(refined));
  if (tree.keys_ != keys)
    throw std::invalid_argument(
        fmt::format("these {} blocks are not the leaves of a grid of {} x {} x {} blocks with up to {} levels: there "
                    "are gaps or overlaps, they are not in order, or neighbours differ by more than one level",
                    keys.size(), roots[0], roots[1], roots[2], levels));
  return tree;
}

}  // namespace tushar::grid
