#pragma once

#include "core/solvers/solver.hpp"

namespace tushar::solvers {

/// The settings for a nonsymmetric system: cg is replaced by gmres, and cholesky by lu.
inline LinearSettings withoutSymmetry(LinearSettings settings) {
  if (settings.solver == "cg" || settings.solver == "automatic") settings.solver = "gmres";
  if (settings.preconditioner == "cholesky") settings.preconditioner = "lu";
  return settings;
}

}  // namespace tushar::solvers
