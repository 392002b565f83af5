#pragma once

#include <array>

#include "core/grid/grid.hpp"

namespace tushar::numerics {

/// Determines which cells of a grid of several levels exist: those that are neither refined nor part of coarser cells.
template <int D>
class LeafCells {
 public:
  /// The grid must outlive this object.
  explicit LeafCells(const grid::Grid& grid) : grid_(&grid) {}

  /// The level of the leaves at the place of a cell: the cell's own level, a coarser one, or the next finer one.
  /// Periodic images count as their originals; for other cells outside the grid, returns -1.
  int levelAt(int level, const Index<D>& cell) const { return grid_->tree().levelAt(blockOf(level, cell)); }
  bool isThere(int level, const Index<D>& cell) const { return levelAt(level, cell) == level; }
  bool areInOneBlock(const Index<D>& a, const Index<D>& b) const { return blockOf(0, a).at == blockOf(0, b).at; }

 private:
  grid::BlockId blockOf(int level, const Index<D>& cell) const {
    grid::BlockId block{level, {}};
    for (int d = 0; d < D; ++d) {
      const int cells = grid_->blockCells()[d];
      block.at[d] = cell[d] >= 0 ? cell[d] / cells : -((cells - 1 - cell[d]) / cells);
    }
    return block;
  }

  const grid::Grid* grid_;
};

/// Interpolates a field along a face that has finer cells on its other side. It uses a polynomial through cells of the
/// coarser level, of second degree along each axis of the face, with the mixed term of these axes. Where a neighbour
/// does not exist on this level, next to refined cells or at sides of the grid, cells on the opposite side are used
/// instead.
template <int D>
class FaceInterpolation {
 public:
  explicit FaceInterpolation(const LeafCells<D>& leaves) : leaves_(leaves) {}

  /// Calls `visit(cell, weight)` for each term of the value at the centre of `cell` plus `shift` cell widths; the shift
  /// along the axis `normal` is ignored.
  template <class Visit>
  void forEachTerm(int level, const Index<D>& cell, int normal, const std::array<double, D>& shift,
                   Visit&& visit) const {
    double own = 1;
    for (int d = 0; d < D; ++d)
      if (d != normal) own += addAlong(level, cell, d, shift[d], visit);
    if constexpr (D == 3) own += addMixed(level, cell, (normal + 1) % 3, (normal + 2) % 3, shift, visit);
    visit(cell, own);
  }

 private:
  /// Visits the neighbours along an axis; returns the amount to be added to the cell's own weight.
  template <class Visit>
  double addAlong(int level, const Index<D>& cell, int d, double s, Visit&& visit) const {
    const Index<D> one = Index<D>::unit(d);
    const bool below = leaves_.isThere(level, cell - one), above = leaves_.isThere(level, cell + one);
    if (below && above) {
      visit(cell - one, s * (s - 1) / 2);
      visit(cell + one, s * (s + 1) / 2);
      return -s * s;
    }
    if (!below && !above) return 0;
    const Index<D> inwards = above ? one : one * -1;
    const double u = above ? s : -s;
    if (!leaves_.isThere(level, cell + inwards * 2)) {
      visit(cell + inwards, u);
      return -u;
    }
    visit(cell + inwards, u * (2 - u));
    visit(cell + inwards * 2, u * (u - 1) / 2);
    return (u - 1) * (u - 2) / 2 - 1;
  }
  /// Visits the cells in the term s_a s_b times the mixed difference. The difference is the mean over those corners of
  /// the cell at which all other cells exist.
  template <class Visit>
  double addMixed(int level, const Index<D>& cell, int a, int b, const std::array<double, D>& shift,
                  Visit&& visit) const {
    std::array<std::array<Index<D>, 2>, 4> corners;
    std::array<double, 4> signs{};
    std::size_t count = 0;
    for (const int p : {-1, 1})
      for (const int q : {-1, 1}) {
        const Index<D> alongA = Index<D>::unit(a) * p, alongB = Index<D>::unit(b) * q;
        if (!leaves_.isThere(level, cell + alongA) || !leaves_.isThere(level, cell + alongB) ||
            !leaves_.isThere(level, cell + alongA + alongB))
          continue;
        corners[count] = {alongA, alongB};
        signs[count++] = p * q;
      }
    double own = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double weight = signs[k] * shift[a] * shift[b] / static_cast<double>(count);
      const auto& [alongA, alongB] = corners[k];
      visit(cell + alongA + alongB, weight);
      visit(cell + alongA, -weight);
      visit(cell + alongB, -weight);
      own += weight;
    }
    return own;
  }

  const LeafCells<D>& leaves_;
};

}  // namespace tushar::numerics
