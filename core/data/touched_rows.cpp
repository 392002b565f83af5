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
