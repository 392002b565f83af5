#pragma once

#include "core/tasks/task_list.hpp"

namespace tushar::tasks {

/// A list that changes the state in place: before the first task that modifies a variable of cells that no
/// earlier one computes comes a task that copies its old values, `take over c.density`.
TaskList takingOver(const TaskList& list);

}  // namespace tushar::tasks
