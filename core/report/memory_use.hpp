#pragma once

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::report {

/// Memory used by a rank at the end of the run, and its peak [bytes].
struct MemoryUse {
  double peak = 0;       ///< peak resident memory
  double fields = 0;     ///< variables on nodes and cells
  double particles = 0;  ///< variables of particles
  double buffers = 0;    ///< reused in every step, for messages and for variables that exist only within a step
  double files = 0;      ///< increase of the peak by outputs and checkpoints
};

/// The memory used by all ranks.
struct MemoryOfRanks {
  MemoryUse sum, most;  ///< sums over the ranks, and maxima over the ranks, separately for each member
};

/// Adds the memory of the variables of a rank.
void addVariables(const data::Warehouse& warehouse, MemoryUse& use);

/// Combines the memory of all ranks. Collective.
MemoryOfRanks ofRanks(const MemoryUse& mine, const mpi::Communicator& ranks);

}  // namespace tushar::report
