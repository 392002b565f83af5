#pragma once

#include <string>
#include <vector>

#include "core/tasks/prune.hpp"
#include "core/tasks/task_list.hpp"

namespace tushar::simulation {

/// The variables that must exist after the start: those that a step needs, except saved ones that only steps compute.
inline tasks::Names neededAtStart(const tasks::Pruned& step, const tasks::TaskList& initialize) {
  const tasks::Names started = tasks::producedBy(initialize.tasks()), read = tasks::requiredOfState(step.kept);
  tasks::Names needed;
  for (const std::string& name : step.needed)
    if (started.contains(name) || read.contains(name)) needed.insert(name);
  return needed;
}

/// The variables that must exist after a restart, sorted: the state, and those of the `lasting` ones that steps read.
inline std::vector<std::string> neededAfterRestart(const std::vector<std::string>& state,
                                                   const std::vector<std::string>& lasting, const tasks::Names& read) {
  tasks::Names needed(state.begin(), state.end());
  for (const std::string& name : lasting)
    if (read.contains(name)) needed.insert(name);
  return {needed.begin(), needed.end()};
}

}  // namespace tushar::simulation
