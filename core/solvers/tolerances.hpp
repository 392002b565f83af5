#pragma once

#include <algorithm>

namespace tushar::solvers {

/// When a Krylov method has converged.
struct Tolerances {
  static constexpr double least = 1e-15;

  double relative;  ///< tolerance for the residual, relative to |b|
  double absolute;  ///< tolerance for the residual

  /// `size` is |b|. If `scale` is greater than 0, the tolerance is relative to it as well as to |b|, but never below
  /// the rounding error. A residual that is the rounding error of `scale` ends the solve.
  static Tolerances of(double relative, double scale, double size) {
    if (scale <= 0) return {relative, 0};
    if (size > scale) relative = std::max(relative * scale / size, std::min(relative, least));
    return {relative, least * scale};
  }
};

}  // namespace tushar::solvers
