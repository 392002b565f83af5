#pragma once

#include <vector>

#include "core/solvers/box_stencil.hpp"

namespace tushar::solvers {

/// Geometric multigrid for a BoxStencil with links of one sign, as a preconditioner: one V-cycle is a symmetric and
/// positive definite approximation of the inverse. It works in single precision.
///
/// Two cells along an axis become one; axes with weak links are left for coarser levels, where all are alike. The link
/// between coarse cells is half of the sum of the links between them, since their centres are twice as far apart. The
/// smoother is Chebyshev's polynomial of the fourth kind. Ranks share a level like the box, until it has few cells or
/// a slab that cannot be halved; from there on, each of them computes all cells. Sources: U. Trottenberg, C. Oosterlee
/// & A. Schueller, Multigrid (2001), 5.1; J. Lottes, Numer. Linear Algebra Appl. 30 (2023) e2518, for the smoother.
class BoxMultigrid {
 public:
  explicit BoxMultigrid(const BoxStencil<double>& matrix);

  /// z = M b, where M is about the inverse of the matrix; both have the layout of the matrix.
  void apply(const std::vector<double>& b, std::vector<double>& z);

 private:
  using Real = float;
  struct Grid {
    Grid(const BoxStencil<double>& of, double scale);
    int extent(int axis) const { return matrix.shape.extent(axis); }
    BoxStencil<Real> matrix;
    /// 1 / (diagonal times a bound of the eigenvalues of the matrix divided by its diagonal).
    std::vector<Real> inverse;
    std::vector<Real> x, r, z;          ///< solution, residual, last change of the solution
    Real linked = 0;                    ///< the largest part of a diagonal entry that links balance
    std::array<int, 3> ratio{1, 1, 1};  ///< number of cells along each axis that become one of the next level
  };

  /// Improves x for the residual r, and updates r.
  static void smooth(Grid& grid);
  static void takeResidual(const Grid& fine, Grid& coarse);
  static void correct(const Grid& coarse, Grid& fine);
  void cycle(std::size_t level);

  std::vector<Grid> levels_;
  double scale_ = 1;  ///< factor that keeps the matrix in the range of single precision
};

}  // namespace tushar::solvers
