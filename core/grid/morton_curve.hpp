#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/grid/box.hpp"

namespace tushar::grid {

/// The blocks of a grid that is cut along each axis, in Morton order (G. M. Morton, A Computer Oriented Geodetic Data
/// Base and a New Technique in File Sequencing, IBM 1966): neighbours on the curve are close in space, so consecutive
/// blocks have few faces to other blocks.
///
/// The number of blocks along an axis is arbitrary. Nothing is stored for individual blocks: a position is found by
/// halving the grid, in as many steps as the number of blocks has bits.
class MortonCurve {
 public:
  /// `cuts[d]`: the first cell of each block along axis d, followed by the end of the last block.
  using Cuts = std::array<std::vector<int>, 3>;
  explicit MortonCurve(Cuts cuts);

  /// Number of blocks.
  int blocks() const { return static_cast<int>(all_.size()); }
  std::uint64_t cells() const { return cellsOf(all_); }
  /// Position of a block on the curve, from 0.
  int placeOf(const Index3& block) const;
  Index3 blockAt(int place) const;
  /// The cells of a block.
  Box cellsAt(const Index3& block) const;
  /// Number of cells in all blocks before a position on the curve.
  std::uint64_t cellsBefore(int place) const;
  /// The first position on the curve before which there are at least `cells` cells.
  int placeAfter(std::uint64_t cells) const;
  /// The block along an axis that contains a cell.
  int blockAlong(int axis, int cell) const;

 private:
  std::uint64_t cellsOf(const Box& blocks) const;
  /// Halves the grid repeatedly down to one block, which it returns; `isUpper(lower half, axis)` chooses the half.
  template <class IsUpper>
  Index3 descend(IsUpper&& isUpper) const;

  Cuts cuts_;
  Box all_;       ///< box of all blocks
  int bits_ = 0;  ///< number of bits of the largest block index along an axis
};

}  // namespace tushar::grid
