#pragma once

#include <unordered_map>
#include <vector>

#include "core/grid/grid.hpp"

namespace tushar::solvers {

/// Numbers the cells of a rank in a global system, as Unknowns requires: its own cells, then those of other ranks that
/// share a face with them. On one rank the order is lexicographic, so that the patches do not matter.
class CellNumbering {
 public:
  explicit CellNumbering(const grid::Level& level) : level_(&level) {
    if (level.grid().share().ranks > 1) numberOwnPatches();
  }

  int owned() const { return level_->grid().share().ranks > 1 ? owned_ : static_cast<int>(level_->cells().size()); }
  /// The cells of other ranks: their numbers among those of all ranks.
  const std::vector<int>& ghosts() const { return ghosts_; }
  /// The number of a cell of the grid or, along periodic axes, of a periodic image; -1 beyond the grid and far from the
  /// patches of this rank.
  template <int D>
  int operator()(const Index<D>& image) const {
    const Index<D> cell = level_->wrapped(image);
    if (!level_->cells().contains(cell)) return -1;
    const std::uint64_t place = level_->cellNumber<D>(cell);
    if (level_->grid().share().ranks == 1) return static_cast<int>(place);
    const auto found = numbers_.find(place);
    return found == numbers_.end() ? -1 : found->second;
  }

 private:
  /// Numbers patch by patch, so that every rank has the numbers of all.
  void numberOwnPatches();
  void numberGhosts(const grid::Patch& patch, const std::vector<int>& firstOf);

  const grid::Level* level_;
  int owned_ = 0;
  std::vector<int> ghosts_;
  std::unordered_map<std::uint64_t, int> numbers_;
};

}  // namespace tushar::solvers
