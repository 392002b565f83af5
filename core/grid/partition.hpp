#pragma once

#include <utility>

#include "core/grid/shares.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// One of the ranks that share a grid.
struct Share {
  int rank = 0, ranks = 1;
};

/// Which rank has which patches: each a run of consecutive ones.
class Partition {
 public:
  /// Shares of as many cells as whole patches allow. Nothing is kept for each rank. Rank 0 has a patch always.
  Partition(const Tiling& tiling, int ranks) : tiling_(&tiling), ranks_(ranks) {}
  /// Keeps the shares that are given.
  Partition(const Tiling& tiling, RankOffsets offsets)
      : tiling_(&tiling), ranks_(static_cast<int>(offsets.size()) - 1), offsets_(std::move(offsets)) {}

  /// The first patch of a rank, which is that of the next where it has none.
  int firstOf(int rank) const;
  int ownerOf(int patch) const;

 private:
  std::uint64_t twiceMiddle(int patch) const;

  const Tiling* tiling_;
  int ranks_;
  RankOffsets offsets_;  ///< empty: by cells
};

}  // namespace tushar::grid
