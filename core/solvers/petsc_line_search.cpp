#include <cmath>

#include "core/solvers/newton_rules.hpp"
#include "core/solvers/petsc_objects.hpp"

namespace tushar::solvers {

namespace {

Trial tryStep(SNESLineSearch search, double length) {
  SNES snes = nullptr;
  Vec u = nullptr, r = nullptr, step = nullptr, there = nullptr, residual = nullptr;
  check(SNESLineSearchGetSNES(search, &snes));
  check(SNESLineSearchGetVecs(search, &u, &r, &step, &there, &residual));
  check(VecWAXPY(there, -length, step, u));
  check(SNESComputeFunction(snes, there, residual));
  Trial trial{length, 0, false};
  check(VecDot(residual, step, &trial.slope));
  trial.isFinite = std::isfinite(trial.slope);
  return trial;
}

}  // namespace

PetscErrorCode searchAlongStep(SNESLineSearch search, void* context) {
  return guarded(*static_cast<std::exception_ptr*>(context), [&] {
    Vec u = nullptr, r = nullptr, step = nullptr, there = nullptr, residual = nullptr;
    check(SNESLineSearchGetVecs(search, &u, &r, &step, &there, &residual));
    double slope = 0;
    check(VecDot(r, step, &slope));
    const Trial trial = chooseStep(slope, [search](double length) { return tryStep(search, length); });
    check(SNESLineSearchSetLambda(search, trial.length));
    check(SNESLineSearchSetReason(search, trial.isFinite ? SNES_LINESEARCH_SUCCEEDED : SNES_LINESEARCH_FAILED_REDUCT));
    check(VecCopy(there, u));
    check(VecCopy(residual, r));
    check(SNESLineSearchComputeNorms(search));
  });
}

}  // namespace tushar::solvers
