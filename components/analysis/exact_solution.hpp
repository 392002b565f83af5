#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `exactSolution`: computes errors of a scalar cell or node variable (of the state or the diagnostics) that belongs to
/// no material, relative to a formula in x, y, z and t.
simulation::AnalysisKind exactSolutionKind();

}  // namespace tushar::analysis
