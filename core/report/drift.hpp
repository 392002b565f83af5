#pragma once

#include <string>
#include <vector>

#include "core/report/report.hpp"

namespace tushar::report {

/// The change of a total of one component, or of as many as the grid has axes, from `before` to `after` in `unit`. Of a
/// vector, start, end and change are magnitudes.
Drift driftOf(const std::string& name, const std::vector<double>& before, const std::vector<double>& after,
              const std::string& unit);

}  // namespace tushar::report
