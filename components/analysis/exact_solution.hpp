#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `exactSolution`: errors of a scalar cell or node variable without a material, of the state or of the diagnostics,
/// relative to a formula in x, y, z and t.
simulation::AnalysisKind exactSolutionKind();

}  // namespace tushar::analysis
