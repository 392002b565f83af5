#include "core/grid/rim.hpp"

#include "core/grid/grid.hpp"

namespace tushar::grid {

namespace {

/// The cells just beyond a side of a patch, on the grid or its periodic images.
Box cellsBeyond(const Patch& patch, int axis, int side) {
  Box beyond = patch.cells();
  beyond.lower[axis] = side == 0 ? beyond.lower[axis] - 1 : beyond.upper[axis];
  beyond.upper[axis] = beyond.lower[axis] + 1;
  return patch.level().clipCells(beyond);
}

}  // namespace

std::vector<RimPiece> rimsOf(const Grid& grid, const Patch& patch) {
  std::vector<RimPiece> pieces;
  const Level& level = patch.level();
  const int dimension = level.dimension();
  for (int d = 0; d < dimension; ++d)
    for (const int side : {0, 1}) {
      const Box beyond = cellsBeyond(patch, d, side);
      if (beyond.empty()) continue;
      const auto add = [&](const Patch& other, Box behind, const Index3& shift, bool isFiner) {
        behind = behind.intersect(beyond);
        if (behind.empty()) return;
        const Box cells = behind.shifted(Index3::unit(d) * (side == 0 ? 1 : -1));
        pieces.push_back({d, side, cells, other.id(), shift, isFiner, sizeOf(pieces)});
      };
      if (level.number() + 1 < grid.levels())
        grid.forEachOverlapping(grid.level(level.number() + 1), beyond.refined(dimension),
                                [&](const Patch& other, Index3 shift) {
                                  for (int k = 0; k < dimension; ++k) shift[k] /= 2;
                                  add(other, other.cells().coarsened(dimension).shifted(shift), shift, true);
                                });
      if (level.number() > 0)
        grid.forEachOverlapping(grid.level(level.number() - 1), beyond.coarsened(dimension),
                                [&](const Patch& other, const Index3& shift) {
                                  add(other, other.cells().shifted(shift).refined(dimension), shift, false);
                                });
    }
  return pieces;
}

std::size_t sizeOf(const std::vector<RimPiece>& pieces) {
  return pieces.empty() ? 0 : pieces.back().first + pieces.back().size();
}

}  // namespace tushar::grid
