#pragma once

#include "core/data/warehouse.hpp"
#include "core/tasks/plan.hpp"

namespace tushar::tasks {

/// Fills the ghost nodes or cells of a variable on every patch from the patches that own them.
void fillGridGhosts(data::Warehouse& warehouse, int variable, data::Generation generation);

/// Fills the ghost particles of a variable on every patch; which these are is settled on first use of the set.
void fillParticleGhosts(data::Warehouse& warehouse, int variable, data::Generation generation, data::Generation set);

}  // namespace tushar::tasks
