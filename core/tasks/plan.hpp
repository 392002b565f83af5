#pragma once

#include <string>
#include <vector>

#include "core/data/warehouse.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// The ghosts of a variable are to be filled: on every patch, from the patches that own them.
struct GhostFill {
  const data::Label* label;
  data::Generation generation;  ///< of the values
  data::Generation set;         ///< of the particle set that the values follow, or that nodes were computed from
  bool perMaterial;

  friend bool operator==(const GhostFill&, const GhostFill&) = default;
};

/// The transfers between patches before a task runs. All of it goes in one message per pair of patches' owners.
struct Stage {
  std::vector<GhostFill> fills;
  int ready = -1;  ///< the task after which all of it may be sent, which no earlier stage is read after; -1: at once
};

/// The slots of the particles of an access: the old set until the list relocates or makes particles, then the new.
std::vector<data::Generation> particleSetsBefore(const std::vector<Task>& tasks);

/// Step 5 of compiling: `plan[t]` is what is exchanged before task t.
///
/// Ghosts of the old state are filled once, before the first task that needs any. Ghosts of new values are filled
/// before their first reader, or with an earlier exchange if they are complete by then.
std::vector<Stage> plan(const std::vector<Task>& tasks);

}  // namespace tushar::tasks
