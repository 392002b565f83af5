#pragma once

#include <string>
#include <vector>

#include "core/tasks/prune.hpp"

namespace tushar::tasks {

/// Step 6 of compiling: `lifetimes[t]` lists the new variables whose memory is freed after task t, because no later
/// task reads them; they include variables that task t wrote and no task reads.
std::vector<std::vector<std::string>> lifetimes(const Pruned& pruned);

}  // namespace tushar::tasks
