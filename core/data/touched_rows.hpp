#pragma once

#include <utility>
#include <vector>

#include "core/grid/box.hpp"

namespace tushar::data {

class ParticleSet;

/// The rows of nodes along the first axis that particles touch; other nodes are neither cleared nor read nor copied.
class TouchedRows {
 public:
  /// Constructs an empty set of rows.
  TouchedRows() = default;
  /// All rows of `nodes`, in full.
  static TouchedRows all(const grid::Box& nodes);
  /// Rows within `nodes` that particles in cells `around` touch: the nodes of their cells and `ghost` layers around
  /// them, along the first `dimension` axes.
  TouchedRows(const ParticleSet& particles, const grid::Box& around, int ghost, const grid::Box& nodes, int dimension);

  bool empty() const { return touched_.empty(); }
  /// Calls `visit(first, end)` for each row: its first node, and the end of the row along the first axis.
  template <class Visit>
  void forEachRow(Visit&& visit) const {
    if (touched_.empty()) return;
    const std::pair<int, int>* touched = touched_.data();
    grid::forEach<3>(rows_, [&](const Index3& row) {
      const auto [low, high] = *touched++;
      if (low < high) visit(Index3{{low, row[1], row[2]}}, high);
    });
  }

  /// Visits the parts of the rows that lie within a box.
  template <class Visit>
  void forEachRow(const grid::Box& within, Visit&& visit) const {
    grid::Box rows = within.intersect(nodes_);
    if (touched_.empty() || rows.empty()) return;
    const int lower = rows.lower[0], upper = rows.upper[0];
    rows.lower[0] = rows_.lower[0];
    rows.upper[0] = rows_.upper[0];
    grid::forEach<3>(rows, [&](const Index3& row) {
      const auto [low, high] = touched_[rows_.rowOf(row)];
      if (const int first = std::max(low, lower), end = std::min(high, upper); first < end)
        visit(Index3{{first, row[1], row[2]}}, end);
    });
  }

 private:
  void touch(const Index3& cellRow, int low, int high, int ghost, int dimension);

  grid::Box nodes_, rows_;
  /// Range of each row along the first axis; empty if no particle touches any of its nodes.
  std::vector<std::pair<int, int>> touched_;
};

}  // namespace tushar::data
