#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/output/snapshot.hpp"
#include "core/output/writers.hpp"

namespace tushar::output {

/// Consecutive entries of an array.
struct Piece {
  std::size_t first = 0, count = 0;
};

/// The most bytes of a piece: of one rank alone what stays in the processor's cache while it is written; of several,
/// who have to wait for each other for each of them, what is still little beside 64 MB.
std::size_t mostOfPiece(const Writers& writers);

/// Bytes of an entry in memory, and of all entries on all ranks.
std::size_t entryBytes(const Array& array);
std::uint64_t bytesOf(const Array& array);

/// Brings pieces of an array of which each rank has some entries to the writers, one to each at a time: so none needs
/// memory for more than a piece, and for what it sends of those of the others.
class Pieces {
 public:
  /// `writers` must outlive it.
  explicit Pieces(const Writers& writers) : writers_(&writers), outbox_(writers.ranks()) {}

  /// Brings to each writer its piece of the array, which has a source; `of[w]` is for writer w. The entries of that of
  /// this rank, in `into`, which grows to have room for them. Collective.
  std::span<std::byte> bring(const Array& array, std::span<const Piece> of, std::vector<std::byte>& into);

 private:
  const Writers* writers_;
  mpi::Outbox outbox_;
};

/// Brings the values of all arrays into the memory of the first rank; the others lose theirs. Collective.
void load(Snapshot& snapshot, const mpi::Communicator& ranks = mpi::Communicator::alone());

}  // namespace tushar::output
