#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/vec.hpp"

namespace tushar::grid {

/// A block of cells: its level (0: coarsest) and its index among the blocks of this level along the kernel axes.
struct BlockId {
  int level = 0;
  Index3 at{};

  friend bool operator==(const BlockId&, const BlockId&) = default;
  /// The order along Morton's curve through all levels, depth first: a block precedes its children. Works for levels
  /// from 0 to 31 and for any index, even outside the grid.
  friend std::strong_ordering operator<=>(const BlockId& a, const BlockId& b);
};

/// The tree of blocks of a grid. Its leaves are the blocks that are not refined; together they cover the grid. Refining
/// a block divides it in two along each axis. Leaves that touch, even only at an edge or a corner, differ by at most
/// one level; along periodic axes, this includes their images. A tree never changes: regridding makes a new one.
class BlockTree {
 public:
  /// A tree without refined blocks. `roots`: blocks of level 0 along the kernel axes (1 beyond `dimension`);
  /// `periodic[d]` != 0 if the grid is periodic along axis d; `levels`: maximum number of levels, from 1 to 16. Throws
  /// std::invalid_argument for other values, or if the finest level has more than 2^20 blocks along an axis.
  BlockTree(int dimension, const Index3& roots, const Index3& periodic, int levels);

  int dimension() const { return dimension_; }
  int levels() const { return levels_; }
  const Index3& roots() const { return roots_; }
  /// Number of blocks of a level along each kernel axis, if all were refined: the number of roots times 2^level.
  Index3 blocksOf(int level) const;

  /// The leaves, depth first along Morton's curve through all levels (G. M. Morton, A Computer Oriented Geodetic Data
  /// Base and a New Technique in File Sequencing, IBM 1966).
  const std::vector<BlockId>& leaves() const { return leaves_; }
  /// The level of the leaf at the place of a block: the block's own level, or a coarser one; block.level + 1 if the
  /// block is refined. Periodic images count as their originals; for other blocks outside the grid, returns -1.
  int levelAt(const BlockId& block) const;
  /// Position of a leaf on the curve, from 0; the block must be a leaf, not a periodic image.
  int placeOf(const BlockId& leaf) const;
  /// Position of any block of the grid on the curve; -1 if it is not a leaf.
  int placeIfLeaf(const BlockId& block) const;
  /// Whether a block is refined. A periodic image is refined if its original is.
  bool isRefined(const BlockId& block) const { return levelAt(block) > block.level; }

  /// The tree in which exactly these blocks are refined: all of `wanted`, those of `kept` that are refined now, and all
  /// blocks that must be refined because of these: their ancestors, and neighbours, so that adjacent leaves differ by
  /// at most one level. Periodic images count as their originals. Blocks of the last level, and blocks outside the grid
  /// along other axes, are ignored. The order of blocks, and duplicates, do not matter.
  BlockTree regridded(const std::vector<BlockId>& wanted, const std::vector<BlockId>& kept) const;

  /// Leaves as numbers, sorted along the curve, for checkpoints and messages. A number consists of the interleaved bits
  /// of the block's lower corner, counted in blocks of the finest level, z above y above x, and below them four bits
  /// for the level.
  const std::vector<std::uint64_t>& keys() const { return keys_; }
  /// The tree with these leaves. Throws std::invalid_argument if they are not, in this order, the leaves of a tree that
  /// covers the grid, or if touching leaves differ by more than one level.
  static BlockTree fromKeys(int dimension, const Index3& roots, const Index3& periodic, int levels,
                            const std::vector<std::uint64_t>& keys);

  /// Whether grid, levels and leaves are equal.
  friend bool operator==(const BlockTree&, const BlockTree&) = default;

 private:
  using Keys = std::vector<std::uint64_t>;

  std::uint64_t keyOf(const BlockId& block) const;
  BlockId blockOf(std::uint64_t key) const;
  /// The block itself, or the block of which it is a periodic image; none outside the grid.
  std::optional<BlockId> inside(const BlockId& block) const;
  /// The smallest valid tree in which these blocks of each level are refined.
  BlockTree withRefined(std::vector<Keys> refined) const;
  /// Adds to `coarser` the blocks of the next coarser level that must be refined so that all neighbours of a refined
  /// block exist.
  void addRefinedAround(const BlockId& block, Keys& coarser) const;
  void setLeaves(const std::vector<Keys>& refined);

  int dimension_;
  Index3 roots_;
  Index3 periodic_{};  ///< for each kernel axis: 1 if periodic, otherwise 0
  int levels_;
  Keys keys_;  ///< keys of the leaves, sorted
  std::vector<BlockId> leaves_;
};

}  // namespace tushar::grid
