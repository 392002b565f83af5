#include "core/simulation/reported.hpp"

#include <algorithm>

namespace tushar::simulation {

std::vector<Reported> shownOf(std::vector<Reported> all, const std::vector<std::string>& saved) {
  std::erase_if(all, [&](const Reported& one) {
    return one.onlyIfSaved && std::find(saved.begin(), saved.end(), one.label->name) == saved.end();
  });
  return all;
}

std::set<std::string, std::less<>> reductionsOf(const std::vector<Reported>& reported, bool ofSteps) {
  std::set<std::string, std::less<>> names;
  for (const Reported& one : reported)
    if (one.isOfSteps() == ofSteps) names.emplace(one.label->name);
  return names;
}

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
