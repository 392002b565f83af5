#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::simulation {

/// `exactSolution`: errors of any scalar cell or node variable against a formula in x, y, z and t.
AnalysisKind exactSolutionKind();

}  // namespace tushar::simulation
