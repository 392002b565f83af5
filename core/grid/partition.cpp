#include "core/grid/partition.hpp"

#include <algorithm>

namespace tushar::grid {

// By default, the cells are cut at rank · cells / ranks, and a patch belongs to the rank whose cuts enclose the middle
// of the patch. So if two patches have 61 and 62 cells, each of two ranks gets one. Patch 0 belongs to rank 0.

int Partition::firstOf(int rank) const {
  if (!offsets_.empty()) return offsets_[rank];
  if (rank == 0) return 0;
  const auto ranks = static_cast<std::uint64_t>(ranks_), wanted = static_cast<std::uint64_t>(rank);
  const std::uint64_t cut = wanted * tiling_->cells();
  const int behind = tiling_->patchAfter((cut + ranks - 1) / ranks);
  return behind > 1 && twiceMiddle(behind - 1) * ranks > 2 * cut ? behind - 1 : behind;
}

int Partition::ownerOf(int patch) const {
  if (!offsets_.empty())
    return static_cast<int>(std::upper_bound(offsets_.begin(), offsets_.end(), patch) - offsets_.begin()) - 1;
  if (patch == 0) return 0;
  return static_cast<int>((twiceMiddle(patch) * static_cast<std::uint64_t>(ranks_) - 1) / (2 * tiling_->cells()));
}

/// Twice the number of cells before the middle of a patch (twice, so that the number is an integer).
std::uint64_t Partition::twiceMiddle(int patch) const {
  return tiling_->cellsBefore(patch) + tiling_->cellsBefore(patch + 1);
}

}  // namespace tushar::grid
