#pragma once

#include "core/base/threads.hpp"
#include "core/data/warehouse.hpp"
#include "core/tasks/task_graph.hpp"

namespace tushar::tasks {

/// Copies to the ghosts of every patch what the patches that own them hold. Particle sets get the ghosts of their patch
/// if they have none yet.
void fillGhosts(data::Warehouse& warehouse, const std::vector<NumberedFill>& fills, Threads& threads);

}  // namespace tushar::tasks
