#include "core/grid/partition.hpp"

namespace tushar::grid {

// A patch belongs to rank floor(before · ranks / cells), where `before` counts the cells of the patches before it.

int Partition::firstOf(int rank) const {
  const auto ranks = static_cast<std::uint64_t>(ranks_), wanted = static_cast<std::uint64_t>(rank);
  return curve_->placeAfter((wanted * curve_->cells() + ranks - 1) / ranks);
}

int Partition::ownerOf(int place) const {
  return static_cast<int>(curve_->cellsBefore(place) * static_cast<std::uint64_t>(ranks_) / curve_->cells());
}

}  // namespace tushar::grid
