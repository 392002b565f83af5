#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/tasks/task.hpp"

namespace tushar::tasks {

using Names = std::set<std::string, std::less<>>;

/// Names of the variables that exist after the tasks of a list.
Names producedBy(const std::vector<Task>& tasks);

/// Step 1 of compiling: checks that every variable that is read has been written.
///
/// `state` lists the variables that exist at the start of the step. Throws TaskError with one line for each mistake,
/// naming task, label and the nearest candidate: a missing producer, a variable computed twice, a label that is used
/// both with and without a material, particles read after a relocation without having been computed.
void validate(const std::vector<Task>& tasks, const Names& state);

}  // namespace tushar::tasks
