#pragma once

#include <string>
#include <vector>

#include "core/tasks/validate.hpp"

namespace tushar::tasks {

/// A task that a scene does not need, and the reason.
struct LeftOut {
  std::string task;
  std::string reason;
};

/// The kept tasks of a list, and the variables that they need.
struct Pruned {
  std::vector<Task> kept;
  std::vector<LeftOut> leftOut;
  /// Variables that must exist at the end: the requested ones and, if the list is repeated, those that it reads from
  /// the previous run.
  Names needed;
  /// `liveAfter[t]`: variables of the current step that are read after task t, one of the kept tasks.
  std::vector<Names> liveAfter;
};

/// Step 2 of compiling: omits each task whose results do not contribute to a requested variable, and each offered
/// output of kept tasks that nothing reads (AccessKind::leftOut).
///
/// `wanted` lists what is read after the end of the list: saved variables, the state that other lists require,
/// reductions. `repeated` lists are run step after step, so the old state that their own tasks require is wanted as
/// well.
Pruned prune(const std::vector<Task>& tasks, const Names& wanted, bool repeated);

/// Names of the variables of the old state that the tasks read.
Names requiredOfState(const std::vector<Task>& tasks);

}  // namespace tushar::tasks
