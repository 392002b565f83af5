#include <cmath>
#include <limits>

#include "core/solvers/newton_rules.hpp"
#include "core/solvers/petsc_objects.hpp"
#include "core/solvers/stopwatch.hpp"

namespace tushar::solvers {

namespace {

/// The data that PETSc's callbacks need.
struct Newton {
  NonlinearProblem& problem;
  const NewtonSettings& settings;
  PetscMatrix& matrix;
  Balance& balance;
  GhostedVector &u, &r;
  SmallChanges changes;
  OwnedVec lastU, lastResidual, change;
  bool lags = false;  ///< whether a preconditioner may serve several tangents
  double assembly = 0, setup = 0;
  double lastNorm = 0;       ///< norm of the residual of the iteration before
  PetscInt afterSetup = -1;  ///< iterations of the first linear solve with the present preconditioner; -1: not known
  std::exception_ptr thrown{};
};

PetscErrorCode evaluateResidual(SNES, Vec u, Vec r, void* context) {
  Newton& newton = *static_cast<Newton*>(context);
  return guarded(newton.thrown, [&] {
    newton.u.take(u);
    const std::span<double> residual = newton.r.values();
    // The line search backs off from infinite values.
    if (!newton.problem.residual(newton.u.values(), residual))
      std::fill(residual.begin(), residual.end(), std::numeric_limits<double>::infinity());
    newton.r.addUp(r);
  });
}

/// Whether the tangent needs a new preconditioner: the first of a step does, and later ones if the last solve took
/// half as many iterations again as the first with the present preconditioner.
bool needsPreconditioner(Newton& newton, KSP krylov, PetscInt iteration) {
  if (!newton.lags || iteration == 0) return true;
  PetscInt last = 0;
  check(KSPGetIterationNumber(krylov, &last));
  if (newton.afterSetup < 0) newton.afterSetup = last;
  return 2 * last > 3 * newton.afterSetup + 6;
}

/// Sets how accurately the linear system is solved. While Newton's method is far from the solution, more would be in
/// vain: Eisenstat & Walker, SIAM J. Sci. Comput. 17 (1996) 16, choice 2, with a factor that leaves the convergence
/// quadratic.
void setTolerance(Newton& newton, SNES snes, KSP krylov, PetscInt iteration) {
  constexpr double loosest = 1e-4, factor = 1e-2;
  PetscReal norm = 0;
  check(SNESGetFunctionNorm(snes, &norm));
  const double ratio = iteration == 0 ? 1 : norm / newton.lastNorm;
  newton.lastNorm = norm;
  const double wanted = std::min(loosest, factor * ratio * ratio);
  const LinearSettings& linear = newton.settings.linear;
  check(KSPSetTolerances(krylov, std::max(linear.tolerance, wanted), PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
}

/// Evaluates the tangent, and then sets up the preconditioner immediately, so that the time for this can be measured.
PetscErrorCode evaluateTangent(SNES snes, Vec, Mat, Mat, void* context) {
  Newton& newton = *static_cast<Newton*>(context);
  return guarded(newton.thrown, [&] {
    const Stopwatch assembly;
    KSP krylov = nullptr;
    PetscInt iteration = 0;
    check(SNESGetKSP(snes, &krylov));
    check(SNESGetIterationNumber(snes, &iteration));
    const bool isNew = needsPreconditioner(newton, krylov, iteration);
    newton.matrix.assemble([&](Matrix& matrix) { newton.problem.tangent(matrix); });
    newton.balance.scale(newton.matrix, isNew);
    newton.assembly += assembly.seconds();
    const Stopwatch setup;
    check(KSPSetOperators(krylov, newton.matrix, newton.matrix));
    check(KSPSetReusePreconditioner(krylov, isNew ? PETSC_FALSE : PETSC_TRUE));
    check(KSPSetUp(krylov));
    if (isNew) newton.afterSetup = -1;
    setTolerance(newton, snes, krylov, iteration);
    newton.setup += setup.seconds();
  });
}

bool isNegligible(Newton& newton, Vec u, Vec r) {
  newton.u.take(u);
  PetscInt count = 0;
  const PetscScalar* values = nullptr;
  check(VecGetLocalSize(r, &count));
  check(VecGetArrayRead(r, &values));
  const bool negligible = newton.problem.isNegligible(newton.u.values(), {values, static_cast<std::size_t>(count)});
  check(VecRestoreArrayRead(r, &values));
  return negligible;
}

/// Converged if the changes are small, or if only round-off is left of r after an iteration. Round-off is not tested
/// before the first iteration, because a load may be as small as the round-off of a large stiffness, but must still
/// act.
PetscErrorCode hasConverged(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal norm,
                            SNESConvergedReason* reason, void* context) {
  Newton& newton = *static_cast<Newton*>(context);
  return guarded(newton.thrown, [&] {
    Vec u = nullptr, r = nullptr;
    check(SNESGetSolution(snes, &u));
    check(SNESGetFunction(snes, &r, nullptr, nullptr));
    *reason = SNES_CONVERGED_ITERATING;
    if (!std::isfinite(norm))
      *reason = SNES_DIVERGED_FNORM_NAN;
    else if (norm == 0 || (iteration > 0 && isNegligible(newton, u, r)))
      *reason = SNES_CONVERGED_FNORM_ABS;
    if (iteration > 0) {
      PetscReal size = 0, energy = 0;
      check(VecWAXPY(newton.change, -1, newton.lastU, u));
      check(VecNorm(newton.change, NORM_2, &size));
      check(VecDot(newton.change, newton.lastResidual, &energy));
      if (newton.changes.after(static_cast<int>(iteration), size * size, energy))
        *reason = SNES_CONVERGED_SNORM_RELATIVE;
    }
    check(VecCopy(u, newton.lastU));
    check(VecCopy(r, newton.lastResidual));
  });
}

void configure(SNES snes, Newton& newton, Vec r) {
  const NewtonSettings& settings = newton.settings;
  check(SNESSetFunction(snes, r, evaluateResidual, &newton));
  check(SNESSetJacobian(snes, newton.matrix, newton.matrix, evaluateTangent, &newton));
  check(SNESSetConvergenceTest(snes, hasConverged, &newton, nullptr));
  check(SNESSetTolerances(snes, 0, 0, 0, settings.maxIterations, -1));
  check(SNESSetConvergenceHistory(snes, nullptr, nullptr, settings.maxIterations + 1, PETSC_TRUE));
  if (newton.lags) check(SNESSetLagPreconditioner(snes, -1));  // evaluateTangent decides
  SNESLineSearch search = nullptr;
  check(SNESGetLineSearch(snes, &search));
  check(SNESLineSearchSetType(search, SNESLINESEARCHSHELL));
  check(SNESLineSearchShellSetUserFunc(search, searchAlongStep, &newton.thrown));
  KSP krylov = nullptr;
  check(SNESGetKSP(snes, &krylov));
  check(SNESSetFromOptions(snes));
  check(KSPSetResidualHistory(krylov, nullptr, settings.linear.maxIterations + 1, PETSC_TRUE));
  configure(krylov, settings.linear, "gmres");
  newton.balance.attach(krylov);
}

void note(Outcome& outcome, SNES snes, Vec r) {
  SNESConvergedReason reason;
  PetscInt newton = 0, krylov = 0, count = 0;
  PetscReal* history = nullptr;
  check(SNESGetConvergedReason(snes, &reason));
  check(SNESGetIterationNumber(snes, &newton));
  check(SNESGetLinearSolveIterations(snes, &krylov));
  check(SNESGetConvergenceHistory(snes, &history, nullptr, &count));
  outcome.converged = reason > 0;
  outcome.reason = reasonOf(snes);
  outcome.newtonIterations = static_cast<int>(newton);
  outcome.krylovIterations = static_cast<int>(krylov);
  outcome.residuals.assign(history, history + count);
  if (!outcome.converged) outcome.worst = worstOf(r);
  if (reason != SNES_DIVERGED_LINEAR_SOLVE) return;
  KSP linear = nullptr;
  check(SNESGetKSP(snes, &linear));
  outcome.krylovResiduals = residualsOf(linear);
}

/// Whether an algebraic multigrid method preconditions, whose set-up costs as much as tens of iterations.
bool isMultigrid(const LinearSettings& settings) {
  return settings.preconditioner == "gamg" || settings.preconditioner == "hypre";
}

Outcome solve(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings, bool lags,
              std::span<double> u) {
  PetscMatrix matrix(unknowns);
  GhostedVector seen(unknowns), added(unknowns);
  const std::size_t owned = unknowns.block * unknowns.owned;
  std::vector<double> values(owned);
  const PetscVector solution(unknowns, u.first(owned)), r(unknowns, values);
  Balance balance(r);
  Newton newton{problem, settings, matrix, balance, seen, added, SmallChanges(settings), {}, {}, {}, lags};
  for (OwnedVec* work : {&newton.lastU, &newton.lastResidual, &newton.change})
    check(VecDuplicate(solution, work->address()));
  OwnedSnes snes;
  check(SNESCreate(mpi::handleOf(*unknowns.ranks), snes.address()));
  configure(snes, newton, r);
  const Stopwatch whole;
  const PetscErrorCode code = SNESSolve(snes, nullptr, solution);
  if (newton.thrown) std::rethrow_exception(newton.thrown);
  check(code);
  seen.take(solution);
  std::copy(seen.values().begin(), seen.values().end(), u.begin());
  Outcome outcome;
  outcome.assembly = newton.assembly;
  outcome.setup = newton.setup;
  outcome.solve = whole.seconds() - newton.assembly - newton.setup;
  note(outcome, snes, r);
  return outcome;
}

}  // namespace

/// If a linear solve fails, the step is solved once more with a new preconditioner for each tangent.
Outcome solveNewton(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                    std::span<double> u) {
  const PetscOptionsOfSolve options(settings.linear.petsc);
  const std::vector<double> guess(u.begin(), u.end());
  const bool lags = isMultigrid(settings.linear) && settings.linear.solver != "preonly";
  Outcome outcome = solve(unknowns, problem, settings, lags, u);
  if (!lags || outcome.converged || outcome.krylovResiduals.empty()) return outcome;
  std::copy(guess.begin(), guess.end(), u.begin());
  return solve(unknowns, problem, settings, false, u);
}

}  // namespace tushar::solvers
