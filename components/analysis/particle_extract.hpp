#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/simulation/catalogue.hpp"

namespace tushar::analysis {

/// `particleExtract`: writes variables of the particles of one material whose p.color is above a threshold, over time.
/// Each particle has a file, `particleExtract/L-0/<p.particleID>` in the archive, as in Uintah. It begins with a line
/// of names; then there is a line for every sample, with the time, the position and the variables: scalars first, then
/// vectors, then tensors by rows.
simulation::AnalysisKind particleExtractKind();

/// Particle variables.
using Columns = std::vector<std::reference_wrapper<const output::Array>>;

/// The first line of a file: the names of the columns of particle variables.
std::string extractHeader(const Columns& columns);
/// The line for particle `entry`: the time [s], p.x (which is the first column), and the other variables.
std::string extractLine(double time, const Columns& columns, std::size_t entry);

}  // namespace tushar::analysis
