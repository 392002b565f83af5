#include "core/grid/partition.hpp"

#include <algorithm>

namespace tushar::grid {

// Where nothing else is given, a patch belongs to rank floor(before · ranks / cells), where `before` counts the cells
// of the patches before it.

int Partition::firstOf(int rank) const {
  if (!offsets_.empty()) return offsets_[rank];
  const auto ranks = static_cast<std::uint64_t>(ranks_), wanted = static_cast<std::uint64_t>(rank);
  return tiling_->patchAfter((wanted * tiling_->cells() + ranks - 1) / ranks);
}

int Partition::ownerOf(int patch) const {
  if (!offsets_.empty())
    return static_cast<int>(std::upper_bound(offsets_.begin(), offsets_.end(), patch) - offsets_.begin()) - 1;
  return static_cast<int>(tiling_->cellsBefore(patch) * static_cast<std::uint64_t>(ranks_) / tiling_->cells());
}

}  // namespace tushar::grid
