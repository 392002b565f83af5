#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/grid/grid.hpp"

namespace tushar::solvers {

/// Indices of the cells that a rank uses in a global system, as required by Unknowns: its own cells come first,
/// followed by those of other ranks. On a single rank, the order does not depend on the patches: it is lexicographic on
/// one level, and follows the blocks along Morton's curve on several levels.
class CellNumbering {
 public:
  /// On one level, cells of other ranks that share a face with the rank's own cells are included from the start.
  explicit CellNumbering(const grid::Grid& grid);

  int owned() const { return owned_; }
  /// The cells of other ranks, as global indices.
  const std::vector<int>& ghosts() const { return ghosts_; }
  /// Adds a cell of a grid of several levels, or its periodic image, to the cells that this rank uses.
  template <int D>
  void meet(int level, const Index<D>& image) {
    const std::uint64_t among = numberAmongAll(level, expanded(grid_->level(level).template wrapped<D>(image)));
    if (isOwn(among)) return;
    if (numbers_.emplace(among, owned_ + static_cast<int>(ghosts_.size())).second)
      ghosts_.push_back(static_cast<int>(among));
  }
  /// The index of a cell of the grid or, along periodic axes, of a periodic image; -1 outside the grid and for unknown
  /// cells of other ranks.
  template <int D>
  int operator()(int level, const Index<D>& image) const {
    const grid::Level& of = grid_->level(level);
    const Index<D> cell = of.template wrapped<D>(image);
    if (!of.cells().contains(cell)) return -1;
    if (grid_->levels() == 1 && grid_->share().ranks == 1) return static_cast<int>(of.template cellNumber<D>(cell));
    if (grid_->levels() == 1) return known(of.template cellNumber<D>(cell));
    const std::uint64_t among = numberAmongAll(level, expanded(cell));
    return isOwn(among) ? static_cast<int>(among - first_) : known(among);
  }

 private:
  /// Cells with consecutive indices.
  struct Run {
    int level;
    grid::Box cells;
    std::uint64_t first;
  };

  template <int D>
  static Index3 expanded(const Index<D>& cell) {
    Index3 full;
    std::copy(cell.at.begin(), cell.at.end(), full.at.begin());
    return full;
  }
  bool isOwn(std::uint64_t among) const { return among >= first_ && among - first_ < std::uint64_t(owned_); }
  int known(std::uint64_t key) const {
    const auto found = numbers_.find(key);
    return found == numbers_.end() ? -1 : found->second;
  }
  /// Numbers this rank's cells patch by patch, so that every rank can compute the indices of all cells.
  void numberOwnPatches();
  void numberGhosts(const grid::Patch& patch, const std::vector<int>& firstOf);
  /// The global index of a cell on several levels: block by block on one rank, otherwise patch by patch. Throws
  /// data::AccessError for a cell that is refined or part of a coarser cell.
  std::uint64_t numberAmongAll(int level, const Index3& cell) const;
  Run runAround(int level, const Index3& cell) const;

  const grid::Grid* grid_;
  int owned_ = 0;
  std::uint64_t first_ = 0;  ///< global index of the first of this rank's cells, on several levels
  std::vector<int> ghosts_;
  /// The index of each cell that this rank uses, by its number on the level; on several levels, only those of other
  /// ranks' cells, by their global index.
  std::unordered_map<std::uint64_t, int> numbers_;
  mutable std::optional<Run> last_;  ///< the run that was found last
};

}  // namespace tushar::solvers
