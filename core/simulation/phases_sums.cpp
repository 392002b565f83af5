#include "core/simulation/phases.hpp"

// What analysis modules add up over steps.

namespace tushar::simulation {

using tasks::Names;

void Phases::addAnalyses(const std::vector<std::unique_ptr<Analysis>>& analyses) {
  for (const auto& analysis : analyses) analysis->schedule(lists_.diagnostics);
  tasks::TaskList sums;
  for (const auto& analysis : analyses) analysis->scheduleAfterStep(sums);
  summed_ = tasks::producedBy(sums.tasks());
  if (summed_.empty()) return;
  for (const auto* list : {&lists_.diagnostics, &sums})
    for (const tasks::Task& task : list->tasks()) lists_.afterStep.add(task);
}

Names Phases::namesOfSteps() const {
  Names names = summed_;
  for (const auto* list : {&lists_.initialize, &lists_.timeAdvance}) names.merge(tasks::producedBy(list->tasks()));
  return names;
}

tasks::Pruned Phases::addSums(const Names& always, Names& atEnd) const {
  Names wanted;
  for (const std::string& name : summed_)
    if (always.contains(name) || atEnd.contains(name)) wanted.insert(name);
  tasks::Pruned sums = tasks::prune(lists_.afterStep.tasks(), wanted, true);
  atEnd.merge(tasks::requiredOfState(sums.kept));
  return sums;
}

}  // namespace tushar::simulation
