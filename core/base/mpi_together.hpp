#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::mpi {

// Collective operations: all ranks call these, in the same order; a single rank needs no MPI for them.

/// Runs an action on each rank. If it fails on any rank, all ranks throw: its exception where it failed,
/// FailedElsewhere on the others.
void together(const Communicator& ranks, const std::function<void()>& action);

/// Whether all ranks call this within `patience`. If not, the run is about to end, and `ranks` must not be used any
/// more.
bool meet(const Communicator& ranks, std::chrono::milliseconds patience);

/// The sum of the values that all ranks have for this rank: `of[r]` is for rank r.
int sumForMe(const Communicator& ranks, std::span<const int> of);

/// The sum over the ranks before this one.
std::uint64_t sumBefore(const Communicator& ranks, std::uint64_t mine);

/// The numbers of all ranks, in the order of the ranks, on every rank.
std::vector<std::uint64_t> allOf(const Communicator& ranks, std::span<const std::uint64_t> mine);

/// The first rank of each node, ascending, on every rank.
std::vector<int> firstOfNodes(const Communicator& ranks);

/// A message, and the rank to which it is sent or from which it comes.
struct Letter {
  int rank = 0;
  Bytes bytes;
};

/// Delivers messages: at most one from each rank to each other rank. `take(from, bytes)` gets those for this rank, in
/// any order. `outbox` keeps the messages until they are sent.
void exchange(const Communicator& ranks, Outbox& outbox, std::vector<Letter> letters,
              const std::function<void(int from, const Bytes& bytes)>& take);

}  // namespace tushar::mpi
