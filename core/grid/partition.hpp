#pragma once

#include <utility>

#include "core/grid/shares.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// The share of one rank in a grid.
struct Share {
  int rank = 0, ranks = 1;
};

/// The distribution of patches over ranks: each rank has consecutive patches.
class Partition {
 public:
  /// Distributes patches so that the ranks have numbers of cells as equal as possible. Needs no memory per rank. Rank 0
  /// always has a patch.
  Partition(const Tiling& tiling, int ranks) : tiling_(&tiling), ranks_(ranks) {}
  /// Distributes patches as given.
  Partition(const Tiling& tiling, RankOffsets offsets)
      : tiling_(&tiling), ranks_(static_cast<int>(offsets.size()) - 1), offsets_(std::move(offsets)) {}

  /// The first patch of a rank; for a rank without patches, the first patch of the next rank.
  int firstOf(int rank) const;
  int ownerOf(int patch) const;

 private:
  std::uint64_t twiceMiddle(int patch) const;

  const Tiling* tiling_;
  int ranks_;
  RankOffsets offsets_;  ///< empty if patches are distributed by numbers of cells
};

}  // namespace tushar::grid
