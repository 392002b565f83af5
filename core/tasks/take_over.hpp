#pragma once

#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

/// The list for tasks that modify old cell variables: before the first task that modifies a variable which no earlier
/// one computes, a task copies the old values, `take over c.density`.
TaskList takingOver(const TaskList& list);

}  // namespace tushar::tasks
