#pragma once

#include <optional>

#include "core/solvers/box_stencil.hpp"
#include "core/solvers/solver.hpp"

// Solves systems for the cells of a box without PETSc: conjugate gradients with geometric multigrid, on threads and
// ranks that share the box (box_slabs.hpp), with the same bits for any of them. On one thread, a solve takes .2 to .7
// µs per cell, an algebraic multigrid 5 to 10 times as long (components/poisson/README.md).

namespace tushar::solvers {

/// Whether the settings ask for conjugate gradients with `multigrid` or the diagonal, without PETSc options.
bool suitsBox(const LinearSettings& settings);

/// A linear system A x = b for the cells of a box. Vectors have the layout of the matrix. Cells without an equation
/// have a diagonal of 0.
struct BoxSystem {
  explicit BoxSystem(const CellBox& box) : BoxSystem(BoxShape(box)) {}
  explicit BoxSystem(BoxShape shape) : matrix(std::move(shape)), b(matrix.diagonal), x(b) {}

  BoxStencil<double> matrix;
  std::vector<double> b, x;
  double scale = 0;             ///< see LinearProblem
  bool constantIsFree = false;  ///< see Unknowns
};

/// Where the equations of consecutive cells along the first axis are written; `links` are those through upper faces.
template <int D>
struct BoxRow {
  double *diagonal, *right;
  std::array<double*, D> links;
};

/// Replaces the initial guess x by the solution. Returns nothing, and leaves an arbitrary x, if others must try: if the
/// matrix is not positive definite or nearly singular, or its numbers differ by too many orders of magnitude. All ranks
/// that share the box call this and get the same outcome, whose `worst` counts the cells of the box, the first axis
/// fastest.
std::optional<Outcome> solve(BoxSystem& system, const LinearSettings& settings);

}  // namespace tushar::solvers
