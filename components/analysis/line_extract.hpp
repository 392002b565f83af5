#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `lineExtract`: writes variables on lines along the axes over time, one file per cell: `<line>/L-0/i4_j0_k0` in the
/// archive,
/// where Uintah writes them. A line has the place, the number of the step, the time [s] and the variables: of cells
/// before those of nodes, numbers before vectors, these before tensors by rows.
simulation::AnalysisKind lineExtractKind();

}  // namespace tushar::analysis
