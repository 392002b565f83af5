#pragma once

#include <algorithm>
#include <cmath>

#include "core/solvers/solver.hpp"

// What Newton's method does in a solve by PETSc as well as in one without it.

namespace tushar::solvers {

/// A trial point u - length step along a Newton step.
struct Trial {
  double length = 1;
  double slope = 0;  ///< slope r . step at this point: the derivative of the energy along the step
  bool isFinite = false;
};

/// The line search of Newton's method, based on the energy (Crisfield, Non-linear Finite Element Analysis, 9.2).
/// Halves the length until the residual is finite and the slope is smaller than at the start, because steps in a
/// perfectly plastic solid can be far too long. (The point where the secant of the slope is 0 would be too far back.)
/// `tryStep(length)` returns the Trial at this length.
template <class TryStep>
Trial chooseStep(double slopeAtStart, TryStep&& tryStep) {
  Trial trial = tryStep(1.0);
  while (!(trial.isFinite && std::abs(trial.slope) <= 0.8 * std::abs(slopeAtStart)) && trial.length > 1e-3)
    trial = tryStep(trial.length / 2);
  return trial;
}

/// Whether the changes of u have become small: |du|² <= displacement max |du|² and |du . r| <= energy |du . r| of the
/// first iteration, with the residual r before the change.
class SmallChanges {
 public:
  explicit SmallChanges(const NewtonSettings& settings) : settings_(settings) {}
  /// Adds the change of an iteration, counted from 1: |du|² and du . r.
  bool after(int iteration, double square, double energy) {
    greatest_square_ = std::max(greatest_square_, square);
    if (iteration == 1) first_energy_ = std::abs(energy);
    return square <= settings_.displacement * greatest_square_ && std::abs(energy) <= settings_.energy * first_energy_;
  }

 private:
  const NewtonSettings& settings_;
  double greatest_square_ = 0, first_energy_ = 0;
};

}  // namespace tushar::solvers
