#pragma once

#include <string>
#include <vector>

#include "core/tasks/prune.hpp"

namespace tushar::tasks {

/// Step 6 of compiling: `lifetimes[t]` names the new variables whose memory is free once task t is done: those whose
/// last reader it was, and those it wrote that nothing reads.
std::vector<std::vector<std::string>> lifetimes(const Pruned& pruned);

}  // namespace tushar::tasks
