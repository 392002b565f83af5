#pragma once

#include <utility>

#include "core/grid/shares.hpp"
#include "core/grid/tiling.hpp"

namespace tushar::grid {

/// One of the ranks that share a grid.
struct Share {
  int rank = 0, ranks = 1;
};

/// The distribution of patches to ranks: each rank has consecutive patches.
class Partition {
 public:
  /// Distributes patches so that numbers of cells are as equal as whole patches allow. Needs no memory per rank. Rank 0
  /// always has a patch.
  Partition(const Tiling& tiling, int ranks) : tiling_(&tiling), ranks_(ranks) {}
  /// Distributes patches as given.
  Partition(const Tiling& tiling, RankOffsets offsets)
      : tiling_(&tiling), ranks_(static_cast<int>(offsets.size()) - 1), offsets_(std::move(offsets)) {}

  /// The first patch of a rank; for a rank without patches, that of the next rank.
  int firstOf(int rank) const;
  int ownerOf(int patch) const;

 private:
  std::uint64_t twiceMiddle(int patch) const;

  const Tiling* tiling_;
  int ranks_;
  RankOffsets offsets_;  ///< empty: distribution by cells
};

}  // namespace tushar::grid
