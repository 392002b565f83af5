#include "core/data/touched_rows.hpp"

#include <algorithm>

#include "core/data/particle_set.hpp"

namespace tushar::data {

using grid::Box;

TouchedRows TouchedRows::all(const Box& nodes) {
  TouchedRows rows;
  rows.nodes_ = nodes;
  rows.rows_ = nodes.rowStarts();
  rows.touched_.resize(nodes.rows(), {nodes.lower[0], nodes.upper[0]});
  return rows;
}

TouchedRows::TouchedRows(const ParticleSet& particles, const Box& around, int ghost, const Box& nodes, int dimension)
    : nodes_(nodes), rows_(nodes.rowStarts()) {
  if (particles.hasNone() || around.empty()) return;
  touched_.resize(nodes.rows(), {nodes.upper[0], nodes.lower[0]});
  grid::forEach<3>(around.rowStarts(), [&](const Index3& first) {
    const auto span = particles.occupied(first, around.upper[0]);
    if (!span.empty()) touch(first, span.first - ghost, span.last + 1 + ghost, ghost, dimension);
  });
}

void TouchedRows::forEachRow(VisitRow visit) const {
  if (touched_.empty()) return;
  const std::pair<int, int>* touched = touched_.data();
  grid::forEach<3>(rows_, [&](const Index3& row) {
    const auto [low, high] = *touched++;
    if (low < high) visit(Index3{{low, row[1], row[2]}}, high);
  });
}

void TouchedRows::forEachRow(const Box& within, VisitRow visit) const {
  Box rows = within.intersect(nodes_);
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

void TouchedRows::touch(const Index3& cellRow, int low, int high, int ghost, int dimension) {
  low = std::max(low, nodes_.lower[0]);
  high = std::min(high, nodes_.upper[0]);
  if (low >= high) return;
  Index3 first = cellRow, end = cellRow + Index3::filled(1);
  for (int d = 1; d < dimension; ++d) {
    first[d] = std::max(cellRow[d] - ghost, nodes_.lower[d]);
    end[d] = std::min(cellRow[d] + 2 + ghost, nodes_.upper[d]);
  }
  for (int z = first[2]; z < end[2]; ++z)
    for (int y = first[1]; y < end[1]; ++y) {
      auto& [least, most] = touched_[rows_.rowOf({{0, y, z}})];
      least = std::min(least, low);
      most = std::max(most, high);
    }
}

}  // namespace tushar::data
