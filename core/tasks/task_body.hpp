#pragma once

#include "core/base/shared_function.hpp"

namespace tushar::tasks {

class TaskContext;

/// The body of a task.
using TaskBody = SharedFunction<void(const TaskContext&)>;

}  // namespace tushar::tasks
