#pragma once

#include <utility>
#include <vector>

#include "core/base/function_ref.hpp"
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
  using VisitRow = FunctionRef<void(const Index3& first, int end)>;
  /// Calls `visit(first, end)` for each row: its first node, and the end of the row along the first axis.
  void forEachRow(VisitRow visit) const;
  /// Visits the parts of the rows that lie within a box.
  void forEachRow(const grid::Box& within, VisitRow visit) const;

 private:
  void touch(const Index3& cellRow, int low, int high, int ghost, int dimension);

  grid::Box nodes_, rows_;
  /// Range of each row along the first axis; empty if no particle touches any of its nodes.
  std::vector<std::pair<int, int>> touched_;
};

}  // namespace tushar::data
