#include <algorithm>

#include "core/solvers/petsc_objects.hpp"
#include "core/solvers/stopwatch.hpp"
#include "core/solvers/tolerances.hpp"

namespace tushar::solvers {

namespace {

/// The duration of `work` [s].
template <class Work>
double timed(Work&& work) {
  const Stopwatch watch;
  work();
  return watch.seconds();
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

/// Makes tolerances relative to `scale` as well as to |b| (see Tolerances). Only a residual far beyond `scale` is
/// divergent: beside a right-hand side of round-off, a solution of round-off may start from a guess that is not 0.
void relateToScale(double scale, Vec b, KSP krylov) {
  PetscReal size = 0, tolerance = 0, divergence = 0;
  PetscInt iterations = 0;
  if (scale <= 0) return;
  check(VecNorm(b, NORM_2, &size));
  check(KSPGetTolerances(krylov, &tolerance, nullptr, &divergence, &iterations));
  const Tolerances tolerances = Tolerances::of(tolerance, scale, size);
  if (size > 0) divergence *= std::max(1.0, scale / size);
  check(KSPSetTolerances(krylov, tolerances.relative, tolerances.absolute, divergence, iterations));
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
  configure(krylov, settings, "cg");
  relateToScale(problem.scale, b, krylov);
  outcome.setup = timed([&] { check(KSPSetUp(krylov)); });
  outcome.solve = timed([&] { check(KSPSolve(krylov, b, solution)); });
  if (free) check(MatNullSpaceRemove(free, solution));
  note(outcome, krylov);
  if (!outcome.converged) outcome.worst = worstRow(matrix, b, solution);
  return outcome;
}

}  // namespace tushar::solvers
