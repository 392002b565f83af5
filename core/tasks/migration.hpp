#pragma once

#include "core/data/warehouse.hpp"

namespace tushar::tasks {

/// What of a run goes from rank to rank with a patch: the particles of the materials, and the old values of variables.
struct Luggage {
  int materials = 0;
  std::vector<int> variables;
};

/// Gives the patches of the grid to the ranks anew, each with its luggage. Ghosts are left to the next exchange; all
/// else that stands on patches is lost. All ranks that share the grid call it, between two steps.
void migrate(grid::Level& level, data::Warehouse& warehouse, const Luggage& luggage, const grid::Firsts& firsts);

}  // namespace tushar::tasks
