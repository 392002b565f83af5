#pragma once

#include <utility>

#include "core/grid/morton_curve.hpp"
#include "core/grid/shares.hpp"

namespace tushar::grid {

/// One of the ranks that share a grid.
struct Share {
  int rank = 0, ranks = 1;
};

/// Which rank has which patches: each a run of consecutive places of the curve.
class Partition {
 public:
  /// Shares of as many cells as whole patches allow. Nothing is kept for each rank. Rank 0 has a patch always.
  Partition(const MortonCurve& curve, int ranks) : curve_(&curve), ranks_(ranks) {}
  /// Keeps the shares that are given.
  Partition(const MortonCurve& curve, RankOffsets offsets)
      : curve_(&curve), ranks_(static_cast<int>(offsets.size()) - 1), offsets_(std::move(offsets)) {}

  /// The place of the first patch of a rank, which is that of the next where it has none.
  int firstOf(int rank) const;
  int ownerOf(int place) const;

 private:
  const MortonCurve* curve_;
  int ranks_;
  RankOffsets offsets_;  ///< empty: by cells
};

}  // namespace tushar::grid
