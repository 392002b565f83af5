#pragma once

#include "components/mpm/solid/transfer/transfer.hpp"

namespace tushar::mpm::solid {

/// The rows of nodes along the first axis that particles touch: others are neither cleared nor looked at.
template <int D>
class TouchedRows {
 public:
  /// Rows within `nodes` that particles in cells `around` touch: the nodes of their cells and `ghost` beyond.
  template <class View>
  TouchedRows(const View& particles, const Box& around, int ghost, const Box& nodes) : nodes_(nodes) {
    rows_ = nodes;
    rows_.upper[0] = rows_.lower[0] + 1;
    touched_.resize(rows_.size(), {nodes.upper[0], nodes.lower[0]});
    Box cellRows = around;
    cellRows.upper[0] = cellRows.lower[0] + 1;
    forEach<3>(cellRows, [&](const Index3& first) {
      const auto span = particles.set().occupied(first, around.upper[0]);
      if (!span.empty()) touch(first, span.first - ghost, span.last + 1 + ghost, ghost);
    });
  }

  /// Calls `visit(first, end)`: the first node of a row, and the coordinate behind its last along the first axis.
  template <class Visit>
  void forEachRow(Visit&& visit) const {
    std::size_t k = 0;
    forEach<3>(rows_, [&](const Index3& row) {
      const auto [low, high] = touched_[k++];
      if (low < high) visit(Index3{{low, row[1], row[2]}}, high);
    });
  }

  /// Visits the parts of the rows that lie within a box.
  template <class Visit>
  void forEachRow(const Box& within, Visit&& visit) const {
    Box rows = within.intersect(nodes_);
    const int lower = rows.lower[0], upper = rows.upper[0];
    if (lower >= upper) return;
    rows.lower[0] = rows_.lower[0];
    rows.upper[0] = rows_.upper[0];
    forEach<3>(rows, [&](const Index3& row) {
      const auto [low, high] = touched_[rows_.offset(row)];
      if (const int first = std::max(low, lower), end = std::min(high, upper); first < end)
        visit(Index3{{first, row[1], row[2]}}, end);
    });
  }

 private:
  void touch(const Index3& cellRow, int low, int high, int ghost) {
    Box around{cellRow, cellRow + Index3::filled(1)};
    for (int d = 1; d < D; ++d) {
      around.lower[d] -= ghost;
      around.upper[d] += 1 + ghost;
    }
    around.lower[0] = rows_.lower[0];
    around.upper[0] = rows_.upper[0];
    forEach<3>(around.intersect(rows_), [&](const Index3& row) {
      auto& range = touched_[rows_.offset(row)];
      range.first = std::max(std::min(range.first, low), nodes_.lower[0]);
      range.second = std::min(std::max(range.second, high), nodes_.upper[0]);
    });
  }

  Box nodes_, rows_;
  std::vector<std::pair<int, int>> touched_;
};

/// The records as one sees them from a node, which may lie beyond those that are stored.
template <class Record, int D>
NodeWindow<Record, D> windowFrom(const NodeView<Record>& records, const Index<D>& first) {
  const Box& stored = records.stored();
  NodeWindow<Record, D> window;
  std::ptrdiff_t at = 0, stride = 1;
  for (int d = 0; d < D; ++d) {
    window.stride[d] = stride;
    at += (first[d] - stored.lower[d]) * stride;
    stride *= stored.extent(d);
  }
  window.origin = records.values() + at;
  return window;
}

/// The records that a stencil touches. Throws AccessError in the dev preset where some are not stored.
template <class Record, class Stencil, int D = Stencil::dimension>
NodeWindow<Record, D> windowOf(const NodeView<Record>& records, const Stencil& stencil) {
  const Box& stored = records.stored();
  if constexpr (data::checked) {
    Index<D> last = stencil.first;
    for (int d = 0; d < D; ++d) last[d] += Stencil::nodes - 1;
    if (!stored.contains(stencil.first) || !stored.contains(last))
      throw data::AccessError("a particle touches nodes beyond those that are stored");
  }
  return windowFrom(records, stencil.first);
}

}  // namespace tushar::mpm::solid
