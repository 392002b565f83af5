#pragma once

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::report {

/// Memory of a rank after the last step, and its peak, bytes.
struct MemoryUse {
  double peak = 0;       ///< resident
  double fields = 0;     ///< variables on nodes and cells
  double particles = 0;  ///< variables of particles
  double buffers = 0;    ///< memory kept from step to step: for variables within a step, for messages
  double files = 0;      ///< by how much outputs and checkpoints have raised the peak
};

/// The memory of all ranks.
struct MemoryOfRanks {
  MemoryUse sum, most;  ///< sums over the ranks; the largest on any rank, for each number separately
};

/// Adds up the variables that a rank holds.
void addVariables(const data::Warehouse& warehouse, MemoryUse& use);

/// All ranks call it.
MemoryOfRanks ofRanks(const MemoryUse& mine, const mpi::Communicator& ranks);

}  // namespace tushar::report
