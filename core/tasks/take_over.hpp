#pragma once

#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

/// Returns the list with additional tasks that copy old cell variables: if a task modifies a variable that no earlier
/// task computes, a task such as `take over c.density` is inserted before it, and copies the old values.
TaskList takingOver(const TaskList& list);

}  // namespace tushar::tasks
