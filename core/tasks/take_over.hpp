#pragma once

#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

/// The list for tasks that modify old cell variables: before the first task that modifies a variable that no earlier
/// task computes, a task `take over c.density` copies the old values.
TaskList takingOver(const TaskList& list);

}  // namespace tushar::tasks
