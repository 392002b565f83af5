#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::solvers {

/// The unknowns of a system that a rank uses: one block per cell or node. A rank first numbers the blocks that it owns,
/// from 0, then those of other ranks that it needs.
struct Unknowns {
  const mpi::Communicator* ranks = &mpi::Communicator::alone();  ///< the ranks that solve together
  int block = 1;                                                 ///< number of unknowns in a block
  int owned = 0;                                                 ///< number of blocks that this rank owns
  std::vector<int> ghosts;   ///< global indices of the blocks of other ranks; blocks are numbered rank by rank
  std::vector<int> entries;  ///< for each owned block row, the largest number of nonzero blocks
  /// The positions of the owned blocks, `block` numbers each [m], from which multigrid derives the rigid-body modes of
  /// a solid. If empty, there are no such modes.
  std::vector<double> coordinates;
  int axes = 3;  ///< number of axes along which the unknowns are spread
  /// Whether adding a constant to a solution gives another solution; then the one with mean 0 is chosen.
  bool constantIsFree = false;
};

/// A matrix that is being assembled.
class Matrix {
 public:
  virtual ~Matrix() = default;
  /// Adds `values`, row by row, at block rows and block columns; negative indices are skipped.
  virtual void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) = 0;
};

/// Settings for linear systems, with PETSc's names. The solver `automatic` factorizes a small system on one rank, and
/// takes a Krylov method for others: gmres in Newton's method, and otherwise cg. The preconditioner `multigrid` is
/// BoxMultigrid for the cells of a grid of one level, and otherwise hypre.
struct LinearSettings {
  std::string solver = "cg", preconditioner = "multigrid";
  double tolerance = 1e-10;  ///< tolerance: largest residual, relative to the right-hand side
  int maxIterations = 1000;
  std::string petsc;  ///< further options, in PETSc's syntax
};

/// The outcome of a solve.
struct Outcome {
  bool converged = false;
  std::string reason;             ///< why the solve ended, in words and with PETSc's name
  int newtonIterations = 0;       ///< number of Newton iterations; 0 for a linear solve
  int krylovIterations = 0;       ///< total number of Krylov iterations
  std::vector<double> residuals;  ///< residual norms at the start and after each iteration; for a nonlinear solve,
                                  ///< after each Newton iteration
  /// Residual norms of the linear solve whose failure ended Newton's method, if there was one.
  std::vector<double> krylovResiduals;
  int worst = -1;  ///< index of the unknown with the largest residual at the end; -1 if it is on another rank
  double assembly = 0, setup = 0, solve = 0;  ///< time for matrix, preconditioner and iterations [s]
  /// If the solution is unique up to a constant: the sum of b, which was subtracted before the solve, and the sum of
  /// |b|.
  double unbalanced = 0, loads = 0;
};

/// A linear system A x = b.
struct LinearProblem {
  std::function<void(Matrix&)> assemble;  ///< fills A; may also fill b
  std::span<const double> rightHandSide;  ///< b for the owned unknowns; read after A has been filled
  /// If this value is greater than 0 and less than |b|, the tolerance is relative to it.
  double scale = 0;
};

/// A nonlinear system r(u) = 0.
class NonlinearProblem {
 public:
  virtual ~NonlinearProblem() = default;
  /// Computes r(u); the ghosts of r are added to the rows of other ranks. Returns false if the residual is undefined
  /// for this u, so that a smaller step must be tried.
  virtual bool residual(std::span<const double> u, std::span<double> r) = 0;
  /// Computes dr/du at the u of the latest call of residual().
  virtual void tangent(Matrix& matrix) = 0;
  /// Whether r(u) of the owned unknowns is only rounding error; same result on all ranks.
  virtual bool isNegligible(std::span<const double> /*u*/, std::span<const double> /*r*/) const { return false; }
};

/// Convergence criteria of Newton's method, as in Uintah's implicit MPM.
struct NewtonSettings {
  LinearSettings linear{"automatic", "gamg", 1e-8, 1000, ""};
  /// Tolerance for the square of the last change of u, relative to the square of the largest change.
  double displacement = 1e-10;
  /// Tolerance for the last change of u times the residual before it, relative to the first such product.
  double energy = 4e-10;
  int maxIterations = 25;
};

/// Solves systems of equations. The only implementation is in a library that is loaded when a scene first needs it.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Solves a linear system from the initial guess in `x`, the owned unknowns, by a Krylov method. Throws
  /// std::runtime_error for options that PETSc refuses.
  virtual Outcome solve(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
                        std::span<double> x) const = 0;
  /// Solves a nonlinear system from the initial guess in `u` (owned unknowns and ghosts) by Newton's method with line
  /// search. Throws the exceptions of the problem.
  virtual Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                        std::span<double> u) const = 0;
  /// See the free function of the same name.
  virtual void addUp(const Unknowns& unknowns, std::span<double> values) const = 0;
  virtual std::vector<std::string> unusedOptions() const = 0;
  virtual std::string version() const = 0;
};

/// Solves a linear system as Solver::solve does; loads PETSc only if that is needed (see direct.hpp).
Outcome solve(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
              std::span<double> x);
/// Solves a nonlinear system as Solver::solve does; loads PETSc only if that is needed.
Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings, std::span<double> u);

/// Replaces the values of own blocks and ghosts by their sums over all ranks.
void addUp(const Unknowns& unknowns, std::span<double> values);

/// Whether a scene has needed the solver so far.
bool isLoaded();
/// PETSc options that have not been used by any solve so far.
std::vector<std::string> unusedOptions();

/// The version of PETSc, or the reason why it cannot be loaded.
std::string petscVersion();

/// The solver; loads PETSc at the first call. Throws std::runtime_error if the library is missing.
const Solver& solver();

/// A message that `what` did not converge, with the residuals and the reason.
std::string sentenceOf(const std::string& what, const Outcome& outcome);

}  // namespace tushar::solvers
