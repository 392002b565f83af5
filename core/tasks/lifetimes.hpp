#pragma once

#include <string>
#include <vector>

#include "core/tasks/prune.hpp"

namespace tushar::tasks {

/// Step 6 of compiling: `lifetimes[t]` lists the new variables whose memory is freed after task t: those that it was
/// the last to read, and those that it wrote but that nothing reads.
std::vector<std::vector<std::string>> lifetimes(const Pruned& pruned);

}  // namespace tushar::tasks
