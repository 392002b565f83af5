#include "core/report/drift.hpp"

#include <algorithm>
#include <cmath>

namespace tushar::report {

Drift driftOf(const std::string& name, const std::vector<double>& before, const std::vector<double>& after,
              const std::string& unit, double scale) {
  constexpr double roundOff = 1e-12, roundOffOfSums = 1e-45;
  double start = 0, end = 0, change = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    start += before[i] * before[i];
    end += after[i] * after[i];
    change += (after[i] - before[i]) * (after[i] - before[i]);
  }
  Drift drift{name, std::sqrt(start), std::sqrt(end), std::sqrt(change), false, unit};
  if (before.size() == 1) {
    drift.start = before[0];
    drift.end = after[0];
    drift.change = after[0] - before[0];
  }
  if (std::abs(drift.change) < roundOffOfSums * scale) drift.change = 0;
  drift.relative = std::abs(drift.start) > roundOff * std::max(scale, std::abs(drift.change));
  if (drift.relative) drift.change /= std::abs(drift.start);
  return drift;
}

}  // namespace tushar::report
