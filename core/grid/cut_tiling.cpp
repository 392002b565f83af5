#include "core/grid/cut_tiling.hpp"

namespace tushar::grid {

Tile CutTiling::tileOf(int, const Index3& cell) const {
  Index3 block;
  for (int d = 0; d < 3; ++d) block[d] = curve_.blockAlong(d, cell[d]);
  return {curve_.placeOf(block), 0, curve_.cellsAt(block)};
}

std::vector<Tile> CutTiling::overlapping(int, const Box& cells) const {
  Box blocks;
  for (int d = 0; d < 3; ++d) {
    blocks.lower[d] = curve_.blockAlong(d, cells.lower[d]);
    blocks.upper[d] = curve_.blockAlong(d, cells.upper[d] - 1) + 1;
  }
  std::vector<Tile> found;
  forEach<3>(blocks, [&](const Index3& block) { found.push_back({curve_.placeOf(block), 0, curve_.cellsAt(block)}); });
  return found;
}

}  // namespace tushar::grid
