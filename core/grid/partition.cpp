#include "core/grid/partition.hpp"

#include <algorithm>

namespace tushar::grid {

// Where nothing else is given, a patch belongs to rank floor(before · ranks / cells), where `before` counts the cells
// of the patches before it.

int Partition::firstOf(int rank) const {
  if (!offsets_.empty()) return offsets_[rank];
  const auto ranks = static_cast<std::uint64_t>(ranks_), wanted = static_cast<std::uint64_t>(rank);
  return curve_->placeAfter((wanted * curve_->cells() + ranks - 1) / ranks);
}

int Partition::ownerOf(int place) const {
  if (!offsets_.empty())
    return static_cast<int>(std::upper_bound(offsets_.begin(), offsets_.end(), place) - offsets_.begin()) - 1;
  return static_cast<int>(curve_->cellsBefore(place) * static_cast<std::uint64_t>(ranks_) / curve_->cells());
}

}  // namespace tushar::grid
