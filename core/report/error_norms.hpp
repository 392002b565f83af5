#pragma once

#include <optional>
#include <vector>

#include "core/simulation/analysis.hpp"
#include "core/simulation/report.hpp"

namespace tushar::simulation {

/// The norms of an error, from the numbers of its reduction. Left out are those of nothing: where no place was
/// measured, and errors relative to a field that is 0 everywhere.
ErrorNorms normsOf(const MeasuredError& error, const std::vector<double>& values);

/// A sentence on the first norm that is not finite: the end of such a run cannot be measured. None if all are.
std::optional<std::string> unmeasurable(const std::vector<ErrorNorms>& errors);

}  // namespace tushar::simulation
