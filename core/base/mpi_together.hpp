#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::mpi {

// What ranks do together. All ranks call these, in the same order; with one rank they need no MPI.

/// Each rank does something of its own: throws what it throws there, and FailedElsewhere where it goes well but fails
/// on another rank.
void together(const Communicator& ranks, const std::function<void()>& action);

/// Whether all ranks come here within that time. Where they do not, the run is about to end, and `ranks` is of no more
/// use.
bool meet(const Communicator& ranks, std::chrono::milliseconds patience);

/// Each rank gets the sum over all ranks of what they have for it: `of[r]` is for rank r.
int sumForMe(const Communicator& ranks, std::span<const int> of);

/// The sum over the ranks before this one.
std::uint64_t sumBefore(const Communicator& ranks, std::uint64_t mine);

/// The numbers of all ranks, one rank after the other, on every rank.
std::vector<std::uint64_t> allOf(const Communicator& ranks, std::span<const std::uint64_t> mine);

/// The first rank of each node, ascending, on every rank.
std::vector<int> firstOfNodes(const Communicator& ranks);

/// A message, and the rank that it is to or from.
struct Letter {
  int rank = 0;
  Bytes bytes;
};

/// Brings letters to their ranks, at most one from a rank to another, none to itself. `take(from, bytes)` gets those of
/// this rank, in any order. `outbox` keeps what is sent until it has gone.
void exchange(const Communicator& ranks, Outbox& outbox, std::vector<Letter> letters,
              const std::function<void(int from, const Bytes& bytes)>& take);

}  // namespace tushar::mpi
