#include <algorithm>
#include <chrono>

#include "core/solvers/petsc_objects.hpp"

namespace tushar::solvers {

namespace {

constexpr double leastTolerance = 1e-15;

/// The duration of `work` [s].
template <class Work>
double timed(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The row with the largest |b - A x|.
int worstRow(Mat matrix, Vec b, Vec x) {
  OwnedVec residual;
  check(VecDuplicate(b, residual.address()));
  check(MatMult(matrix, x, residual));
  check(VecAYPX(residual, -1, b));
  return worstOf(residual);
}

void note(Outcome& outcome, KSP krylov) {
  KSPConvergedReason reason;
  PetscInt iterations = 0;
  check(KSPGetConvergedReason(krylov, &reason));
  check(KSPGetIterationNumber(krylov, &iterations));
  outcome.converged = reason > 0;
  outcome.reason = reasonOf(reason);
  outcome.krylovIterations = static_cast<int>(iterations);
  outcome.residuals = residualsOf(krylov);
}

/// Removes the part of b that no solution can balance.
void balance(Outcome& outcome, MatNullSpace free, Vec b) {
  check(VecSum(b, &outcome.unbalanced));
  check(VecNorm(b, NORM_1, &outcome.loads));
  check(MatNullSpaceRemove(free, b));
}

/// The tolerance for the ratio of the residual to |b|, never below the rounding error.
double toleranceOf(const LinearProblem& problem, const LinearSettings& settings, Vec b) {
  PetscReal size = 0;
  check(VecNorm(b, NORM_2, &size));
  if (problem.scale <= 0 || size <= problem.scale) return settings.tolerance;
  return std::max(settings.tolerance * problem.scale / size, std::min(settings.tolerance, leastTolerance));
}

/// Ends the solve if the residual is the rounding error of `scale`, and compares with `scale` before it calls a
/// residual divergent: beside a right-hand side of round-off, a solution of round-off may start from a guess that is
/// not 0.
void allowRoundOff(const LinearProblem& problem, const LinearSettings& settings, Vec b, KSP krylov) {
  if (problem.scale <= 0) return;
  PetscReal size = 0, divergence = 0;
  PetscInt iterations = 0;
  check(VecNorm(b, NORM_2, &size));
  check(KSPGetTolerances(krylov, nullptr, nullptr, &divergence, &iterations));
  if (size > 0) divergence *= std::max(1.0, problem.scale / size);
  check(KSPSetTolerances(krylov, settings.tolerance, leastTolerance * problem.scale, divergence, iterations));
}

}  // namespace

Outcome solveLinear(const Unknowns& unknowns, const LinearProblem& problem, const LinearSettings& settings,
                    std::span<double> x) {
  const PetscOptionsOfSolve options(settings.petsc);
  Outcome outcome;
  PetscMatrix matrix(unknowns);
  outcome.assembly = timed([&] { matrix.assemble(problem.assemble); });
  std::vector<double> right(problem.rightHandSide.begin(), problem.rightHandSide.end());
  const PetscVector b(unknowns, right), solution(unknowns, x);
  MatNullSpace free = nullptr;
  check(MatGetNullSpace(matrix, &free));
  if (free) balance(outcome, free, b);
  OwnedKsp krylov;
  check(KSPCreate(mpi::handleOf(*unknowns.ranks), krylov.address()));
  check(KSPSetOperators(krylov, matrix, matrix));
  check(KSPSetInitialGuessNonzero(krylov, settings.solver == "preonly" ? PETSC_FALSE : PETSC_TRUE));
  check(KSPSetResidualHistory(krylov, nullptr, settings.maxIterations + 1, PETSC_TRUE));
  LinearSettings used = settings;
  used.tolerance = toleranceOf(problem, settings, b);
  configure(krylov, used, "cg");
  allowRoundOff(problem, used, b, krylov);
  outcome.setup = timed([&] { check(KSPSetUp(krylov)); });
  outcome.solve = timed([&] { check(KSPSolve(krylov, b, solution)); });
  if (free) check(MatNullSpaceRemove(free, solution));
  note(outcome, krylov);
  if (!outcome.converged) outcome.worst = worstRow(matrix, b, solution);
  return outcome;
}

}  // namespace tushar::solvers
