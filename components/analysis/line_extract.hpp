#pragma once

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `lineExtract`: writes variables on lines along the axes over time. Each cell has a file, such as
/// `<line>/L-0/i4_j0_k0` in the archive, where Uintah writes it. A line of the file has the position, the step number,
/// the time [s] and the variables: cell variables before node variables, and among them scalars, then vectors, then
/// tensors by rows.
simulation::AnalysisKind lineExtractKind();

}  // namespace tushar::analysis
