#pragma once

#include <string>
#include <vector>

#include "core/report/report.hpp"

namespace tushar::report {

/// The change of a total from `before` to `after` in `unit`. The total has one component, or one for each axis of the
/// grid. For a vector, start, end and change are magnitudes. The change is relative to the start, unless the start is
/// round-off: less than 1e-12 of the change or of `scale`, the size of the terms that add up to the total. Less than
/// 1e-45 of `scale` counts as no change: sums have 48 digits, and if terms cancel beyond that, the rest depends on
/// their order.
Drift driftOf(const std::string& name, const std::vector<double>& before, const std::vector<double>& after,
              const std::string& unit, double scale = 0);

}  // namespace tushar::report
