#pragma once

#include <array>
#include <random>
#include <vector>

#include "components/mpm/solid/transfer/extent.hpp"
#include "tests/support/levels.hpp"

namespace tushar::mpm::solid {

template <int D>
Level grid() {
  grid::Domain domain = test::domain(D == 1 ? Index3{{10, 0, 0}} : D == 2 ? Index3{{10, 7, 0}} : Index3{{10, 7, 5}});
  domain.nodesBeyond = 1;
  return Level(domain);
}

/// A particle at a position where shape functions may go wrong: anywhere, on a face between cells, on an edge or
/// corner, right at a side of the grid, or extremely close to one of these.
template <int D>
struct Somewhere {
  Index<D> cell;
  Vec<D> x;
  Extent<D> extent;

  Somewhere(const Level& level, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(0, 1);
    std::uniform_int_distribution<int> way(0, 5);
    for (int d = 0; d < D; ++d) {
      const int cells = level.cells().upper[d];
      const int kind = way(random);
      cell[d] = kind < 2 ? 0 : kind < 4 ? cells - 1 : std::uniform_int_distribution<int>(0, cells - 1)(random);
      const std::array<double, 6> places{uniform(random), 0, 1, 1e-9, 1 - 1e-9, 0.5};
      x[d] = level.nodePosition(d, cell[d]) + places[way(random)] * level.spacing(d);
      extent.size[d] = 0.1 + 0.9 * uniform(random);
      for (int e = 0; e < D; ++e)
        extent.halfEdges(e, d) = 0.5 * extent.size[d] * ((e == d) + 0.3 * (uniform(random) - 0.5));
    }
  }
};

/// Particles of one cell, at most as many as there are SIMD lanes.
template <class Shape>
struct InOneCell {
  static constexpr int D = Shape::dimension;
  Index<D> cell;
  std::vector<Vec<D>> x;
  Extent<D> extent;
  int count;

  InOneCell(const Level& level, std::mt19937& random) {
    count = std::uniform_int_distribution<int>(1, Lanes::count)(random);
    const Somewhere<D> first(level, random);
    cell = first.cell;
    extent = first.extent;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int k = 0; k < count; ++k) {
      x.push_back(first.x);
      for (int d = 0; d < D; ++d) x[k][d] = level.nodePosition(d, cell[d]) + uniform(random) * level.spacing(d);
    }
  }
  auto stencils(const Level& level) const {
    std::array<Lanes, D> size;
    for (int d = 0; d < D; ++d) size[d] = extent.size[d];
    return typename Shape::Stencils(CellFrame<D>(level, cell), cell, vectorsOf<D>(x.data(), count), size);
  }
};

}  // namespace tushar::mpm::solid
