#pragma once

#include <vector>

#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// Task `before` must precede task `after` because of the variable `label`.
struct Dependency {
  int before, after;
  std::string label;

  friend bool operator==(const Dependency&, const Dependency&) = default;
};

/// Step 3 of compiling: orders the tasks by the variables that they read and write.
///
/// A reader follows the last writer of its variable; a writer follows the last writer and all readers since then. The
/// order of the list breaks ties, so that every rank derives the same graph.
std::vector<Dependency> connect(const std::vector<Task>& tasks);

}  // namespace tushar::tasks
