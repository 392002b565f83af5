#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::solvers {

/// The unknowns of a system that a rank uses, in blocks: one block for each cell or node. A rank numbers the blocks
/// that it owns from 0 on, and goes on with those of other ranks that it needs.
struct Unknowns {
  const mpi::Communicator* ranks = &mpi::Communicator::alone();  ///< the ranks that solve together
  int block = 1;                                                 ///< unknowns of a cell or node
  int owned = 0;                                                 ///< blocks of this rank
  std::vector<int> ghosts;   ///< blocks of other ranks: their numbers among the blocks of all, rank after rank
  std::vector<int> entries;  ///< of each owned block row: the most blocks that are not zero
  /// The positions of the owned blocks, `block` numbers each [m]: gives multigrid the rigid motions of a solid. Empty:
  /// none.
  std::vector<double> coordinates;
  bool constantIsFree = false;  ///< a constant added to a solution gives another: the one of mean 0 is chosen
};

/// A matrix that is being assembled.
class Matrix {
 public:
  virtual ~Matrix() = default;
  /// Adds `values`, row by row, at block rows and block columns; those with a negative number are left out.
  virtual void add(std::span<const int> rows, std::span<const int> columns, std::span<const double> values) = 0;
};

/// How linear systems are solved; the words are PETSc's.
struct LinearSettings {
  std::string solver = "cg", preconditioner = "gamg";
  double tolerance = 1e-10;  ///< residual over right-hand side
  int maxIterations = 1000;
  std::string petsc;  ///< options in PETSc's own language
};

/// The outcome of a solve.
struct Outcome {
  bool converged = false;
  std::string reason;             ///< why it ended, in words, and PETSc's word for it
  int newtonIterations = 0;       ///< 0 of a linear solve
  int krylovIterations = 0;       ///< in all
  std::vector<double> residuals;  ///< norm at the start and after each iteration; of Newton's method, if it is one
  std::vector<double> krylovResiduals;  ///< of the linear solve whose failure ended Newton's method, if one did
  int worst = -1;  ///< number of the unknown with the greatest residual at the end; -1: of another rank
  double assembly = 0, setup = 0, solve = 0;  ///< s: matrix, preconditioner, iterations
  /// Where a constant is free: the sum of b, which was taken out before the solve, and that of |b|.
  double unbalanced = 0, loads = 0;
};

/// A x = b.
struct LinearProblem {
  std::function<void(Matrix&)> assemble;  ///< fills A; may also fill b
  std::span<const double> rightHandSide;  ///< b of the owned unknowns, read once A is filled
  double scale = 0;                       ///< above 0: the tolerance is relative to this where |b| is greater
};

/// r(u) = 0.
class NonlinearProblem {
 public:
  virtual ~NonlinearProblem() = default;
  /// r(u); the ghosts of r are added to the rows of other ranks. False if there is no residual at such a u, so that a
  /// smaller step must be tried.
  virtual bool residual(std::span<const double> u, std::span<double> r) = 0;
  /// dr/du at the u of the last residual.
  virtual void tangent(Matrix& matrix) = 0;
  /// Whether r(u) of the owned unknowns is mere rounding error; the same on all ranks.
  virtual bool isNegligible(std::span<const double> /*u*/, std::span<const double> /*r*/) const { return false; }
};

/// When Newton's iteration ends, as in Uintah's implicit MPM.
struct NewtonSettings {
  LinearSettings linear{"gmres", "gamg", 1e-8, 1000, ""};
  double displacement = 1e-10;  ///< square of the last change of u over that of the greatest
  double energy = 4e-10;        ///< last change of u times the residual before it, over the first
  int maxIterations = 25;
};

/// Solves systems. There is one implementation, in a library that is loaded when a scene first needs it.
class Solver {
 public:
  virtual ~Solver() = default;
  /// Solves a linear system from the guess in `x`, the owned unknowns, by any Krylov method. Throws std::runtime_error
  /// for options that PETSc refuses.
  virtual Outcome solve(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
                        std::span<double> x) const = 0;
  /// Solves a nonlinear system from the guess in `u`, owned unknowns and ghosts, by Newton's method with line search.
  /// Throws what the problem throws.
  virtual Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                        std::span<double> u) const = 0;
  /// See the free functions of these names.
  virtual void addUp(const Unknowns& unknowns, std::span<double> values) const = 0;
  virtual std::vector<std::string> unusedOptions() const = 0;
  virtual std::string version() const = 0;
};

/// Every rank gets, for the blocks that it owns and for its ghosts, the sums over all ranks.
void addUp(const Unknowns& unknowns, std::span<double> values);

/// Whether a scene has needed the solver so far.
bool isLoaded();
/// Options for PETSc that no solve has used so far.
std::vector<std::string> unusedOptions();

/// The version of PETSc that would solve, or why it cannot be loaded.
std::string petscVersion();

/// The solver; loads PETSc at the first call. Throws std::runtime_error where the library is missing.
const Solver& solver();

/// `what` did not converge: the history of the residuals and why it ended, in a sentence.
std::string sentenceOf(const std::string& what, const Outcome& outcome);

}  // namespace tushar::solvers
