#pragma once

#include <string>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// A ghost exchange for one variable: its ghosts on every patch are filled from the patches that own them.
struct GhostFill {
  const data::Label* label;
  data::Generation generation;  ///< generation of the values
  data::Generation
      set;  ///< generation of the particle set to which the values belong, or from which node values were computed
  MaterialRange materials;  ///< those to which the variable belongs

  friend bool operator==(const GhostFill&, const GhostFill&) = default;
};

/// The ghost exchanges before a task. They need only one message per pair of ranks.
struct Stage {
  std::vector<GhostFill> fills;
  /// Index of the task after which the messages may be sent, because all values exist and earlier stages have been
  /// received; -1: from the start.
  int ready = -1;
};

/// The particle set of each access: the old set until the list relocates or makes particles, then the new one.
std::vector<data::Generation> particleSetsBefore(const std::vector<Task>& tasks);

/// Step 5 of compiling: `plan[t]` lists the exchanges before task t.
///
/// Ghosts of the old state are filled once, before the first task that needs any. Ghosts of new values are filled
/// before their first reader, or with an earlier exchange if they are complete by then.
std::vector<Stage> plan(const std::vector<Task>& tasks);

}  // namespace tushar::tasks
