#pragma once

#include <vector>

#include "core/grid/grid.hpp"
#include "core/tasks/task.hpp"

namespace tushar::tasks {

/// One call of a task: on a patch (-1: all patches of the rank), for a material (-1: none, or all).
struct Placement {
  int task;
  int patch;
  int material;

  friend bool operator==(const Placement&, const Placement&) = default;
};

/// Step 4 of compiling: the placements of all tasks in the order in which they run: task by task, material by material,
/// patch by patch.
std::vector<Placement> place(const std::vector<Task>& tasks, const grid::Grid& grid);

}  // namespace tushar::tasks
