#include "core/tasks/rim_fluxes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tushar::tasks {

namespace {

/// Of the finer cells beyond a face of a coarse cell, the one with the lowest index along the axes of the face.
Index3 firstBehind(Index3 cell, const GhostCopy& copy, int dimension) {
  cell[copy.axis] += copy.side == 0 ? -1 : 1;
  cell = cell - copy.shift;
  for (int d = 0; d < dimension; ++d) cell[d] *= 2;
  if (copy.side == 0) ++cell[copy.axis];
  return cell;
}

/// The rim piece of a fine patch from which a copy is made; a single coarser patch lies beyond it.
const grid::RimPiece& pieceOf(const std::vector<grid::RimPiece>& pieces, const GhostCopy& copy, const Index3& behind) {
  return *std::find_if(pieces.begin(), pieces.end(), [&](const grid::RimPiece& one) {
    return !one.isFiner && one.axis == copy.axis && one.side != copy.side && one.cells.contains(behind);
  });
}

/// The finer faces that make up those faces of a box of coarse cells that are normal to one axis: the fluxes through
/// the first finer face, and the distances in memory between neighbouring finer faces along each axis.
struct FinerFaces {
  const double* first;
  std::array<std::ptrdiff_t, 3> strides;
};

template <int D>
void meansOf(const GhostCopy& copy, int components, const FinerFaces& finer, double* to) {
  const std::ptrdiff_t one = finer.strides[copy.axis == 0 ? 1 : 0],
                       other = finer.strides[copy.axis == 2 ? 1 : 2];  // along the face
  const Index3 count = copy.box.upper - copy.box.lower;
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y) {
      const double* face = finer.first + 2 * (y * finer.strides[1] + z * finer.strides[2]);
      for (int x = 0; x < count[0]; ++x, face += 2 * finer.strides[0])
        for (int k = 0; k < components; ++k) {
          const auto pair = [&](std::ptrdiff_t beside) { return face[k + beside] + face[k + beside + one]; };
          if constexpr (D == 1) *to++ = face[k];
          if constexpr (D == 2) *to++ = 0.5 * pair(0);
          if constexpr (D == 3) *to++ = 0.25 * (pair(0) + pair(other));
        }
    }
}

}  // namespace

void meanFluxes(const grid::Grid& grid, const GhostCopy& copy, int components, const double* fluxes, double* to) {
  const int dimension = grid.dimension();
  const Index3 behind = firstBehind(copy.box.lower, copy, dimension);
  const grid::RimPiece& piece = pieceOf(grid.rims(copy.from), copy, behind);
  const std::ptrdiff_t row = piece.cells.extent(0) * std::ptrdiff_t{components};
  const std::size_t place = (piece.first + piece.cells.offset(behind)) * static_cast<std::size_t>(components);
  const FinerFaces finer{fluxes + place, {components, row, row * piece.cells.extent(1)}};
  if (dimension == 1) return meansOf<1>(copy, components, finer, to);
  dimension == 2 ? meansOf<2>(copy, components, finer, to) : meansOf<3>(copy, components, finer, to);
}

}  // namespace tushar::tasks
