#pragma once

#include <optional>
#include <vector>

#include "core/report/measured.hpp"
#include "core/report/report.hpp"

namespace tushar::report {

/// The norms of an error, from the numbers of its reduction. Undefined norms are omitted: those over no points, and
/// those relative to a field that is 0 everywhere.
ErrorNorms normsOf(const MeasuredError& error, const std::vector<double>& values);

/// A message about the first norm that is not finite, because such a run has no valid errors; none if all are finite.
std::optional<std::string> unmeasurable(const std::vector<ErrorNorms>& errors);

}  // namespace tushar::report
