#pragma once

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::report {

/// Memory of a rank after the last step, and its peak, bytes.
struct MemoryUse {
  double peak = 0;       ///< resident
  double fields = 0;     ///< variables on nodes and cells
  double particles = 0;  ///< variables of particles
  double buffers = 0;    ///< what steps keep for the next: variables that live within a step, messages
  double files = 0;      ///< by how much outputs and checkpoints have raised the peak
};

/// The memory of all ranks.
struct MemoryOfRanks {
  MemoryUse sum, most;  ///< over the ranks; of the rank that has most of it, each number by itself
};

/// Adds up the variables that a rank holds.
void addVariables(const data::Warehouse& warehouse, MemoryUse& use);

/// All ranks call it.
MemoryOfRanks ofRanks(const MemoryUse& mine, const mpi::Communicator& ranks);

}  // namespace tushar::report
