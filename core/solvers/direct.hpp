#pragma once

#include <optional>

#include "core/solvers/solver.hpp"

// Solves on one rank by LU factors, without PETSc, which takes a third of a second to load.

namespace tushar::solvers {

/// Whether a solve needs no PETSc: direct, or automatic and small; one rank, no PETSc options, no free constant.
bool isDirect(const Unknowns& unknowns, const LinearSettings& settings);

/// Solves by LU factors. Returns nothing, and leaves the unknowns as they were, if the solver is automatic and a matrix
/// is singular or nearly so. Krylov methods solve such systems, too, if they have a solution: for example where a cell
/// contains a single particle, which does not feel all motions of its nodes.
std::optional<Outcome> solveDirectly(const Unknowns& unknowns, const LinearProblem& problem,
                                     const LinearSettings& settings, std::span<double> x);
std::optional<Outcome> solveDirectly(const Unknowns& unknowns, NonlinearProblem& problem,
                                     const NewtonSettings& settings, std::span<double> u);

}  // namespace tushar::solvers
