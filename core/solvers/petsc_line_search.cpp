#include <cmath>

#include "core/solvers/petsc_objects.hpp"

namespace tushar::solvers {

namespace {

/// A trial point u - length step along a Newton step.
struct Trial {
  double length = 1;
  double slope = 0;  ///< slope r . step at this point: the derivative of the energy along the step
  bool isFinite = false;
};

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

/// Halves the length until the residual is finite and the slope is smaller than at the start, because steps in a
/// perfectly plastic solid can be far too long. (The point where the secant of the slope is 0 would be too far back.)
Trial chooseStep(SNESLineSearch search, double slopeAtStart) {
  Trial trial = tryStep(search, 1);
  while (!(trial.isFinite && std::abs(trial.slope) <= 0.8 * std::abs(slopeAtStart)) && trial.length > 1e-3)
    trial = tryStep(search, trial.length / 2);
  return trial;
}

}  // namespace

PetscErrorCode searchAlongStep(SNESLineSearch search, void* context) {
  return guarded(*static_cast<std::exception_ptr*>(context), [&] {
    Vec u = nullptr, r = nullptr, step = nullptr, there = nullptr, residual = nullptr;
    check(SNESLineSearchGetVecs(search, &u, &r, &step, &there, &residual));
    double slope = 0;
    check(VecDot(r, step, &slope));
    const Trial trial = chooseStep(search, slope);
    check(SNESLineSearchSetLambda(search, trial.length));
    check(SNESLineSearchSetReason(search, trial.isFinite ? SNES_LINESEARCH_SUCCEEDED : SNES_LINESEARCH_FAILED_REDUCT));
    check(VecCopy(there, u));
    check(VecCopy(residual, r));
    check(SNESLineSearchComputeNorms(search));
  });
}

}  // namespace tushar::solvers
