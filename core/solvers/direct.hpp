#pragma once

#include "core/solvers/solver.hpp"

// Solves on one rank by LU factors, without PETSc, which takes a third of a second to load.

namespace tushar::solvers {

/// Whether a solve needs no PETSc: direct, or automatic and small; one rank, no PETSc options, no free constant.
bool isDirect(const Unknowns& unknowns, const LinearSettings& settings);

Outcome solveDirectly(const Unknowns& unknowns, const LinearProblem& problem, std::span<double> x);
Outcome solveDirectly(const Unknowns& unknowns, NonlinearProblem& problem, const NewtonSettings& settings,
                      std::span<double> u);

}  // namespace tushar::solvers
