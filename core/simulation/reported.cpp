#include "core/simulation/reported.hpp"

#include <algorithm>

namespace tushar::simulation {

void ReportedSoFar::addStep(Reported::Over over, const std::vector<double>& values, double dt) {
  if (!isKnown) return;
  const bool isFirst = value.empty();
  value.resize(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double added = over == Reported::Over::time ? dt * values[k] : values[k];
    if (over == Reported::Over::least)
      value[k] = isFirst ? added : std::min(value[k], added);
    else
      value[k] += added;
  }
}

}  // namespace tushar::simulation
