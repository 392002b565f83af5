#pragma once

#include <array>
#include <deque>

#include "core/numerics/diffusion.hpp"
#include "core/numerics/leaf_cells.hpp"

namespace tushar::numerics {

/// div(k grad phi) by finite volumes over all levels of a grid, for linear systems. Between cells of equal width, and
/// at the sides of the grid, it is identical to Diffusion. A face between levels is divided into the faces of the finer
/// cells. With the resistance R = h/2 / k(-h/4) + h / k(h/2) between the centres of the finer and the coarser cell, the
/// outward flux through each of them is
///
///     F = 4/5 (phi* - phi_1) / R + 1/5 k_12 (phi_1 - phi_2) / h,
///
/// where phi_1 is the value in the finer cell at the face, phi_2 the value in the next finer cell behind it, phi* the
/// value in the coarser cell, interpolated along the face to the line through both finer cells (FaceInterpolation), and
/// h the width of the finer cells. For constant k, F / k is the slope at the face of the parabola through the three
/// values (Martin & Cartwright, Solving Poisson's Equation Using Adaptive Mesh Refinement, 1996), which is of second
/// order. The flux remains of second order if k varies, and is correct if k jumps at the face. Both cells use the same
/// F, so the scheme is conservative. The system is not symmetric.
template <int D>
class CompositeDiffusion {
 public:
  /// `k` is a formula in space and must be greater than 0; grid and formula must outlive this object.
  CompositeDiffusion(const grid::Grid& grid, const input::Expression& k, const grid::BoundaryLabel<double>& phi)
      : grid_(grid), leaves_(grid) {
    for (int level = 0; level < grid.levels(); ++level) ofLevels_.emplace_back(grid.level(level), k, phi);
  }

  /// The integral of div(k grad phi) over a cell, which must be neither refined nor part of a coarser one.
  Balance<D> balance(int level, const Index<D>& cell) const {
    const Diffusion<D>& diffusion = on(level);
    if (grid_.levels() == 1) return diffusion.balance(cell);
    const double own = diffusion.inCell(cell);
    Balance<D> balance;
    balance.level = level;
    balance.cells[0] = cell;
    diffusion.forEachFace(cell, [&](int d, int side, const Index<D>& next, bool isInside) {
      if (!isInside) return diffusion.addSide(d, side, balance);
      const int there = leaves_.areInOneBlock(cell, next) ? level : leaves_.levelAt(level, next);
      if (there == level)
        diffusion.addNext(own, d, next, balance);
      else if (there < level)
        addRim(level, cell, d, side, 1, balance);
      else
        forEachFiner(next, d, side, [&](const Index<D>& fine) { addRim(level + 1, fine, d, 1 - side, -1, balance); });
    });
    return balance;
  }

 private:
  const Diffusion<D>& on(int level) const { return ofLevels_[level]; }

  /// For a cell whose neighbour `next` on side `side` along axis d is refined, calls `visit` for the finer cells inside
  /// `next` that touch the face between the two.
  template <class Visit>
  static void forEachFiner(const Index<D>& next, int d, int side, Visit&& visit) {
    for (int k = 0; k < (1 << D); ++k) {
      Index<D> fine;
      for (int axis = 0; axis < D; ++axis) fine[axis] = 2 * next[axis] + ((k >> axis) & 1);
      if (((k >> d) & 1) != side) visit(fine);
    }
  }

  /// Adds `factor` times the flux A F through the face between a cell and the coarser cell next to it on side `side`.
  void addRim(int level, const Index<D>& fine, int d, int side, double factor, Balance<D>& balance) const {
    const Diffusion<D>& diffusion = on(level);
    const grid::Level& here = grid_.level(level);
    const Index<D> outwards = Index<D>::unit(d) * (side == 0 ? -1 : 1), next = fine + outwards, back = fine - outwards;
    const double h = here.spacing(d), area = factor * here.cellVolume() / h;
    const double resistance = h / 2 / nearFace(level, fine, d, side) + h / diffusion.inCell(next);
    const double over = 0.8 * area / resistance;
    const double within = 0.2 * area * harmonicMean(diffusion.inCell(fine), diffusion.inCell(back)) / h;
    balance.add(level, fine, within - over);
    balance.add(level, back, -within);
    Index<D> coarse;
    std::array<double, D> shift;
    for (int axis = 0; axis < D; ++axis) {
      coarse[axis] = grid::coarserCell(next[axis]);
      shift[axis] = next[axis] == 2 * coarse[axis] ? -0.25 : 0.25;
    }
    FaceInterpolation<D>(leaves_).forEachTerm(level - 1, coarse, d, shift, [&](const Index<D>& cell, double weight) {
      balance.add(level - 1, cell, over * weight);
    });
  }
  /// The value of k halfway between the centre of a cell and one of its faces.
  double nearFace(int level, const Index<D>& cell, int d, int side) const {
    const grid::Level& here = grid_.level(level);
    Vec<D> x = here.template cellCentre<D>(here.template wrapped<D>(cell));
    x[d] += (side == 0 ? -0.25 : 0.25) * here.spacing(d);
    return on(level).k_(here.template expandPoint<D>(x));
  }

  const grid::Grid& grid_;
  LeafCells<D> leaves_;
  std::deque<Diffusion<D>> ofLevels_;  ///< stencil of each level, the coarsest first
};

}  // namespace tushar::numerics
