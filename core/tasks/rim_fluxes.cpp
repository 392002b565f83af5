#include "core/tasks/rim_fluxes.hpp"

#include <algorithm>

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

}  // namespace

void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to) {
  const int dimension = grid.dimension();
  const std::vector<grid::RimPiece>& pieces = grid.rims(copy.from);
  const auto at = [&](const Index3& cell) {
    const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const grid::RimPiece& one) {
      return !one.isFiner && one.axis == copy.axis && one.side != copy.side && one.cells.contains(cell);
    });
    return fluxes + (piece->first + piece->cells.offset(cell)) * static_cast<std::size_t>(components);
  };
  const int first = copy.axis == 0 ? 1 : 0, second = copy.axis == 2 ? 1 : 2;  // the axes of the face
  grid::forEach<3>(copy.box, [&](const Index3& cell) {
    const Index3 behind = firstBehind(cell, copy, dimension);
    for (int k = 0; k < components; ++k) {
      const auto pair = [&](Index3 face) {
        const double lower = at(face)[k];
        ++face[first];
        return lower + at(face)[k];
      };
      if (dimension == 1) *to++ = at(behind)[k];
      if (dimension == 2) *to++ = 0.5 * pair(behind);
      if (dimension == 3) *to++ = 0.25 * (pair(behind) + pair(behind + Index3::unit(second)));
    }
  });
}

}  // namespace tushar::tasks
