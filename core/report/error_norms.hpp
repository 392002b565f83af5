#pragma once

#include <optional>
#include <vector>

#include "core/report/measured.hpp"
#include "core/report/report.hpp"

namespace tushar::report {

/// The norms of an error, from the numbers of its reduction. Undefined norms are omitted: those over no points, and
/// those relative to a field that is 0 everywhere.
ErrorNorms normsOf(const MeasuredError& error, const std::vector<double>& values);

/// If a norm is not finite, a message that the run has no valid errors, naming the first such norm; otherwise none.
std::optional<std::string> unmeasurable(const std::vector<ErrorNorms>& errors);

}  // namespace tushar::report
