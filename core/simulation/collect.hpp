#pragma once

#include <utility>

#include "core/base/mpi.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::simulation {

/// Sends to the first rank what this rank has packed for each of its patches; see `collect`.
void sendPatches(const mpi::Communicator& ranks, mpi::Bytes bytes);
/// Waits for what a rank has sent.
mpi::Bytes receivePatches(const mpi::Communicator& ranks, int from);

/// Brings what all ranks have of their patches to the first: `pack(patch, bytes)` appends it on the rank that has the
/// patch, `unpack(patch, first byte)` takes it on the first rank, for every patch of the grid by number, and returns how
/// many bytes it has taken. Every rank calls it.
template <class Pack, class Unpack>
void collect(const data::Warehouse& warehouse, Pack&& pack, Unpack&& unpack) {
  const grid::Level& level = warehouse.level();
  const mpi::Communicator& ranks = warehouse.ranks();
  mpi::Bytes bytes;
  for (const grid::Patch& patch : level.patches()) {
    pack(patch, bytes);
    if (!ranks.isFirst()) continue;
    unpack(patch, std::as_const(bytes).data());
    bytes.clear();
  }
  if (!ranks.isFirst()) return sendPatches(ranks, std::move(bytes));
  int next = static_cast<int>(level.patches().size());
  for (int rank = 1; rank < ranks.size(); ++rank) {
    bytes = receivePatches(ranks, rank);
    for (const std::byte* from = bytes.data(); next < level.patchCount() && level.ownerOf(next) == rank; ++next)
      from += unpack(level.patch(next), from);
  }
}

}  // namespace tushar::simulation
