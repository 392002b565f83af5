#pragma once

#include <algorithm>
#include <optional>

#include "core/base/vec.hpp"
#include "core/data/reduction.hpp"
#include "core/solvers/solver.hpp"

namespace tushar::solvers {

// The results of a solve that a scene may save.
inline constexpr data::ReductionLabel<data::Maximum> assemblyTime{"AssemblyTime", "s",
                                                                  "time to fill the matrix of the last solve"};
inline constexpr data::ReductionLabel<data::Maximum> preconditionerTime{
    "PreconditionerTime", "s", "time to build the preconditioner of the last solve"};
inline constexpr data::ReductionLabel<data::Maximum> solveTime{"SolveTime", "s",
                                                               "time for the iterations of the last solve"};

inline void addTimes(const Outcome& outcome, data::Maximum& assembly, data::Maximum& preconditioner,
                     data::Maximum& solve) {
  assembly.add(outcome.assembly);
  preconditioner.add(outcome.setup);
  solve.add(outcome.solve);
}

/// The ratio of the final residual to the largest one during the solve; 0 if there was none.
inline double remainderOf(const Outcome& outcome) {
  const double greatest =
      outcome.residuals.empty() ? 0 : *std::max_element(outcome.residuals.begin(), outcome.residuals.end());
  return greatest > 0 ? outcome.residuals.back() / greatest : 0;
}

/// Returns the position of the largest residual, as the end of a sentence, on all ranks. `mine` [m] is this position on
/// the rank that owns the residual, and empty on the others.
std::string worstPlace(const mpi::Communicator& ranks, const std::optional<Vec3>& mine, const std::string& what);

}  // namespace tushar::solvers
