#pragma once

#include "core/grid/level.hpp"

namespace tushar::solvers {

/// Gives each cell of a grid its number in a global system: in lexicographic order, so that the patches do not matter.
class CellNumbering {
 public:
  explicit CellNumbering(const grid::Level& level) : level_(&level) {}

  int owned() const { return static_cast<int>(level_->cells().size()); }
  /// Of a cell of the grid or, along periodic axes, of an image of one; -1 beyond the grid.
  template <int D>
  int operator()(Index<D> cell) const {
    for (int d = 0; d < D; ++d) {
      const int count = level_->cells().extent(d);
      if (level_->isPeriodic(d)) cell[d] = (cell[d] % count + count) % count;
      if (cell[d] < 0 || cell[d] >= count) return -1;
    }
    return static_cast<int>(level_->cellNumber<D>(cell));
  }

 private:
  const grid::Level* level_;
};

}  // namespace tushar::solvers
