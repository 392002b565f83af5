#pragma once

#include "core/grid/grid.hpp"

namespace tushar::test {

/// A grid of unit length along x (and 0.6, 0.4 along y, z where they have cells), symmetry planes all around.
inline grid::Domain domain(const Index3& resolution, const Index3& patches = {{1, 1, 1}}) {
  grid::Domain domain;
  domain.upper = {1, 0.6, 0.4};
  domain.resolution = resolution;
  domain.patches = patches;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      domain.boundaries.face(axis, side).push_back({grid::symmetric, grid::BoundaryKind::symmetry});
  return domain;
}

/// A grid of unit length along its first D axes, in two patches along each, without boundary conditions.
template <int D>
grid::Domain unitBox(int cells) {
  grid::Domain domain;
  domain.upper = Vec3::Zero();
  for (int d = 0; d < D; ++d) {
    domain.upper[d] = 1;
    domain.resolution[d] = cells;
    domain.patches[d] = 2;
  }
  return domain;
}

/// A square of 2 m in 8 x 4 cells, one cell of .1 m thick, in three dimensions.
inline grid::Domain sheet() {
  grid::Domain domain;
  domain.lower = {-1, -1, 0};
  domain.upper = {1, 1, 0.1};
  domain.resolution = {{8, 4, 1}};
  return domain;
}

/// A plane grid of cells of 1 m, without boundary conditions.
inline grid::Domain unitCells(int x, int y) {
  grid::Domain domain;
  domain.upper = Vec3(x, y, 0);
  domain.resolution = {{x, y, 0}};
  return domain;
}

}  // namespace tushar::test
