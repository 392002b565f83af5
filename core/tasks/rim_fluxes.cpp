#include "core/tasks/rim_fluxes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tushar::tasks {

namespace {

/// The finer cell behind a face of a coarse cell: the first along the other axes.
Index3 firstBehind(Index3 cell, const GhostCopy& copy, int dimension) {
  cell[copy.axis] += copy.side == 0 ? -1 : 1;
  cell = cell - copy.shift;
  for (int d = 0; d < dimension; ++d) cell[d] *= 2;
  if (copy.side == 0) ++cell[copy.axis];
  return cell;
}

/// The piece of the rim of a fine patch from which a copy is made, which has a single coarser patch behind it.
const grid::RimPiece& pieceOf(const std::vector<grid::RimPiece>& pieces, const GhostCopy& copy, const Index3& behind) {
  return *std::find_if(pieces.begin(), pieces.end(), [&](const grid::RimPiece& one) {
    return !one.isFiner && one.axis == copy.axis && one.side != copy.side && one.cells.contains(behind);
  });
}

}  // namespace

void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to) {
  const int dimension = grid.dimension();
  const grid::RimPiece& piece = pieceOf(grid.rims(copy.from), copy, firstBehind(copy.box.lower, copy, dimension));
  const std::array<std::ptrdiff_t, 3> strides{
      components, piece.cells.extent(0) * std::ptrdiff_t{components},
      piece.cells.extent(0) * std::ptrdiff_t{piece.cells.extent(1)} * components};
  const std::ptrdiff_t first = strides[copy.axis == 0 ? 1 : 0],
                       second = strides[copy.axis == 2 ? 1 : 2];  // of the face
  grid::forEach<3>(copy.box, [&](const Index3& cell) {
    const std::size_t place = piece.first + piece.cells.offset(firstBehind(cell, copy, dimension));
    const double* face = fluxes + place * static_cast<std::size_t>(components);
    for (int k = 0; k < components; ++k, ++face) {
      const auto pair = [&](std::ptrdiff_t beside) { return face[beside] + face[beside + first]; };
      if (dimension == 1) *to++ = *face;
      if (dimension == 2) *to++ = 0.5 * pair(0);
      if (dimension == 3) *to++ = 0.25 * (pair(0) + pair(second));
    }
  });
}

}  // namespace tushar::tasks
