#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace tushar::mpi {

// Collective operations: all ranks call these, in the same order; a single rank needs no MPI for them.

/// Runs an action on each rank. If it throws on any rank, all ranks throw: a rank on which it failed rethrows its
/// exception, and the others throw FailedElsewhere.
void together(const Communicator& ranks, const std::function<void()>& action);

/// Whether all ranks call this within `patience`. If it returns false, the run is about to end, and `ranks` must not be
/// used any more.
bool meet(const Communicator& ranks, std::chrono::milliseconds patience);

/// Sends the number `of[r]` to each rank r, and returns the sum of the numbers that this rank receives.
int sumForMe(const Communicator& ranks, std::span<const int> of);

/// The sum of the values of all ranks with a lower index than this one.
std::uint64_t sumBefore(const Communicator& ranks, std::uint64_t mine);

/// The numbers of all ranks, in the order of the ranks, on every rank.
std::vector<std::uint64_t> allOf(const Communicator& ranks, std::span<const std::uint64_t> mine);

/// Completes `items` on every rank: items of equal size, of which rank r has those from firsts[r] to firsts[r + 1] - 1.
void complete(const Communicator& ranks, std::span<std::byte> items, std::span<const int> firsts);

/// Sends bytes to the rank `to`, and replaces `received` by as many from the rank `from`; -1: none, to or from which
/// nothing is sent. For ranks that do so in a row or in a ring.
void pass(const Communicator& ranks, int to, std::span<const std::byte> sent, int from, std::span<std::byte> received);

/// The first rank on each machine, in ascending order, on every rank.
std::vector<int> firstOfNodes(const Communicator& ranks);

/// A message, and its destination or source rank.
struct Letter {
  int rank = 0;
  Bytes bytes;
};

/// Delivers messages: at most one from each rank to each other rank. Calls `take(from, bytes)` for each message to this
/// rank, in any order. `outbox` keeps the messages until they are sent.
void exchange(const Communicator& ranks, Outbox& outbox, std::vector<Letter> letters,
              const std::function<void(int from, const Bytes& bytes)>& take);

}  // namespace tushar::mpi
