#pragma once

#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/collect/grid_order.hpp"
#include "core/data/warehouse.hpp"

namespace tushar::collect {

/// Where the values of a variable on one patch are.
struct Part {
  const std::byte* values = nullptr;
  std::size_t count = 0;  ///< of particles
  grid::Box stored{};     ///< of cells and nodes: the box in memory
};

/// The values of a variable on each patch of the grid, by number, for rank 0; the others have none. Those of
/// its own patches stay in the warehouse, and are good while the state is as it is.
struct Parts {
  std::vector<Part> of;
  std::vector<mpi::Bytes> messages{};  ///< of the other ranks, with their values
};

/// Sends to rank 0 what this rank has packed for each of its patches; see `collect`.
void sendPatches(const mpi::Communicator& ranks, mpi::Bytes bytes);
/// Waits for the message of a rank.
mpi::Bytes receivePatches(const mpi::Communicator& ranks, int from);

/// Sends what each rank has on its patches to rank 0: `pack(patch, bytes)` appends it on a rank that is not the first,
/// `unpack(patch, first byte)` takes it on the first, and returns how many bytes it has taken. What the first rank has
/// itself is not copied: there `own(patch)` is called. Rank 0 gets the messages, which hold the bytes. Every rank calls
/// it.
template <class Own, class Pack, class Unpack>
std::vector<mpi::Bytes> collect(const data::Warehouse& warehouse, Own&& own, Pack&& pack, Unpack&& unpack) {
  const grid::Grid& grid = warehouse.grid();
  const mpi::Communicator& ranks = warehouse.ranks();
  if (!ranks.isFirst()) {
    mpi::Bytes bytes;
    for (const grid::Patch& patch : grid.patches()) pack(patch, bytes);
    sendPatches(ranks, std::move(bytes));
    return {};
  }
  for (const grid::Patch& patch : grid.patches()) own(patch);
  std::vector<mpi::Bytes> messages;
  int next = static_cast<int>(grid.patches().size());
  for (int rank = 1; rank < ranks.size(); ++rank) {
    messages.push_back(receivePatches(ranks, rank));
    const std::byte* from = messages.back().data();
    for (; next < grid.patchCount() && grid.ownerOf(next) == rank; ++next) from += unpack(grid.patch(next), from);
  }
  return messages;
}

/// The particles of a variable, on each patch in its order. All ranks call it.
Parts collectParticles(data::Warehouse& warehouse, data::Generation generation, int variable);

/// The cells or nodes of a variable that are in an order. All ranks call it.
Parts collectGrid(data::Warehouse& warehouse, data::Generation generation, int variable, const GridOrder& order);

}  // namespace tushar::collect
